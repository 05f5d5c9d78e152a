// SPDX-License-Identifier: Apache-2.0
// What the pipeline does to the pictures: size and place (thesis 5.2.1), extension and overshoot (5.2.2).
#pragma once
#include "inverse/thesis/sampler.h"

namespace nephroid::inverse {

/// The picture with its sizes grown by `scale` about its middle, then moved by `shift` (parts of the receiver, right
/// and down). A cell has the mean of what covers it. The brightest cell is 1; all are 0 where nothing is left.
std::vector<double> moved(const Target& picture, const Layout& layout, double scale, const glm::dvec2& shift);

/// How far a picture's dark cells are from its lit ones.
struct Margin {
  std::vector<double> distance;     ///< each cell's distance, in cells; 0: it is lit itself
  std::vector<std::size_t> nearest; ///< each cell's nearest lit cell
};

/// The picture must have a lit cell.
Margin margin_of(const std::vector<double>& picture, const Layout& layout);

/// The picture extended by `cells`: a dark cell has what the nearest lit one has, less with every cell in between.
std::vector<double> extended(const std::vector<double>& picture, const Margin& margin, double cells);

/// What others' missing cells ask of a picture: cells through which no facet's light finds all others lit.
struct MissingLight {
  std::size_t missing = 0; ///< how many of its own cells are missing
  double extension = 0;    ///< s: how far at most the light of others' missing cells falls from its lit ones, in cells
  double overshoot = 0;    ///< e: the part of that light that falls beside its receiver
};

/// What is asked of each aim. A lattice of facets stands for all of them: every one up to 128 a side.
std::vector<MissingLight> needs_of(const Layout& layout, const std::vector<SamplingTarget>& aims,
                                   const std::vector<Margin>& margins);

} // namespace nephroid::inverse
