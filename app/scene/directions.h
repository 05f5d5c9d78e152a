// SPDX-License-Identifier: Apache-2.0
// Directions and places that a preset gives, for cameras and lights.
#pragma once
#include "scene/scene.h"

namespace nephroid::scene {

/// The unit vector along v. Throws bad_input at where: no length, not finite.
glm::dvec3 unit_direction(const glm::dvec3& v, const Location& where);

/// The part of up that is perpendicular to the unit vector forward, made unit. Throws bad_input at where: parallel, no
/// length.
glm::dvec3 perpendicular_up(const preset::Vec3& up, const glm::dvec3& forward, const Location& where);

/// A preset's position in the scene's coordinates. Throws bad_input at where: not finite, too far from the objects.
glm::dvec3 local_position(const preset::Vec3& position, const Scene& scene, const Location& where);

} // namespace nephroid::scene
