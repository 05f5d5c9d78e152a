// SPDX-License-Identifier: Apache-2.0
// The finished object as glass, rendered by engine 1: each receiver shows its picture, right way up and not mirrored.
#include "image/image.h"
#include "preset/read.h"
#include "tests/support/program_test.h"

#include <glm/glm.hpp>

namespace nephroid::glass_view_test {

using nephroid::preset::Camera;

glm::dvec3 vec(const nephroid::preset::Vec3& v) { return {v[0], v[1], v[2]}; }

/// The pixel that a pinhole camera sees a point in.
glm::dvec2 pixel(const Camera& camera, const glm::dvec3& point)
{
  const glm::dvec3 ahead = glm::normalize(vec(camera.target) - vec(camera.position)),
                   right = glm::normalize(glm::cross(ahead, vec(camera.up))), up = glm::cross(right, ahead),
                   to = point - vec(camera.position);
  const double height = camera.resolution[1], per_slope = height / 2 / std::tan(glm::radians(camera.fov_deg / 2));
  return {camera.resolution[0] / 2.0 + per_slope * glm::dot(to, right) / glm::dot(to, ahead),
          height / 2 - per_slope * glm::dot(to, up) / glm::dot(to, ahead)};
}

class GlassView : public ProgramTest {
protected:
  /// Mean grey of the pixels about a point of the scene.
  static double grey(const nephroid::image::Image& picture, const Camera& camera, const glm::dvec3& point)
  {
    const glm::dvec2 at = pixel(camera, point);
    double sum = 0;
    constexpr int reach = 9;
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x)
        sum += picture.data.at(picture.channels.size() *
                               static_cast<std::size_t>((static_cast<int>(at.y) + y) * picture.width + static_cast<int>(at.x) + x));
    return sum / ((2 * reach + 1) * (2 * reach + 1));
  }
};

// Both pictures grow brighter to the right and to the top: the four corners tell mirrored and upside down ones apart.
TEST_F(GlassView, ShowsThePicturesAsAPersonSeesThem)
{
  write("two.json", R"({
    "engine": "inverse", "unit": "mm", "scene": {"camera": {"resolution": [64, 64]}},
    "inverse": {"facets": [64, 64], "cells": [24, 24], "receivers": [
      {"distance_mm": 150, "picture": {"type": "gradient", "turn_deg": 45}},
      {"distance_mm": 300, "picture": {"type": "gradient", "turn_deg": 45}}]},
    "stop": {"passes": 3}})");
  Ended ended = run({"run", "two.json", "-o", "out"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  ended = run({"run", "out/view.json", "-o", "view", "--passes", "2"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.err, testing::Not(testing::HasSubstr("hole"))) << "the glass is closed";
  const nephroid::preset::Preset view = nephroid::preset::read_preset((folder / "out/view.json").string());
  const nephroid::image::Image picture = nephroid::image::read_image(folder / "view/image.exr");
  const auto at = [&](std::size_t receiver, double x, double y) {
    for (const nephroid::preset::Object& object : view.scene.objects)
      if (object.name == "receiver " + std::to_string(receiver))
        return grey(picture, view.scene.camera, vec(object.transform.translate) + glm::dvec3(x, y, 0));
    throw std::out_of_range("no receiver " + std::to_string(receiver));
  };
  for (const std::size_t receiver : {1u, 2u}) {
    const double bright = at(receiver, 33, 33), right = at(receiver, 33, -33), left = at(receiver, -33, 33), dark = at(receiver, -33, -33);
    EXPECT_GT(bright, 1.2 * std::max(right, left)) << receiver;
    EXPECT_LT(dark, std::min(right, left) / 1.2) << receiver;
  }
}

} // namespace nephroid::glass_view_test
