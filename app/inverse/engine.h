// SPDX-License-Identifier: Apache-2.0
// Engine 3, inverse caustics: one refractive object that casts several pictures at several distances (thesis, 5).
#pragma once
#include "engine/engine.h"

namespace nephroid::inverse {

extern const engine::Engine engine;

/// Whether a run of `before` can go on as one of `now` and keep its slopes: where only the receivers' distances,
/// offsets, weights and pictures, the stop, the camera and names differ; but for the method assign, only the last two.
bool adoptable(const preset::Preset& before, const preset::Preset& now);

} // namespace nephroid::inverse
