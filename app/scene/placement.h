// SPDX-License-Identifier: Apache-2.0
// Objects and lamps that are misplaced.
#pragma once
#include "preset/preset.h"
#include "scene/scene.h"

#include <cstddef>
#include <string>
#include <vector>

namespace nephroid::scene {

/// [object]: the first one of the same shape or mesh in the same place, which may be itself.
std::vector<std::size_t> first_copies(const preset::Scene& scene);

/// A sentence on each lamp that lies in the surface of something, or is inside of what lets no light out while the
/// camera is not.
std::vector<std::string> hidden_lamps(const Scene& scene);

} // namespace nephroid::scene
