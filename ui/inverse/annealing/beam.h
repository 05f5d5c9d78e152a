// SPDX-License-Identifier: Apache-2.0
// Where the light of one facet falls on every receiver. No Dear ImGui.
#pragma once
#include "inverse/assign/footprint.h"
#include "job/job.h"

#include <optional>
#include <vector>

namespace nephroid::ui {

struct FacetBeam {
  glm::ivec2 facet{0, 0}; ///< column and row, from the top left
  glm::dvec2 slope{0, 0};
  double height = 0;                      ///< z of its middle, millimetres
  double power = 0;                       ///< over that of a facet that lies flat
  std::vector<inverse::Footprint> prints; ///< on each receiver
};

/// slopes: a pixel a facet: slope along x, along y, height. Empty where it is of another number of facets than the layout, or the facet is
/// outside.
std::optional<FacetBeam> facet_beam(const job::Picture& slopes, const inverse::Layout& layout, const glm::ivec2& facet);

/// A footprint on a receiver's picture, in cells from its top left corner.
struct BeamBox {
  glm::dvec2 low{0, 0}, high{0, 0};
};
/// Empty where nothing of the beam is on the receiver.
std::optional<BeamBox> box_of(const inverse::Footprint& print);
/// The part of the beam that is on the receiver.
double part_on(const inverse::Footprint& print);

} // namespace nephroid::ui
