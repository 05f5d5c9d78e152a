// SPDX-License-Identifier: Apache-2.0
// A sphere, or what a scale along its axes makes of it: a surface of its own, not triangles, so that hits and normals are exact.
#pragma once
#include <glm/glm.hpp>

#include <array>

namespace nephroid::scene {

struct Ellipsoid {
  glm::vec3 centre{0};
  std::array<glm::vec3, 3> half_axes{}; ///< perpendicular to each other, from the centre to the surface
  bool inwards = false;                 ///< the normals look towards the centre
};

/// What takes a point's distance from the centre to the unit sphere: the component along a half axis, in lengths of that.
std::array<glm::dvec3, 3> to_unit_sphere(const Ellipsoid& ellipsoid);

bool contains(const Ellipsoid& ellipsoid, const glm::dvec3& point);

/// Half the edges of the box along the coordinate axes about it.
glm::dvec3 half_extent(const Ellipsoid& ellipsoid);

double longest_half_axis(const Ellipsoid& ellipsoid);
double shortest_half_axis(const Ellipsoid& ellipsoid);
double volume_of(const Ellipsoid& ellipsoid);

/// The unit normal where the surface is nearest to the point, to first order; outwards unless it is turned inwards.
glm::dvec3 normal_at(const Ellipsoid& ellipsoid, const glm::dvec3& point);

} // namespace nephroid::scene
