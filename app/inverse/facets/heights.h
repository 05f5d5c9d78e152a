// SPDX-License-Identifier: Apache-2.0
// Along z a facet may be moved at hardly any optical cost, so that its edges meet those of its neighbours.
#pragma once
#include "inverse/layout.h"

namespace nephroid::inverse {

/// z of the facets' middles for which the walls between them are lowest: the least sum over shared edges of the
/// integral of the squared step. Without a band that is Poisson's equation on the grid of facets; the middle of the
/// relief is at z = 0. With layout.band no corner is further than that from z = 0: the same least squares under these
/// bounds, by projected successive overrelaxation (Cryer 1971). Each facet must fit into the band by itself.
std::vector<double> least_steps(const Layout& layout, std::span<const glm::dvec2> gradients);

/// Heights as the layout says: free, or all of them 0.
std::vector<double> heights_of(const Layout& layout, std::span<const glm::dvec2> slopes);

} // namespace nephroid::inverse
