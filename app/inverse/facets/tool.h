// SPDX-License-Identifier: Apache-2.0
// What a ball end mill cannot reach: it leaves valleys rounded.
#pragma once
#include "inverse/facets/solid.h"

#include <limits>

namespace nephroid::inverse {

/// The part of the facets' area that a ball with this radius, in mm, at most as wide as a facet, cannot touch without
/// cutting into a facet or a wall; walls are upright. It is about the part of the light that the ball's fillets send
/// elsewhere. The surface that a ball leaves is the morphological closing of the relief by it (Serra 1982); where it
/// may stand over a facet is known in closed form. Points are sampled, 64 or more on each of up to 64 x 64 facets.
double unreached_part(const Layout& layout, const Solid& solid, double radius);

/// The smallest radius of curvature in a lens' valleys, in mm, and its place; infinite where it is over a kilometre. It
/// is looked for at four places a facet, its corners among them, and downhill from the best.
struct Valley {
  double radius = std::numeric_limits<double>::infinity();
  glm::dvec2 at{0};
};
Valley tightest_valley(const Layout& layout, const Surface& surface);

} // namespace nephroid::inverse
