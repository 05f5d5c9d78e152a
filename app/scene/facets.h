// SPDX-License-Identifier: Apache-2.0
// The surface of an object as flat polygons, from which a meter's cells are cut (meter.cpp).
#pragma once
#include "scene/scene.h"

#include <cstddef>
#include <vector>

namespace nephroid::scene {

using Polygon = std::vector<glm::dvec3>;

/// Light on the facets of an ellipsoid is off by less than this.
inline constexpr double rounding_of_ellipsoids = 6e-5;

/// A piece of a surface, before it is cut into cells.
struct Facet {
  Polygon polygon;
  std::size_t side = 0;  ///< what its surface faces most: +x, -x, +y, -y, +z, -z
  double area_scale = 1; ///< of the true surface over the facet's
};

/// Twice the area, along the normal.
glm::dvec3 across(const Polygon& polygon);

/// The part of a polygon where dot(p, way) >= least.
Polygon clipped(const Polygon& polygon, const glm::dvec3& way, double least);

/// The triangles of an object, and facets that are nowhere behind its ellipsoids.
std::vector<Facet> facets_of(const Scene& scene, const Object& object);

} // namespace nephroid::scene
