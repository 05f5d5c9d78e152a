// SPDX-License-Identifier: Apache-2.0
// Vectors of a preset on their way into the scene: checked, in double, then rounded once. Private to scene/.
#pragma once
#include "base/place.h"
#include "preset/preset.h"
#include "scene/scene.h"

#include <glm/glm.hpp>

#include <string>

namespace nephroid::scene {

/// Beyond this a squared area no longer fits into single precision. In the preset's unit, from Scene::origin.
inline constexpr double max_coordinate = 1e9;

inline glm::dvec3 to_dvec3(const preset::Vec3& v) { return {v[0], v[1], v[2]}; }

/// The unit vector along v. Throws bad_input at where: no length, not finite.
glm::dvec3 unit_direction(const glm::dvec3& v, const Place& where);
/// The part of up that is perpendicular to the unit vector forward, made unit. Throws bad_input at where: parallel, no length.
glm::dvec3 perpendicular_up(const preset::Vec3& up, const glm::dvec3& forward, const Place& where);
/// A preset's position in the scene's coordinates. Throws bad_input at where: not finite, too far from the objects.
glm::dvec3 local_position(const preset::Vec3& position, const Scene& scene, const Place& where);

} // namespace nephroid::scene
