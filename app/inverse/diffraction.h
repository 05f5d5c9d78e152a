// SPDX-License-Identifier: Apache-2.0
// Light that facets spread because it is a wave. Rays know nothing of it.
#pragma once
#include "inverse/layout.h"

namespace nephroid::inverse {

/// How far the light of a facet spreads on a receiver, in cells, across or down, whichever is more: wavelength times
/// distance over the facet's width, where a slit's light first is 0 (Hecht 2017, Optics, 10.2.1). A lens has no edges
/// between its facets; what counts is the part of it that lights a cell.
double diffraction_cells(const Settings& settings, const Layout& layout, std::size_t receiver);

/// A sentence for each picture that is spread by more than a cell, with the finest facets, or of a lens the finest
/// cells, that are of use.
std::vector<std::string> diffraction_notes(const Settings& settings, const Layout& layout);

} // namespace nephroid::inverse
