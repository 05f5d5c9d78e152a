// SPDX-License-Identifier: Apache-2.0
// What a picture depends on, as one number: checkpoints and references are bound to it.
#pragma once
#include "base/hash.h"
#include "preset/preset.h"
#include "scene/scene.h"

#include <cstdint>

namespace nephroid::run {

/// Of the settings that a picture's sums depend on (not: names, descriptions, stop, reference, mask) and of what the files that the preset
/// names held when the scene was loaded from it.
std::uint64_t content_hash(const preset::Preset& preset, const scene::Scene& scene);

} // namespace nephroid::run
