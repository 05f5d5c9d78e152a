// SPDX-License-Identifier: Apache-2.0
// Objects and lamps that are misplaced.
#pragma once
#include "preset/preset.h"
#include "scene/bvh.h"
#include "scene/meter.h"
#include "scene/scene.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::scene {

/// [object]: the first one of the same shape or mesh in the same place, which may be itself.
std::vector<std::size_t> first_copies(const preset::Scene& scene);

/// A sentence on each lamp that lies in the surface of something, or is inside of what lets no light out while the
/// camera is not.
std::vector<std::string> hidden_lamps(const Scene& scene);

/// A sentence on a meter in the air that has what lets no light through right before it, closer than a cell is wide:
/// it lies just behind a surface, or looks at one.
std::optional<std::string> covered(const MeterSurface& meter, const Scene& scene, const Bvh& bvh);

} // namespace nephroid::scene
