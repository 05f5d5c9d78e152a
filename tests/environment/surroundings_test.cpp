// SPDX-License-Identifier: Apache-2.0
// The scene without the object whose caustics are shown, against the scene that a preset without it makes.
#include "environment/occlusion/surroundings.h"
#include "tests/support/loaded_scenes.h"

namespace nephroid::surroundings_test {

using environment::without_caster;
using preset::Shape;

/// Box, balls, cylinder and quad; the camera is in the box and in one of the balls.
preset::Preset crowd()
{
  preset::Preset preset = test::ball_over_floor();
  preset.scene.objects = {test::shape_object("room", Shape::Type::box, "glass"), test::shape_object("ball", Shape::Type::sphere, "mirror"),
                          test::shape_object("post", Shape::Type::cylinder, "glass"),
                          test::shape_object("lens", Shape::Type::sphere, "glass"), test::shape_object("floor", Shape::Type::quad, "wall")};
  const double places[] = {0, -20, 0, 2.5, 0};
  for (std::size_t i = 0; i < 5; ++i) preset.scene.objects[i].transform.translate = {places[i], -0.1, 0};
  preset.scene.objects[0].transform.scale = {12, 12, 12};
  preset.scene.objects[1].transform.scale = {2, 1, 3};
  preset.scene.camera.position = {2.5, 0, 0.1};
  return preset;
}

/// The corners of an object's triangles one after the other, in the preset's coordinates.
std::vector<glm::dvec3> corners(const scene::Scene& scene, const scene::Object& object)
{
  std::vector<glm::dvec3> found;
  for_each_corner(scene, object, [&](const glm::dvec3& corner) { found.push_back(scene.origin + corner); });
  return found;
}

class Without : public testing::TestWithParam<std::size_t> {};

INSTANTIATE_TEST_SUITE_P(EachOne, Without, testing::Range<std::size_t>(0, 5));

TEST_P(Without, TheRestIsWhatAPresetWithoutItMakes)
{
  preset::Preset preset = crowd();
  const scene::Scene whole = scene::load_scene(preset);
  const scene::Scene rest = without_caster(whole, {GetParam()});
  preset.scene.objects.erase(preset.scene.objects.begin() + static_cast<std::ptrdiff_t>(GetParam()));
  const scene::Scene expected = scene::load_scene(preset);

  ASSERT_EQ(rest.objects.size(), 4u);
  EXPECT_EQ(rest.origin, whole.origin);
  EXPECT_EQ(rest.geometry.positions.size(), expected.geometry.positions.size());
  EXPECT_EQ(rest.geometry.normals.size(), expected.geometry.normals.size());
  EXPECT_EQ(rest.object_of_primitive, expected.object_of_primitive);
  EXPECT_EQ(rest.camera.inside, expected.camera.inside);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(rest.objects[i].name, expected.objects[i].name);
    EXPECT_EQ(rest.objects[i].material, expected.objects[i].material);
    const std::vector<glm::dvec3> a = corners(rest, rest.objects[i]), b = corners(expected, expected.objects[i]);
    ASSERT_EQ(a.size(), b.size());
    // Glass that touches what is taken away is shrunk by some 3e-5 in the whole scene (scene/move.cpp).
    for (std::size_t k = 0; k < a.size(); ++k) EXPECT_LT(glm::distance(a[k], b[k]), 1e-4) << k;
  }
}

TEST(WithoutCaster, TheCameraKnowsTheOthersByTheirNewNumbers)
{
  const scene::Scene whole = scene::load_scene(crowd());
  ASSERT_THAT(whole.camera.inside, ElementsAre(0, 3));
  EXPECT_THAT(without_caster(whole, {0}).camera.inside, ElementsAre(2));
  EXPECT_THAT(without_caster(whole, {2}).camera.inside, ElementsAre(0, 2));
  EXPECT_THAT(without_caster(whole, {3}).camera.inside, ElementsAre(0));
  EXPECT_THAT(without_caster(whole, {4}).camera.inside, ElementsAre(0, 3));
  EXPECT_THAT(without_caster(whole, {0, 2}).camera.inside, ElementsAre(1));
  EXPECT_THAT(without_caster(whole, {1, 4}).camera.inside, ElementsAre(0, 2));
}

TEST(WithoutCaster, OfOneObjectNothingIsLeft)
{
  preset::Preset preset = test::ball_over_floor();
  preset.scene.objects.resize(1);
  const scene::Scene rest = without_caster(scene::load_scene(preset), {0});
  EXPECT_THAT(rest.objects, IsEmpty());
  EXPECT_THAT(rest.object_of_primitive, IsEmpty());
  EXPECT_THAT(rest.geometry.positions, IsEmpty());
  EXPECT_THAT(rest.geometry.ellipsoids, IsEmpty());
}

} // namespace nephroid::surroundings_test
