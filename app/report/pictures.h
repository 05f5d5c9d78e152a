// SPDX-License-Identifier: Apache-2.0
// The pictures of a report: every run's by their names, the references, the differences, as PNG in groups of one name and size.
#pragma once
#include "report/run_folder.h"

namespace nephroid::report {

struct Pictures {
  /// [{"name", "width", "height", "scale": the CIELAB distance at the end of the colours, 0 without differences,
  ///   "pictures": [{"kind": "run", "reference" or "difference", "runs": [whose it is], "from": a difference's run; null: its reference,
  ///                 "png": base64}]}], a run's own before the references before the differences.
  /// Full size, as shown() at exposure 0, differences in the colours of map_colour.
  Json groups = Json::array();
  Json notes = Json::array(); ///< what is not there and why
  /// Of each run: which of the references it was measured against; equal numbers are equal pictures. None: without a reference.
  std::vector<std::optional<std::size_t>> reference_of_run;
};

/// A run's pictures are image.exr, called "image", and every other EXR in its folder, by its name. "image" is compared with the run's
/// reference where that has its size; else, as every other picture, with the first run's of that name and size. image.exr or a reference
/// that is missing is a note. Throws bad_input for a picture that is damaged, and for NaN or infinity where there is something to compare with.
Pictures read_pictures(std::span<const RunFolder> runs);

} // namespace nephroid::report
