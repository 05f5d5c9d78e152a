// SPDX-License-Identifier: Apache-2.0
// `nephroid presets`: what is shipped, with a line each.
#include "base/json_output.h"
#include "cli/verb.h"
#include "cli/verbs.h"
#include "preset/read.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>

namespace nephroid::cli {
namespace {

void print_presets(bool json)
{
  const std::vector<preset::ShippedPreset> presets = preset::shipped_presets();
  if (json) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const preset::ShippedPreset& p : presets)
      list.push_back({{"name", p.name}, {"description", p.description}, {"file", p.file.string()}});
    fmt::print("{}\n", json_text(list));
    return;
  }
  std::size_t width = 0;
  for (const preset::ShippedPreset& p : presets) width = std::max(width, p.name.size());
  for (const preset::ShippedPreset& p : presets) fmt::print("{:{}}  {}\n", p.name, width, p.description);
}

} // namespace

void add_presets(CLI::App& program, Session&)
{
  Verb verb(program, "presets", "The shipped presets, with a line each",
            {{"nephroid presets", "their names; `nephroid run NAME` renders one"}, {"nephroid presets --json", "with the file of each"}});
  const auto json = std::make_shared<bool>(false);
  verb.flag("--json", *json, "A list of {\"name\",\"description\",\"file\"}");
  verb.work([json] { print_presets(*json); });
}

} // namespace nephroid::cli
