// SPDX-License-Identifier: Apache-2.0
// `nephroid schema`: the JSON Schema of preset files.
#include "cli/examples.h"
#include "cli/verbs.h"
#include "preset/read.h"

#include <fmt/format.h>

namespace nephroid::cli {

void add_schema(CLI::App& program, Session&)
{
  CLI::App* verb = program.add_subcommand("schema", "The JSON Schema of preset files, for editors");
  verb->footer(examples({{"nephroid schema > schema.json", "name it as \"$schema\" in a preset, and an editor completes its keys"}}));
  verb->callback([] { fmt::print("{}\n", preset::schema()); });
}

} // namespace nephroid::cli
