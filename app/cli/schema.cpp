// SPDX-License-Identifier: Apache-2.0
// `nephroid schema`: the JSON Schema of preset files.
#include "cli/verb.h"
#include "cli/verbs.h"
#include "preset/read.h"

#include <fmt/format.h>

namespace nephroid::cli {

void add_schema(CLI::App& program, Session&)
{
  Verb verb(program, "schema", "The JSON Schema of preset files, for editors",
            {{"nephroid schema > schema.json", "name it as \"$schema\" in a preset, and an editor completes its keys"}});
  verb.work([] { fmt::print("{}\n", preset::schema()); });
}

} // namespace nephroid::cli
