// SPDX-License-Identifier: Apache-2.0
// How near and how far the surface of a baked scene is, as seen from (0, 0, 0), the middle of its spheres.
#pragma once
#include "scene/scene.h"

namespace nephroid::environment {

struct Extent {
  double nearest = 0;        ///< of the surface that air touches, which light may leave
  double farthest = 0;       ///< of all of it
  bool middle_inside = true; ///< whether an object encloses the middle
};

/// What lies inside another object of glass is not the surface: liquid behind the wall of its glass. Of a triangle or an ellipsoid that
/// does so in part, a few points tell. `nearest` is a lower bound where an ellipsoid that is no sphere is off the middle, `farthest` an
/// upper one.
Extent extent_of(const scene::Scene& scene);

} // namespace nephroid::environment
