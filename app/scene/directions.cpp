// SPDX-License-Identifier: Apache-2.0
#include "scene/directions.h"

#include "base/error.h"
#include "scene/object_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nephroid::scene {

glm::dvec3 unit_direction(const glm::dvec3& v, const Location& where) {
  const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  const bool finite = std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  if (!finite || largest == 0)
    throw bad_input(where, fmt::format("({:g}, {:g}, {:g}) has no direction", v.x, v.y, v.z), "a vector with a length");
  return glm::normalize(v / largest); // so that no square overflows or vanishes
}

glm::dvec3 perpendicular_up(const preset::Vec3& up, const glm::dvec3& forward, const Location& where) {
  const glm::dvec3 unit_up = unit_direction(to_dvec3(up), where);
  const glm::dvec3 rest = unit_up - glm::dot(unit_up, forward) * forward;
  if (!(glm::length(rest) > 1e-6))
    throw bad_input(where,
                    fmt::format("({:g}, {:g}, {:g}) is parallel to the view or light direction", up[0], up[1], up[2]),
                    "another direction", "turn it away");
  return glm::normalize(rest);
}

glm::dvec3 local_position(const preset::Vec3& position, const Scene& scene, const Location& where) {
  const glm::dvec3 local = to_dvec3(position) - scene.origin;
  for (int axis = 0; axis < 3; ++axis)
    if (!(std::abs(local[axis]) <= max_coordinate))
      throw bad_input(where, fmt::format("({:g}, {:g}, {:g}) is too far away", position[0], position[1], position[2]),
                      fmt::format("at most {:g} units from the refracting and mirroring objects", max_coordinate),
                      "choose a larger unit");
  return local;
}

} // namespace nephroid::scene
