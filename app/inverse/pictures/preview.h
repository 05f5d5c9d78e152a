// SPDX-License-Identifier: Apache-2.0
// What can be said before anything is designed: how close to its pictures an object comes at best, and what goes wrong.
#pragma once
#include "inverse/layout.h"

namespace nephroid::inverse {

/// The layout for best_possible(): the facets of a lens are so small that they blur nothing, as it gathers their light.
Layout blurring_layout(const Settings& settings, Layout layout);

/// The closest to a target that facets of this size could cast, were it their only picture, to within a tenth; it sums
/// to 1. Light may be aimed at any cell. All of it is smeared as that of the facet that bends light to the middle cell
/// least. It is the least squares, by FISTA (Beck and Teboulle 2009).
Target best_possible(const Layout& layout, const Target& target, std::size_t receiver);
std::vector<Target> best_possible(const Layout& layout, const std::vector<Target>& targets);

/// Sentences on pictures too fine for the facets' light, dark files and dark pictures of a lens, and greys by flat
/// facets.
std::vector<std::string> picture_notes(const Settings& settings, const Layout& layout,
                                       const std::vector<Target>& targets, const std::vector<Target>& best);

/// Sentences on the light that leaning walls take, and on layers that are too thick for the facets.
std::vector<std::string> workshop_notes(const Settings& settings, const Layout& layout);

} // namespace nephroid::inverse
