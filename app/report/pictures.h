// SPDX-License-Identifier: Apache-2.0
// The pictures that a report shows, of runs and of their differences.
#pragma once
#include "report/report.h"

#include <optional>
#include <span>
#include <vector>

namespace nephroid::report {

/// A run's pictures are image.exr, called "image", and every other EXR in its folder, by its name. "image" is compared
/// with the run's reference where that has its size; else, as every other picture, with the first run's of that name
/// and size.
struct Pictures {
  /// [{"name", "width", "height", "scale": the CIELAB distance at the end of the colours, 0 without differences,
  ///   "pictures": [{"kind": "run", "reference" or "difference", "runs": [whose it is], "from": a difference's run;
  ///   null: its reference,
  ///                 "png": base64}]}], one of these for each name and size; runs before references before differences.
  /// Full size, as shown() at exposure 0, differences in the colours of map_colour.
  Json groups = Json::array();
  Json notes = Json::array(); ///< what is not there and why
  /// For each run the reference that it was measured against; equal numbers are equal pictures. None: without a
  /// reference.
  std::vector<std::optional<std::size_t>> reference_of_run;
};
/// Throws bad_input for a picture that is damaged, and for NaN or infinity where there is something to compare with.
Pictures read_pictures(std::span<const RunFolder> runs);

} // namespace nephroid::report
