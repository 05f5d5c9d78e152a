// SPDX-License-Identifier: Apache-2.0
// What a report shows, as data: runs read back from their folders, their error curves held against each other, their
// pictures.
#pragma once
#include "job/history.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <set>
#include <span>
#include <string>

namespace nephroid::report {

using Json = nlohmann::ordered_json;

/// A finished run read back from its folder, but for its pictures.
struct RunFolder {
  std::filesystem::path folder;
  Json run;  ///< run.json: checked where the report reads it, else as the file has it
  Json plan; ///< plan.json, likewise
  std::map<std::string, std::string>
      settings; ///< preset.json: every value by its key as --set takes it ("scene.lights.0.power_w"), as JSON
  Json curves;  ///< every other CSV file: [{"name", "columns", "rows"}]
  std::optional<job::History> history; ///< none where there is no history.csv

  std::string name() const { return run["name"]; }
  /// The picture that it is measured against; empty where it is measured against none.
  std::filesystem::path reference() const {
    return run.contains("reference") ? run["reference"]["origin"].get<std::string>() : "";
  }
};

inline constexpr std::size_t max_runs = 64;

/// In the folder of a sweep: {"runs": the names of their folders in the sweep's order}.
inline constexpr const char* sweep_file = "sweep.json";

/// The files in a folder whose names end so (".exr"), by name.
std::set<std::filesystem::path> files_ending(const std::filesystem::path& folder, const std::string& extension);

/// The runs in these folders: a folder with a run.json is one, a sweep's folder stands for the runs in its own folders:
/// those that its sweep_file names, in that order, or without one all by name. Throws bad_input for a folder that is
/// neither or is named twice, for more runs than max_runs, for an unfinished run, and at FILE or FILE#/pointer for a
/// file that is missing, cut or of other types than a run writes. What only some engines write may be missing.
std::vector<RunFolder> read_runs(std::span<const std::filesystem::path> folders);

/// All of it:
///     {"title", "runs": [{"label", "folder", "measurements": rows of history.csv, null without one, "settings",
///     "curves", "run", "plan"}],
///      "metrics", "pictures", "notes", "colours": [[r, g, b], ...] from no difference to the scale's end}
/// Throws as read_runs and read_pictures do.
Json report_data(std::span<const std::filesystem::path> run_folders);

/// A file that is part of every page: "report.html", which names the others as {{NAME}}.
struct PageFile {
  std::string name;
  std::string text;
};
const std::vector<PageFile>& page_files();

/// The page over the runs in these folders. Throws bad_input for a folder that is no run or holds an unfinished or
/// damaged one.
std::string report_html(std::span<const std::filesystem::path> run_folders);

} // namespace nephroid::report
