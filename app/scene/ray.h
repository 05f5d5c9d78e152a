// SPDX-License-Identifier: Apache-2.0
// Rays through a tree on the host, and directions that lie evenly.
#pragma once
#include "scene/bvh.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>

namespace nephroid::scene {

struct RayHit {
  double t = 0;                ///< distance in lengths of the direction
  std::uint32_t primitive = 0; ///< index into Mesh::triangles; counted on from their number, into Mesh::ellipsoids
};

/// Which primitives a ray can hit; the others it passes as if they were not there.
using CountsPrimitive = std::function<bool(std::uint32_t primitive)>;

/// One ray at a time, on the host and in double precision: for a few thousand rays before a run.
/// The closest hit with 0 < t <= t_max, of equals the lowest primitive. direction: of any length but 0. A ray cannot
/// pass between two triangles that share an edge. counts: empty for all. leaves: what the ray starts on, which it meets
/// again only on the far side of an ellipsoid.
std::optional<RayHit> closest_hit(const Bvh& bvh, const glm::dvec3& origin, const glm::dvec3& direction,
                                  const CountsPrimitive& counts = {},
                                  double t_max = std::numeric_limits<double>::infinity(),
                                  std::uint32_t leaves = no_primitive);

/// Direction i of `count` that lie evenly on the sphere (Fibonacci's lattice: equal steps along z, golden angles about
/// it), all of them turned by `turns` about z.
glm::dvec3 even_direction(int i, int count, double turns = 0);

} // namespace nephroid::scene
