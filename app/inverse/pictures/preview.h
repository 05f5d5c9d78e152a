// SPDX-License-Identifier: Apache-2.0
// What can be said of pictures before anything is designed: how close to them an object of these facets comes at best,
// and what will go wrong.
#pragma once
#include "inverse/layout.h"
#include "inverse/settings.h"

#include <string>

namespace nephroid::inverse {

/// The layout as light blurs its pictures: a lens gathers the light of its facets, whose size then blurs nothing.
Layout blurring_layout(const Settings& settings, Layout layout);

/// The closest to a target that so many facets could cast, were it their only picture, to within a tenth. Any light a
/// cell that is not negative may be sent, smeared by the footprint of a facet that hardly bends it. So the result
/// includes the size of facets, the sun, roughness and dispersion, but no conflicts of pictures. It is found by least
/// squares with FISTA (Beck and Teboulle 2009) and sums to 1.
Target best_possible(const Layout& layout, const Target& target, std::size_t receiver);
std::vector<Target> best_possible(const Layout& layout, const std::vector<Target>& targets);

/// Sentences on the pictures: details that no facet is small enough for, dark photographs, rings, a deep lens.
std::vector<std::string> picture_notes(const Settings& settings, const Layout& layout,
                                       const std::vector<Target>& targets, const std::vector<Target>& best);

/// The depth of a lens for this picture, in millimetres, estimated by a coarse one.
double estimated_relief(const Layout& layout, const Target& target);

/// Sentences on what leaning walls will take, and on layers that are too thick for the facets.
std::vector<std::string> workshop_notes(const Settings& settings, const Layout& layout);

} // namespace nephroid::inverse
