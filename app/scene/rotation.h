// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "preset/preset.h"

#include <glm/glm.hpp>

namespace nephroid::scene {

/// Of preset::Transform::rotate_deg: about x, then y, then z, each counter-clockwise seen from the axis' positive end.
glm::dmat3 rotation(const preset::Vec3& rotate_deg);

} // namespace nephroid::scene
