// SPDX-License-Identifier: Apache-2.0
// What stands around the object whose caustics are shown: what hides the environment from it, and what its caustics fall on.
#pragma once
#include "scene/scene.h"

#include <cstddef>

namespace nephroid::environment {

/// The scene without one object, in the same coordinates: the other objects with their geometry, the materials and the camera. It has no
/// lights, no environment and no warnings, which may be large and which nobody asks of it. caster: an index into scene.objects, as
/// caster_index gives; objects after it have numbers lower by one.
scene::Scene without_caster(const scene::Scene& scene, std::size_t caster);

} // namespace nephroid::environment
