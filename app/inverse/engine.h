// SPDX-License-Identifier: Apache-2.0
// Engine 3, inverse caustics: one refractive object that casts several pictures at several distances (thesis chapter
// 5).
#pragma once
#include "engine/engine.h"
#include "mpi/rank_context.h"
#include "preset/preset.h"

namespace nephroid::inverse {

extern const engine::Engine engine;

/// Whether a run of `before` may go on as one of `now` and keep its facets' slopes: only what as many receivers say
/// differs (distances, offsets, weights, pictures), or the stop; or the camera or a name. Methods other than assign
/// begin again for all but the last two.
bool adoptable(const preset::Preset& before, const preset::Preset& now);

} // namespace nephroid::inverse
