// SPDX-License-Identifier: Apache-2.0
// Engine 2, caustics under environment light (thesis chapter 3): what glass does to light is baked.
#pragma once
#include "engine/engine.h"

namespace nephroid::environment {

extern const engine::Engine engine;

/// Whether a job of `before` goes on with `now` and the same bake: only the camera, light, places of objects, the
/// medium, `cast`, the segmentation, white, name or description may differ.
bool adoptable(const preset::Preset& before, const preset::Preset& now);

} // namespace nephroid::environment
