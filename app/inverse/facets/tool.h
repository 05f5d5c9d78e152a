// SPDX-License-Identifier: Apache-2.0
// What a ball end mill cannot reach: it leaves valleys rounded.
#pragma once
#include "inverse/facets/solid.h"

#include <limits>

namespace nephroid::inverse {

/// Part of the facets' area that a ball of this radius, in mm, cannot touch without cutting into a facet or a wall,
/// over facets between upright walls; about the part of the light that its fillets send elsewhere. The ball is at most
/// as wide as a facet. The surface that it leaves is the morphological closing of the relief by the ball (Serra 1982).
/// Where a ball may stand over a facet is known in closed form; points of the facets are sampled, 64 or more on each of
/// up to 64 x 64 facets.
double unreached_part(const Layout& layout, const Solid& solid, double radius);

/// Of a lens: the smallest radius of curvature in its valleys, in mm, and where; infinite where none is below a
/// kilometre. A ball that is smaller reaches all of it.
struct Valley {
  double radius = std::numeric_limits<double>::infinity();
  glm::dvec2 at{0};
};
Valley tightest_valley(const Layout& layout, const Surface& surface);

} // namespace nephroid::inverse
