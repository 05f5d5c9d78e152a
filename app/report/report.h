// SPDX-License-Identifier: Apache-2.0
// The report over finished runs: one HTML page that opens without a network.
#pragma once
#include "report/run_folder.h"

namespace nephroid::report {

/// All that the page over the runs in these folders shows:
///
///     {"title", "runs": [{"label", "folder", "measurements": rows of history.csv, null without one, "run": run.json, "plan": plan.json}], "settings": differing_settings, "errors": final_errors,
///      "metrics": metrics_json, "pictures": Pictures::groups, "colours": [[r, g, b], ...] from no difference to the scale's end, "notes": [...]}
///
/// Throws bad_input for a folder that is no run or holds an unfinished or damaged one.
Json report_data(std::span<const std::filesystem::path> run_folders);

/// The page itself. Throws as report_data does.
std::string report_html(std::span<const std::filesystem::path> run_folders);

/// A file that is part of every page: "report.html", which names the others as {{NAME}}.
struct PageFile {
  std::string name;
  std::string text;
};
const std::vector<PageFile>& page_files();

} // namespace nephroid::report
