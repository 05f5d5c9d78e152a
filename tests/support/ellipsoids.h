// SPDX-License-Identifier: Apache-2.0
// Rays and ellipsoids by the plain quadratic, in long double: what the tracers' own way of solving it is judged by.
#pragma once
#include "scene/mesh.h"
#include "tests/support/test.h"

namespace nephroid::test {

/// Where a ray's line meets an ellipsoid, in lengths of the direction: |M (o - c) + t M d| = 1. Both are NAN where it
/// does not.
inline std::array<double, 2> both_hits(const scene::Ellipsoid& ellipsoid, const glm::dvec3& origin,
                                       const glm::dvec3& direction) {
  long double a = 0, b = 0, c = -1;
  for (const glm::dvec3& row : scene::to_unit_sphere(ellipsoid)) {
    long double o = 0, d = 0;
    for (int k = 0; k < 3; ++k) {
      o += static_cast<long double>(row[k]) *
           (static_cast<long double>(origin[k]) - static_cast<long double>(ellipsoid.centre[k]));
      d += static_cast<long double>(row[k]) * static_cast<long double>(direction[k]);
    }
    a += d * d, b += o * d, c += o * o;
  }
  const long double root = std::sqrt(b * b - a * c); // NAN: it passes by
  return {static_cast<double>((-b - root) / a), static_cast<double>((-b + root) / a)};
}

/// The first hit beyond `after`; infinity: none.
inline double first_hit(const scene::Ellipsoid& ellipsoid, const glm::dvec3& origin, const glm::dvec3& direction,
                        double after = 0) {
  const auto [near, far] = both_hits(ellipsoid, origin, direction);
  return near > after ? near : far > after ? far : std::numeric_limits<double>::infinity();
}

/// A sphere of this radius.
inline scene::Ellipsoid sphere_at(const glm::vec3& centre, float radius) {
  return {centre, {{{radius, 0, 0}, {0, radius, 0}, {0, 0, radius}}}, false};
}

} // namespace nephroid::test
