// SPDX-License-Identifier: Apache-2.0
// Engine 2, caustics under environment light (thesis chapter 3): what glass and mirrors do to light is baked once, from
// a few directions.
#pragma once
#include "engine/engine.h"

namespace nephroid::environment {

extern const engine::Engine engine;

/// Whether a job of `before` goes on with `now`, with the same bake: only the camera, light, where objects stand, the
/// medium, `cast`, the segmentation, white, name or description differ.
bool adoptable(const preset::Preset& before, const preset::Preset& now);

} // namespace nephroid::environment
