// SPDX-License-Identifier: Apache-2.0
// `nephroid version`: what was built, with what. Loads and initialises nothing.
#include "base/build_info.h"
#include "base/json_output.h"
#include "cli/verb.h"
#include "cli/verbs.h"

#include <CLI/Version.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <map>
#include <memory>
#include <string>

namespace nephroid::cli {
namespace {

std::string dotted(int major, int minor, int patch) { return fmt::format("{}.{}.{}", major, minor, patch); }

/// Libraries whose headers are compiled in; the versions of the others are their packages'.
std::map<std::string, std::string> libraries()
{
  return {{"CLI11", CLI11_VERSION},
          {"fmt", dotted(FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
          {"nlohmann-json", dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)}};
}

void print_version(bool json)
{
  const std::map<std::string, std::string> used = libraries();
  if (json) {
    const nlohmann::ordered_json all{{"version", version()}, {"commit", commit()}, {"compiler", compiler()}, {"libraries", used}};
    fmt::print("{}\n", json_text(all));
    return;
  }
  fmt::print("{}\n{}\n", program_name(), compiler());
  for (const auto& [name, number] : used) fmt::print("{} {}\n", name, number);
}

} // namespace

void add_version(CLI::App& program, Session&)
{
  Verb verb(program, "version", "The program's version, commit, compiler and libraries", {{"nephroid version", ""}});
  const auto json = std::make_shared<bool>(false);
  verb.flag("--json", *json, "One JSON object");
  verb.work([json] { print_version(*json); });
}

} // namespace nephroid::cli
