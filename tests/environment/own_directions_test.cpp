// SPDX-License-Identifier: Apache-2.0
// Directions of lights that are baked while they are shown: which are kept, that they do not depend on each other, and what they are for.
#include "environment/bake/own_directions.h"

#include "tests/environment/views.h"
#include "tests/support/errors.h"
#include "tests/support/saved_jobs.h"

namespace nephroid::own_directions_test {

void finish(environment::OwnDirections& own)
{
  while (!own.complete()) own.step();
}

TEST(OwnDirections, KeepWhatIsWantedAgain)
{
  const environment::BakeTask task =
      environment::make_task(bake_preset(glass_ball, {"environment.resolution=16", "environment.spheres=4", "environment.photons=500"}));
  EXPECT_EQ(task.own_radii.size(), 16u);
  EXPECT_EQ(task.own_radii.back(), task.radii.back());
  const glm::dvec3 a = glm::normalize(glm::dvec3(1, -2, 0.5)), b = glm::normalize(glm::dvec3(-1, -1, 0.2)), c(0, 0, 1);
  environment::OwnDirections own(task, bake_context());
  EXPECT_TRUE(own.complete());
  own.want({a, b});
  EXPECT_FALSE(own.complete());
  finish(own);
  const environment::Bake first = own.bake();
  own.want({c, b});
  ASSERT_EQ(own.bake().baked.size(), 1u);
  EXPECT_EQ(own.bake().directions, (std::vector<glm::dvec3>{b, c}));
  finish(own);
  // The same whatever was baked before.
  environment::OwnDirections other(task, bake_context());
  other.want({b, c});
  finish(other);
  EXPECT_EQ(own.bake().halves, other.bake().halves);
  EXPECT_EQ(own.bake().ways, other.bake().ways);
  EXPECT_NE(own.bake().halves, first.halves);
  own.want({});
  EXPECT_TRUE(own.complete());
  EXPECT_TRUE(own.bake().halves.empty());
}

class EnvironmentOwnDirections : public EnvironmentJobs {};

// A flat glass ellipsoid under a lamp half way between baked directions, on a floor of its own. The reference has the lamp's direction
// among 386 that are baked; the picture without own directions has four of 26 that are 22 degrees away.
TEST_F(EnvironmentOwnDirections, ALampBetweenBakedDirectionsHasSharpCaustics)
{
  const auto picture = [&](int directions, int own) {
    preset::Preset p = bake_preset(
        R"({"name": "lens", "shape": {"type": "sphere", "radius": 1}, "material": "glass", "transform": {"scale": [1, 0.4, 1]}}, )" +
            facing_quad("floor", {0, -1.2, 0}, {0, 1, 0}, 8),
        {"environment.resolution=32", "environment.spheres=16", "environment.photons=20000", "environment.reach=2", "stop.passes=8",
         "scene.camera.resolution=[48, 48]", fmt::format("environment.directions={}", directions),
         fmt::format("environment.own_directions={}", own)});
    // Of the 386 points of a cube's surface (1, 4, 1) of 4.
    p.scene.lights = {lamp(glm::normalize(glm::dvec3(1, -4, 1)), 3)};
    look(p, {0, 4, 0.1}, {0, -1.2, 0}, 60);
    return layer_rgb(run(p), "caustic");
  };
  const auto distance = [](const std::vector<float>& a, const std::vector<float>& b) {
    double off = 0, length = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      off += std::pow(a[i] - b[i], 2);
      length += std::pow(b[i], 2);
    }
    return std::sqrt(off / length);
  };
  const std::vector<float> reference = picture(386, 0), blended = picture(26, 0), own = picture(26, 4);
  fmt::print("rel_l2 of the caustic layer: blended {:.3f}, own {:.3f}\n", distance(blended, reference), distance(own, reference));
  EXPECT_LT(distance(own, reference), 0.5 * distance(blended, reference));
}

} // namespace nephroid::own_directions_test
