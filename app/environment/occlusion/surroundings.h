// SPDX-License-Identifier: Apache-2.0
// What stands around the object whose caustics are shown: what hides the environment from it, and what its caustics fall on.
#pragma once
#include "scene/bvh.h"
#include "scene/scene.h"
#include "tracing/world.h"

#include <cstddef>
#include <vector>

namespace nephroid::environment {

/// The scene without the caster, in the same coordinates: the other objects with their geometry, the materials and the camera. It has no
/// lights, no environment and no warnings, which may be large and which nobody asks of it. caster: indices into scene.objects, as
/// Caster::objects; the others keep their order.
scene::Scene without_caster(const scene::Scene& scene, const std::vector<std::size_t>& caster);

/// The surroundings on a device, with their tree.
/// Throws failed where the device has not enough memory.
tracing::World surroundings_world(const compute::Context& context, const scene::Scene& surroundings);

} // namespace nephroid::environment
