// SPDX-License-Identifier: Apache-2.0
// What a report shows, as data: runs read back from their folders, their error curves side by side, their pictures.
#pragma once
#include "image/display.h"
#include "job/history.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <set>
#include <span>

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

  image::Display display; ///< how run.json says that its pictures are shown

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

/// The runs in these folders: a folder with a run.json is one, a sweep's folder stands for the runs in its own folders,
/// as its sweep_file names them, or without one all by name. Throws bad_input for a folder that is neither or is named
/// twice, for more runs than max_runs, for an unfinished run, and at FILE or FILE#/pointer for a file that is missing,
/// cut or of other types than a run writes. What only some engines write may be missing.
std::vector<RunFolder> read_runs(std::span<const std::filesystem::path> folders);

/// A run's pictures are image.exr, called "image", and every other EXR in its folder, by its name. "image" is compared
/// with the run's reference where that has its size; else, as the others, with the first run's of that name and size.
struct Pictures {
  /// [{"name", "width", "height", "scale": the CIELAB distance at the end of the colours, 0 without differences,
  ///   "pictures": [{"kind": "run", "reference" or "difference", "runs": [whose it is], "from": a difference's run;
  ///   null: its reference,
  ///                 "png": base64}]}], one of these for each name and size; runs before references before differences.
  /// Full size, as the run shows them, a reference as its first run, differences in the colours of map_colour.
  Json groups = Json::array();
  Json notes = Json::array(); ///< what is not there and why
  /// For each run the reference that it was measured against, if any; equal numbers are equal pictures.
  std::vector<std::optional<std::size_t>> reference_of_run;
};
/// Throws bad_input for a picture that is damaged, and for NaN or infinity where there is something to compare with.
Pictures read_pictures(std::span<const RunFolder> runs);

/// Every metric that a run has a value of: first the one that most runs are judged by, then errors in the order of the
/// files, then what does not fall. Runs are counted from 0.
///     [{"metric", "label", "unit", "law": number or null, "falls", "larger_is_better",
///       "lines": [{"run", "estimate", "slope": number or null, "floor": 0: not known, "points": [[seconds, error],
///       ...]}], "biased": [run, ...]; and of errors only: "levels": [error, ...], "times": [{"run", "estimate",
///       "cells": [a level each: null: never; {"seconds", "earlier", "near_floor"}]}], "pairs": [{"faster", "slower",
///       "error", "estimate", "faster_seconds", "slower_seconds", "speed_up", "remark"}], "not_compared": ["1 and 2
///       (why)", ...]}]
/// `reference_of_run` is as Pictures has it.
Json metrics_json(std::span<const RunFolder> runs, const std::vector<std::optional<std::size_t>>& reference_of_run);

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

/// The page over the runs in these folders. Throws as report_data.
std::string report_html(std::span<const std::filesystem::path> run_folders);

} // namespace nephroid::report
