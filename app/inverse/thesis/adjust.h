// SPDX-License-Identifier: Apache-2.0
// What the pipeline does to the pictures: size and place (thesis 5.2.1), extension and overshoot (5.2.2).
#pragma once
#include "inverse/thesis/sampler.h"

#include <cstddef>
#include <vector>

namespace nephroid::inverse {

/// A picture whose sizes grow by `scale` about the receiver's middle and that then moves by `shift` (parts of the
/// receiver, right and down). A cell has the mean of what covers it; what leaves the receiver is cut off. Brightest 1;
/// all 0 where nothing is left.
std::vector<double> moved(const Target& picture, const Layout& layout, double scale, const glm::dvec2& shift);

/// How far from a picture's lit cells its dark ones are.
struct Margin {
  std::vector<double> distance;     ///< of each cell, in cells; 0: it is lit itself
  std::vector<std::size_t> nearest; ///< the lit cell
};

/// The picture has a lit cell.
Margin margin_of(const std::vector<double>& picture, const Layout& layout);

/// A picture that reaches `cells` beyond its lit cells: a dark cell has what the nearest lit one has, less with every
/// cell in between, and 0 after the last.
std::vector<double> extended(const std::vector<double>& picture, const Margin& margin, double cells);

/// Of one picture: what others' missing cells ask of it. A cell is missing where light from no facet that goes through
/// its middle finds all other pictures lit.
struct MissingLight {
  std::size_t missing = 0; ///< its own cells
  double extension =
      0; ///< s: how far from its lit cells the light of others' missing cells meets dark ones, at most; in cells
  double overshoot = 0; ///< e: the part of that light that is beside its receiver
};

/// Of each aim. A lattice of facets speaks for all of them: every one up to 128 a side.
std::vector<MissingLight> needs_of(const Layout& layout, const std::vector<SamplingTarget>& aims,
                                   const std::vector<Margin>& margins);

} // namespace nephroid::inverse
