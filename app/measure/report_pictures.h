// SPDX-License-Identifier: Apache-2.0
// The pictures of a report: every run's, the references', the differences, as PNG in groups of one size.
#pragma once
#include "measure/run_summary.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nephroid::measure {

struct ReportPicture {
  enum class Kind { run, reference, difference };
  Kind kind = Kind::run;
  std::optional<std::size_t> run;  ///< whose picture or difference it is; none of a reference
  std::optional<std::size_t> from; ///< difference: the run it is a difference from; none: its reference
  std::string png;                 ///< full size, as shown() at exposure 0; differences in the colours of map_colour
  std::vector<std::size_t> of;     ///< reference: the runs that are measured against it
};

struct PictureGroup {
  int width = 0, height = 0;
  double difference_scale = 0;         ///< the CIELAB distance at the end of the colours, the same for all differences
  std::vector<ReportPicture> pictures; ///< the runs', then references, then differences
};

struct ReportPictures {
  std::vector<PictureGroup> groups;
  std::vector<std::string> notes; ///< what is not there and why
  /// Of each run: which of the references it was measured against; equal numbers are equal pictures. None: without a reference.
  std::vector<std::optional<std::size_t>> reference_of_run;
};

/// A run is compared with its reference where that has the run's size, else with the first run of that size. A file that is missing is
/// a note. Throws bad_input for one that is damaged, and for NaN or infinity where there is something to compare with.
ReportPictures read_pictures(std::span<const RunSummary> runs);

} // namespace nephroid::measure
