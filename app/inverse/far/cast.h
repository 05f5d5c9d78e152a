// SPDX-License-Identifier: Apache-2.0
// The intensity that a judged object makes of a lamp's light, beside the one that is wanted: figures and files.
#pragma once
#include "inverse/layout.h"
#include "job/job.h"

namespace nephroid::inverse {

/// In candela. The wanted one has the light that the cast one has in the target, or the candela that are asked for.
struct CastIntensity {
  Layout layout;
  std::vector<double> wanted, cast; ///< of each cell, row 0 at the top
  double lumens = 0;                ///< of the lamp
  double on_front = 0;              ///< the part of them on the front
  double on_target = 0;             ///< the part of those in the target: cells with over a hundredth of its largest
  double of_sent = 0;               ///< the part of what the object sends forward that is there
  double rms = 0; ///< root of the mean square of cast - wanted over that of wanted, over the target's solid angle
  double uniformity = 0; ///< least over mean of the cast intensity, each over what is wanted, where that is over half
  std::optional<double> contrast; ///< cutoff: just below the level part of its cut over just above
};

/// light: of each cell, in facets' incident light, as Judge::light(). sent: RayOutcomes::sent.
CastIntensity cast_of(const preset::Preset& preset, const Layout& layout, const Target& target,
                      const std::vector<double>& light, double sent);

void add_intensity_figures(job::Snapshot& snapshot, const CastIntensity& cast);

/// intensity.ies, .ldt, .csv with both intensities, .svg with both in two planes, and .md with the figures.
void add_intensity_files(job::Snapshot& snapshot, const CastIntensity& cast, const std::string& name);

/// What the cells of an intensity have in the direction of tangents to the right and up: linear between their middles.
double at_tangent(const Layout& layout, const std::vector<double>& cells, const glm::dvec2& tangent);

} // namespace nephroid::inverse
