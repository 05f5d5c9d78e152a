// SPDX-License-Identifier: Apache-2.0
// Jobs of a scene that is lit as scenes are: by a map and a lamp.
#pragma once
#include "image/image.h"
#include "tests/environment/maps.h"
#include "tests/environment/views.h"

namespace nephroid::test {

class LitBallJobs : public EnvironmentJobs {
protected:
  LitBallJobs() {
    const scene::Environment map = synthetic_maps(64)[1].map;
    image::write_exr(cache.path() / "map.exr", {map.width, map.height, {"R", "G", "B"}, map.rgb, {}});
  }

  /// The ball above a floor under the map and the lamp, badly baked: 4,000 photons a direction onto spheres of 16 x 16
  /// texels.
  preset::Preset lit(const preset::Overrides& more = {}) const {
    preset::Overrides overrides{"stop.passes=2", "environment.photons=4000", "environment.spheres=4",
                                "environment.resolution=16"};
    overrides.insert(overrides.end(), more.begin(), more.end());
    preset::Preset p = ball_and(facing_quad("floor", {0, -1.5, 0}, {0, 1, 0}, 8), overrides);
    p.scene.environment.emplace();
    p.scene.environment->file = (cache.path() / "map.exr").string();
    p.scene.lights = {lamp({0.3, -1, 0.2}, 3)};
    look(p, {2, 2, 4}, {0, -0.5, 0}, 50);
    return p;
  }
};

} // namespace nephroid::test
