// SPDX-License-Identifier: Apache-2.0
// Light that facets spread because it is a wave: what is said of it. Footprints have it as a box, the judge exactly.
#pragma once
#include "inverse/layout.h"

namespace nephroid::inverse {

/// How far the light of a facet spreads on a receiver, in cells, across or down, whichever is more. A lens has no edges
/// between its facets; what counts is the part of it that lights a cell.
double diffraction_cells(const Settings& settings, const Layout& layout, std::size_t receiver);

/// A sentence for each picture that is spread by more than a cell, with the finest facets, or of a lens the finest
/// cells, that are of use.
std::vector<std::string> diffraction_notes(const Settings& settings, const Layout& layout);

/// Quantiles of half of a slit's light: the light from the middle to value i is i / count of all that is on this side.
/// In units of wavelength over width, where the light is sinc^2.
std::vector<float> slit_quantiles(std::size_t count);

} // namespace nephroid::inverse
