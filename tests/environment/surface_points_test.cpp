// SPDX-License-Identifier: Apache-2.0
// Points all over an object, and what they see past a card that goes by: against closed forms of a ball.
#include "environment/occlusion/samples.h"
#include "tests/support/test.h"

#include "environment/occlusion/occlusion.h"
#include "environment/occlusion/surroundings.h"
#include "tests/environment/bakes.h"
#include "tests/environment/maps.h"

namespace nephroid::surface_points_test {

using namespace nephroid::environment;

glm::dvec3 mean(const std::vector<glm::dvec3>& points)
{
  glm::dvec3 sum(0);
  for (const glm::dvec3& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

TEST(SurfacePoints, LieAllOverABall)
{
  const scene::Scene scene = scene::load_scene(test::bake_preset());
  const std::vector<glm::dvec3> points = surface_points(scene, {0}, 1024);
  ASSERT_EQ(points.size(), 1024U);
  for (const glm::dvec3& point : points) ASSERT_NEAR(glm::length(point), 1, 1e-6);
  EXPECT_LT(glm::length(mean(points)), 0.005);
  for (int axis = 0; axis < 3; ++axis) // by Archimedes
    EXPECT_NEAR(std::ranges::count_if(points, [&](const glm::dvec3& p) { return p[axis] > 0.5; }), 256, 8) << axis;
}

/// A box of 1 x 2 x 3: 2 of 22 parts of its area are each of the two smallest faces.
TEST(SurfacePoints, AreEvenOverTriangles)
{
  const std::string box = R"({"shape": {"type": "box", "size": [1, 2, 3]}, "material": "glass"})";
  const std::vector<glm::dvec3> points = surface_points(scene::load_scene(test::bake_preset(box)), {0}, 1024);
  ASSERT_EQ(points.size(), 1024U);
  const glm::dvec3 half(0.5, 1, 1.5), parts(6, 3, 2);
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0})
      EXPECT_NEAR(std::ranges::count_if(points, [&](const glm::dvec3& p) { return std::abs(p[axis] - side * half[axis]) < 1e-5; }),
                  1024 * parts[axis] / 22, 3)
          << axis << ' ' << side;
  EXPECT_LT(glm::length(mean(points)), 0.03);
}

std::string card(double at)
{
  return fmt::format(
      R"({{"shape": {{"type": "quad", "size": [10, 1, 10]}}, "material": "wall", "transform": {{"translate": [{}, 3, 0]}}}})", at - 5);
}

/// A card before a sun of half a degree straight above a ball: of the ball's surface (1 - x) / 2 are beyond x, where the card's edge is.
TEST(SurfacePoints, SeeACardHideTheSunLittleByLittle)
{
  const CubeMap cube =
      make_cube_map(test::made_map(512, 256, [](const glm::dvec3& d) { return glm::dvec3(d.y > std::cos(0.0087) ? 1e4 : 0.0); }));
  const Segmentation lights = segment(cube, {.lights = 6});
  Occlusion occlusion(test::bake_context(), lights, cube);
  for (const double edge : {-1.2, -0.9, -0.5, -0.2, 0.0, 0.3, 0.6, 0.95, 1.2}) {
    const scene::Scene scene = scene::load_scene(test::bake_preset(test::glass_ball + ", " + card(edge)));
    tracing::World world = surroundings_world(test::bake_context(), without_caster(scene, {0}));
    const std::vector<VisibleLight> seen = occlusion.visible_lights(world, 0, surface_points(scene, {0}, 1024));
    double flux = 0;
    for (const VisibleLight& light : seen) flux += light.flux.y;
    const double expected = std::clamp((1 - edge) / 2, 0.0, 1.0);
    EXPECT_NEAR(flux / lights.total_flux.y, expected, 0.02) << edge;
    for (std::uint32_t pass = 1; pass < 4; ++pass) { // each has all of the light that is seen
      double drawn = 0;
      for (const VisibleLight& light : occlusion.drawn_lights(pass)) drawn += light.flux.y;
      EXPECT_NEAR(drawn, flux, 0.002 * lights.total_flux.y) << edge;
    }
  }
}

} // namespace nephroid::surface_points_test
