// SPDX-License-Identifier: Apache-2.0
// The page of a report, section by section. Everything that comes from a file is escaped here and nowhere else.
#pragma once
#include "measure/report_curves.h"
#include "measure/report_pictures.h"
#include "measure/run_summary.h"

#include <string>
#include <vector>

namespace nephroid::measure {

/// All that a page shows.
struct Report {
  std::vector<RunSummary> runs;
  std::vector<std::string> labels;   ///< one a run, unique
  std::vector<MetricCurves> metrics; ///< the main one first
  std::vector<std::string> charts;   ///< SVG, one a metric
  ReportPictures pictures;
};

/// Names that tell the runs apart: the preset's, with the folder where two have one name.
std::vector<std::string> labels_of(const std::vector<RunSummary>& runs);

/// The HTML of each section, with its heading.
std::string overview_section(const Report& report);
std::string errors_section(const Report& report);
std::string pictures_section(const Report& report);
std::string plans_section(const Report& report);
std::string machines_section(const Report& report);

/// "1 first-light" with the run's colour before it.
std::string run_name(const Report& report, std::size_t run);
/// A heading cell for each run.
std::string run_headings(const Report& report);

/// A file of page/ that is part of every page: "report.css", "report.js".
struct PageFile {
  std::string name;
  std::string text;
};
const std::vector<PageFile>& page_files();

} // namespace nephroid::measure
