// SPDX-License-Identifier: Apache-2.0
// The scene that shows an object as glass: what passes the object is stopped.

#include "inverse/glass_view.h"
#include "inverse/light.h"
#include "inverse/plan.h"
#include "preset/read.h"
#include "tests/support/test.h"

namespace nephroid::glass_view_test {

struct Strip {
  glm::dvec2 middle, half;
};

/// Strips over each receiver, in millimetres from the object's middle.
struct Masked {
  inverse::Layout layout;
  std::vector<std::vector<Strip>> strips;
};

Masked masked(const std::string& settings) {
  const preset::Preset preset = preset::parse_preset(
      R"({"engine": "inverse", "unit": "mm", "scene": {"camera": {}}, "inverse": )" + settings + "}", "p.json");
  const inverse::InversePlan plan = inverse::make_plan(preset);
  const preset::Preset view =
      preset::parse_preset(inverse::glass_view(plan.design->layout, plan.design->targets, preset), "view.json");
  Masked made{plan.design->layout, {}};
  double column = 0;
  std::vector<Strip> found;
  for (auto object = view.scene.objects.rbegin(); object != view.scene.objects.rend();
       ++object) { // strips follow their object
    const glm::dvec2 at(object->transform.translate[0], object->transform.translate[1]);
    if (object->name.starts_with("mask"))
      found.push_back({at, glm::dvec2(object->shape->size[0], object->shape->size[2]) / 2.0});
    if (!object->name.starts_with("object")) continue;
    column = at.x;
    for (Strip& strip : found) strip.middle.x -= column;
    made.strips.insert(made.strips.begin(), std::exchange(found, {}));
  }
  return made;
}

constexpr const char* receivers = R"("facets": [16, 16], "cells": [16, 16], "index": 1.5,
  "receivers": [{"distance_mm": 150, "picture": {"type": "disc"}}, {"distance_mm": 250, "offset_mm": [20, 0], "picture": {"type": "disc"}}]})";

// Straight light comes to every place of a receiver through the object or not at all.
TEST(GlassViewMask, StopsWhatWouldPassTheObject) {
  for (const std::string light : {"", R"("light": {"type": "parallel", "tilt_deg": 5, "turn_deg": 30}, )"}) {
    const Masked m =
        masked(R"({"size_mm": [60, 80], "receiver_mm": [90, 100], "thickness_mm": 20, )" + light + receivers);
    const glm::dvec3 falls = inverse::light_ray(m.layout, {0, 0, m.layout.thickness}).direction;
    ASSERT_EQ(m.strips.size(), 2u);
    for (const std::size_t j : {0u, 1u})
      for (int k = 0; k < 41 * 41; ++k) {
        const glm::dvec2 on_receiver = (glm::dvec2(k % 41, k / 41) / 40.0 - 0.5) * m.layout.receiver;
        const glm::dvec2 p = m.layout.offset(j) + on_receiver +
                             glm::dvec2(falls) / falls.z * (m.layout.distances[j] + m.layout.thickness);
        bool stopped = glm::all(glm::lessThanEqual(glm::abs(p), m.layout.size / 2.0 + 1e-6));
        for (const Strip& strip : m.strips[j])
          stopped |= glm::all(glm::lessThanEqual(glm::abs(p - strip.middle), strip.half + 1e-6));
        EXPECT_TRUE(stopped) << light << j << ": " << p.x << ", " << p.y;
      }
    for (const Strip& strip : m.strips[0]) // none is over the object
      EXPECT_TRUE(glm::any(glm::greaterThan(glm::abs(strip.middle) + 1e-6, m.layout.size / 2.0 + strip.half)));
  }
}

TEST(GlassViewMask, IsNotThereWhereNothingPasses) {
  const Masked m =
      masked(R"({"size_mm": [140, 120], "receiver_mm": [90, 100], "thickness_mm": 20, )" + std::string(receivers));
  for (const auto& strips : m.strips) EXPECT_TRUE(strips.empty());
}

preset::Preset view_of(const std::string& settings) {
  const preset::Preset preset = preset::parse_preset(
      R"({"engine": "inverse", "unit": "mm", "scene": {"camera": {}}, "inverse": {)" + settings + receivers + "}",
      "p.json");
  const inverse::InversePlan plan = inverse::make_plan(preset);
  return preset::parse_preset(inverse::glass_view(plan.design->layout, plan.design->targets, preset), "view.json");
}

// What blurred the judge's light blurs the view's: the disc, a rough surface as a wider one, and a band's colours.
TEST(GlassViewBlur, IsThatOfTheJudge) {
  const auto disc = [](const std::string& settings) {
    return view_of(settings).scene.lights.at(0).angular_diameter_deg;
  };
  EXPECT_EQ(disc(""), 0);
  EXPECT_NEAR(disc(R"("sun_deg": 0.53, )"), 0.53, 1e-9);
  EXPECT_NEAR(disc(R"("scatter_deg": 0.1, )"), 0.4, 1e-5);
  EXPECT_NEAR(disc(R"("scatter_deg": 0.1, "sun_deg": 0.3, )"), 0.5, 1e-5);
  EXPECT_NEAR(disc(R"("front_elevation_deg": 37.5, "light": {"type": "sun", "place": {"latitude_deg": 52.5,
    "longitude_deg": 13.4, "date": "2026-03-20", "utc_offset_h": 1, "hour": 12}}, )"),
              0.533, 1e-9);
  EXPECT_THAT(view_of(R"("scatter_deg": 0.1, )").description, testing::HasSubstr("a wider sun stands for the scatter"));
  EXPECT_EQ(disc(R"("scatter_deg": 6, )"), 10);
  EXPECT_THAT(view_of(R"("scatter_deg": 6, )").description, testing::HasSubstr("degrees would blur more than"));
}

} // namespace nephroid::glass_view_test
