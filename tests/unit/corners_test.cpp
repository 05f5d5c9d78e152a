// SPDX-License-Identifier: Apache-2.0
// The corners of an object's triangles, the box about them, and objects whose triangles the scene does not hold.
#include "scene/scene.h"
#include "spectral/clusters/clusters.h"
#include "tests/support/errors.h"
#include "tests/support/presets.h"

namespace nephroid::corners_test {

using namespace nephroid::scene;

/// A box about the origin and a quad beside it.
Scene box_and_quad()
{
  preset::Preset p = test::empty_preset(4);
  p.scene.materials["glass"] = test::glass(1.5);
  p.scene.materials["white"] = test::white();
  p.scene.objects = {test::object("box", test::box(2, 4, 6), "glass"),
                     test::object("floor", test::quad(10, 8), "white", test::at({0, -3, 1}))};
  return load_scene(p);
}

TEST(Corners, AreThoseOfTheObjectAlone)
{
  const Scene scene = box_and_quad();
  const Bounds box = bounds_of(scene, scene.objects[0]), floor = bounds_of(scene, scene.objects[1]);
  EXPECT_EQ(scene.origin + box.low, glm::dvec3(-1, -2, -3));
  EXPECT_EQ(scene.origin + box.high, glm::dvec3(1, 2, 3));
  EXPECT_EQ(scene.origin + floor.low, glm::dvec3(-5, -3, -3));
  EXPECT_EQ(scene.origin + floor.high, glm::dvec3(5, -3, 5));
  int corners = 0;
  for_each_corner(scene, scene.objects[0], [&](const glm::dvec3& corner) {
    ++corners;
    EXPECT_EQ(glm::abs(scene.origin + corner), glm::dvec3(1, 2, 3));
  });
  EXPECT_EQ(corners, 3 * 12);
  for_each_corner_index(scene, scene.objects[1], [&](std::uint32_t vertex) { EXPECT_LT(vertex, scene.geometry.positions.size()); });
}

TEST(Corners, WithoutTrianglesThereIsNoBox)
{
  Object nothing;
  const Bounds bounds = bounds_of(box_and_quad(), nothing);
  EXPECT_GT(bounds.low.x, bounds.high.x);
  EXPECT_EQ(enclosing(bounds, {glm::dvec3(1), glm::dvec3(2)}).high, glm::dvec3(2));
}

// Panels have scenes of materials and objects alone.
TEST(Corners, TrianglesThatTheSceneDoesNotHoldAreRefused)
{
  Scene outline = box_and_quad();
  const std::vector<Object> objects = outline.objects;
  for (const auto& [first, count] : {std::pair{13u, 2u}, {14u, 1u}, {15u, 0u}, {~0u, 2u}, {2u, ~0u}}) {
    outline.objects[1].first_triangle = first;
    outline.objects[1].triangle_count = count;
    EXPECT_THAT(error_of([&] { bounds_of(outline, outline.objects[1]); }).line(),
                HasSubstr("object 'floor' has triangles that the scene does not hold"))
        << first << " " << count;
  }
  outline.objects = objects;
  outline.geometry = {};
  outline.materials[0].absorbs = true;
  outline.materials[0].k.fill(1e-6);
  EXPECT_EQ(error_of([&] { spectral::split_by_losses({{0, 1}}, outline, 8, 0.1); }).kind(), ErrorKind::failed);
}

} // namespace nephroid::corners_test
