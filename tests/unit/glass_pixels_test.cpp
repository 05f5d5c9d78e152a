// SPDX-License-Identifier: Apache-2.0
// No path from the eye may meet glass or a mirror first in a pixel that is not on the list; and the list is not the whole picture.
#include "scene/bvh.h"
#include "spectral/sampled_pixels.h"
#include "tests/support/loaded_scenes.h"

namespace nephroid::glass_pixels_test {

constexpr int width = 60, height = 40;

/// A small ball and a large tilted mirror over a floor.
preset::Preset ball_and_mirror(const preset::Vec3& eye)
{
  preset::Preset p;
  p.source = "p.json";
  p.scene.materials["wall"];
  p.scene.materials["mirror"].type = preset::Material::Type::mirror;
  p.scene.materials["glass"].type = preset::Material::Type::dielectric;
  p.scene.objects = {test::shape_object("floor", preset::Shape::Type::quad, "wall"),
                     test::shape_object("ball", preset::Shape::Type::sphere, "glass"),
                     test::shape_object("mirror", preset::Shape::Type::quad, "mirror")};
  p.scene.objects[0].transform.scale = {40, 1, 40};
  p.scene.objects[1].shape->segments = 32;
  p.scene.objects[1].transform.translate = {0.3, 0.6, 0};
  p.scene.objects[2].transform.scale = {3, 1, 9};
  p.scene.objects[2].transform.rotate_deg = {20, 30, -70};
  p.scene.objects[2].transform.translate = {-3, 1.5, 0};
  p.scene.camera.position = eye;
  p.scene.camera.target = {0, 0.5, 0};
  p.scene.camera.resolution = {width, height};
  return p;
}

TEST(GlassPixels, AreAllThatAPathMayMeetGlassIn)
{
  // From far away, from close by, and with the mirror reaching past the camera.
  for (const preset::Vec3& eye : {preset::Vec3{2, 3, 8}, {0.4, 0.9, 1.2}, {-2.2, 2, 3}}) {
    const scene::Scene scene = scene::load_scene(ball_and_mirror(eye));
    const scene::Bvh bvh = scene::build_bvh(scene.geometry);
    const scene::Camera& c = scene.camera;
    std::vector<bool> listed(width * height, false), met(width * height, false);
    for (const std::uint32_t pixel : spectral::glass_pixels(scene)) listed[pixel] = true;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> place(0, 1);
    for (int i = 0; i < 200000; ++i) {
      const double x = width * place(random), y = height * place(random);
      const glm::dvec3 way =
          glm::dvec3(c.forward) + (2 * x / width - 1) * c.tan_x * glm::dvec3(c.right) + (1 - 2 * y / height) * c.tan_y * glm::dvec3(c.up);
      const auto hit = scene::closest_hit(bvh, c.position, way);
      if (hit && scene.object_of_primitive[hit->primitive] != 0)
        met[static_cast<std::size_t>(static_cast<int>(y) * width + static_cast<int>(x))] = true;
    }
    int more = 0, all = 0;
    for (std::size_t i = 0; i < met.size(); ++i) {
      EXPECT_TRUE(listed[i] || !met[i]) << i % width << ", " << i / width;
      more += listed[i] && !met[i];
      all += met[i];
    }
    EXPECT_GT(all, 50);
    EXPECT_LT(more, all); // what stands behind the ball counts, and outlines
  }
}

TEST(GlassPixels, AreNoneWhereNoGlassIsInView)
{
  preset::Preset p = ball_and_mirror({2, 3, 8});
  p.scene.camera.target = {4, 5, 16};
  EXPECT_TRUE(spectral::glass_pixels(scene::load_scene(p)).empty());
}

} // namespace nephroid::glass_pixels_test
