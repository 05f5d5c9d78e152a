// SPDX-License-Identifier: Apache-2.0
// A finished run read back from its folder, but for its pictures.
#pragma once
#include "job/history.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nephroid::report {

using Json = nlohmann::ordered_json;

struct RunFolder {
  std::filesystem::path folder;
  Json run;                                    ///< run.json: checked where the report reads it, else as the file has it
  Json plan;                                   ///< plan.json, likewise
  std::map<std::string, std::string> settings; ///< preset.json: every value by its key as --set takes it ("scene.lights.0.power_w"), as JSON
  std::optional<job::History> history;         ///< none where there is no history.csv

  std::string name() const { return run["name"]; }
  /// The picture that it is measured against; empty where it is measured against none.
  std::filesystem::path reference() const { return run.contains("reference") ? run["reference"]["origin"].get<std::string>() : ""; }
};

inline constexpr std::size_t max_runs = 64;

/// The runs in these folders: a folder with a run.json is one, a sweep's folder stands for the runs in its own folders, by name.
/// Throws bad_input for a folder that is neither or is named twice, and for more runs than max_runs.
std::vector<std::filesystem::path> find_runs(std::span<const std::filesystem::path> folders);

/// Throws bad_input at FILE or FILE#/pointer: an unfinished run, a file that is missing, cut or of other types than a run writes.
/// What only some engines write may be missing, and so may history.csv.
RunFolder read_run(const std::filesystem::path& folder);

} // namespace nephroid::report
