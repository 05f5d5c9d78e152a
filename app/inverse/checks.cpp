// SPDX-License-Identifier: Apache-2.0
// Engine 3's closed forms, for `nephroid check`.
#include "inverse/bending.h"
#include "inverse/engine.h"
#include "inverse/judge.h"
#include "inverse/uniform.h"

#include <algorithm>

namespace nephroid::inverse {
namespace {

/// A single facet is a prism: light through its middle leaves with the slope that it was made for, from the place where it left.
check::Result one_facet(const compute::Context&, std::uint64_t seed)
{
  std::mt19937_64 random(seed);
  double farthest = 0;
  for (int i = 0; i < 20; ++i) {
    Layout layout;
    layout.size = {1, 1};
    layout.facets = {1, 1};
    layout.distances = {100};
    const auto about_0 = [&] { return uniform(random) - 0.5; };
    const glm::dvec2 slope(about_0(), about_0()), at = 0.8 * glm::dvec2(about_0(), about_0());
    const Solid solid = make_solid(layout, {slope});
    const WayOut way = follow(solid, scene::build_bvh(solid.mesh), layout.n, {at, layout.thickness + 1}, {0, 0, -1});
    const double z = glm::dot(facet_gradient(slope, layout.n), at), distance = layout.distances[0];
    const glm::dvec2 spot = glm::dvec2(way.from) - glm::dvec2(way.direction) / way.direction.z * (distance + way.from.z);
    farthest = std::max(farthest, glm::length(spot - (at + slope * (distance + z))));
  }
  return check::judged(farthest, 0.01, "mm", "the spot of a facet over 100 mm against its slope");
}

} // namespace

std::vector<check::Check> closed_forms() { return {{"inverse: a facet's spot", one_facet}}; }

} // namespace nephroid::inverse
