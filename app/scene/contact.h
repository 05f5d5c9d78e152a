// SPDX-License-Identifier: Apache-2.0
// Glass that stands exactly on something else. Where two surfaces lie in one place, which of them a ray meets first is a matter of
// rounding, and light would be lost between them.
#pragma once
#include "scene/scene.h"

namespace nephroid::scene {

/// Draws in every dielectric whose bounds end where another object's bounds begin, end or lie, so that a gap of air is left which single
/// precision can tell (some 1e-6 of the larger object's coordinates), and says so in scene.warnings. What overlaps is left alone, and so is
/// an ellipsoid that touches in a point.
void part_touching(Scene& scene);

} // namespace nephroid::scene
