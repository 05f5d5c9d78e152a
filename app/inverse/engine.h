// SPDX-License-Identifier: Apache-2.0
// Engine 3, inverse caustics: one refractive object that casts several pictures at several distances (thesis chapter
// 5).
#pragma once
#include "engine/engine.h"
#include "mpi/rank_context.h"
#include "preset/preset.h"

namespace nephroid::inverse {

extern const engine::Engine engine;

/// Whether a run of `before` can go on as one of `now` and keep its facets' slopes. The number of receivers must be the
/// same. Their distances, offsets, weights and pictures may differ, and the stop, the camera and names. Methods other
/// than assign begin again unless only the camera or names differ.
bool adoptable(const preset::Preset& before, const preset::Preset& now);

} // namespace nephroid::inverse
