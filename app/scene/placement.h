// SPDX-License-Identifier: Apache-2.0
// What stands where nobody means it.
#pragma once
#include "preset/preset.h"
#include "scene/scene.h"

#include <cstddef>
#include <set>
#include <utility>

namespace nephroid::scene {

/// Pairs of objects, the first one first, of the same shape or mesh in the same place; of several in one place each
/// with the first.
std::set<std::pair<std::size_t, std::size_t>> copies(const preset::Scene& scene);

/// Says in scene.warnings which lamps are in the surface of something, or inside of what lets no light out while the
/// camera is not. To be called when lights and camera are there.
void warn_of_hidden_lamps(Scene& scene);

} // namespace nephroid::scene
