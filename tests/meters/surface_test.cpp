// SPDX-License-Identifier: Apache-2.0
// The cells of meters, on the host: their areas, where they are, what is refused.
#include "preset/meters.h"
#include "preset/read.h"
#include "scene/meter.h"
#include "tests/support/loaded_scenes.h"

#include <nlohmann/json.hpp>

namespace nephroid::surface_test {

using preset::Meter;

scene::MeterSurface surface_of(const preset::Preset& preset, const Meter& meter) {
  return scene::make_meter(meter, scene::load_scene(preset), Location("p.json") / "scene" / "meters" / 0);
}

std::string meter_refusal(const preset::Preset& preset, const Meter& meter) {
  return refusal_of([&] { surface_of(preset, meter); });
}

double area(const scene::MeterSurface& surface) {
  return std::accumulate(surface.areas.begin(), surface.areas.end(), 0.0);
}

Meter on(const std::string& object, double cell = 0.1) {
  return {.type = Meter::Type::surface, .name = "meter", .object = object, .cell = cell};
}

/// The object turned and moved, so that nothing hangs on axes.
preset::Preset object_of(preset::Shape::Type shape, const preset::Transform& transform = {}) {
  preset::Preset preset{.source = "p.json"};
  preset.scene.materials["wall"];
  preset.scene.objects = {shape_object("object", shape, "wall", transform)};
  return preset;
}

const preset::Transform aslant{.scale = {2, 1, 3}, .rotate_deg = {30, 40, 50}, .translate = {5, 6, 7}};

TEST(MeterSurface, ATurnedRectangleIsItsOwnGrid) {
  const scene::MeterSurface surface = surface_of(object_of(preset::Shape::Type::quad, aslant), on("object", 0.5));
  EXPECT_TRUE(surface.is_flat);
  ASSERT_EQ(surface.charts.size(), 1u);
  EXPECT_EQ(surface.count(), 24u);
  EXPECT_NEAR(area(surface), 6, 1e-5);
  for (const double cell : surface.areas) EXPECT_NEAR(cell, 0.25, 1e-6);
  EXPECT_EQ(std::minmax({surface.charts[0].columns, surface.charts[0].rows}), std::pair(4, 6));
}

TEST(MeterSurface, ABoxHasSixSidesAndABallItsArea) {
  const scene::MeterSurface box = surface_of(object_of(preset::Shape::Type::box), on("object", 0.25));
  EXPECT_EQ(box.charts.size(), 6u);
  EXPECT_EQ(box.count(), 96u);
  EXPECT_NEAR(area(box), 6, 1e-6);
  const scene::MeterSurface ball = surface_of(object_of(preset::Shape::Type::sphere), on("object", 0.1));
  EXPECT_NEAR(area(ball), std::numbers::pi, 1e-6);
  for (std::size_t cell = 0; cell < ball.count(); ++cell)
    EXPECT_GT(glm::dot(glm::normalize(ball.centres[cell]), ball.normals[cell]), 0.99);
}

TEST(MeterSurface, FacingAndWithinLeaveAPart) {
  const preset::Preset box = object_of(preset::Shape::Type::box);
  Meter top = on("object", 0.25);
  top.facing = {0, 2, 0};
  EXPECT_NEAR(area(surface_of(box, top)), 1, 1e-6);
  top.within = preset::Box{{0, -9, -0.25}, {9, 9, 9}};
  EXPECT_NEAR(area(surface_of(box, top)), 0.5 * 0.75, 1e-6);
  top.within = preset::Box{{3, 3, 3}, {9, 9, 9}};
  EXPECT_THAT(meter_refusal(box, top), HasSubstr("measures nothing"));
}

TEST(MeterSurface, AFlatObjectIsMeasuredOnTheSideThatItIsToFace) {
  Meter below = on("object");
  const preset::Preset quad = object_of(preset::Shape::Type::quad);
  EXPECT_GT(surface_of(quad, below).normals[0].y, 0.99);
  below.facing = {0, -1, 0};
  EXPECT_LT(surface_of(quad, below).normals[0].y, -0.99);
}

TEST(MeterSurface, ADiscIsNotItsRectangle) {
  const preset::Preset cylinder = object_of(preset::Shape::Type::cylinder); // of radius 0.5
  Meter top = on("object", 0.05);
  top.facing = {0, 1, 0};
  const scene::MeterSurface surface = surface_of(cylinder, top);
  const double polygon = 128 * 0.25 * std::sin(std::numbers::pi / 128) * std::cos(std::numbers::pi / 128) * 2 * 0.5;
  EXPECT_NEAR(area(surface), polygon, 2e-3 * polygon);
  EXPECT_LT(surface.count(), 20u * 20u);
}

TEST(MeterSurface, APlaneAndAPointAreWhereTheySay) {
  const preset::Preset preset = ball_over_floor();
  const Meter plane{.type = Meter::Type::plane,
                    .name = "meter",
                    .position = {1, 2, 3},
                    .normal = {0, 0, 1},
                    .up = preset::Vec3{0, 1, 0},
                    .size = {2, 1},
                    .cell = 0.5};
  const scene::Scene scene = scene::load_scene(preset);
  const scene::MeterSurface surface = surface_of(preset, plane);
  ASSERT_EQ(surface.count(), 8u);
  expect_near(surface.centres[0] + scene.origin, {0.25, 2.25, 3}); // the top left one
  expect_near(surface.normals[0], {0, 0, 1});
  EXPECT_NEAR(
      area(surface_of(preset, {.type = Meter::Type::point, .name = "meter", .position = {3, 0, 0}, .diameter = 0.2})),
      std::numbers::pi * 0.01, 1e-7);
}

TEST(MeterSurface, WhatCannotBeMeasuredIsRefused) {
  const preset::Preset preset = ball_over_floor(); // a glass ball about the origin
  const Meter inside{.type = Meter::Type::point, .name = "meter"};
  EXPECT_THAT(meter_refusal(preset, inside), HasSubstr("is inside of the glass 'ball'"));
  Meter many = on("floor", 0.01);
  EXPECT_THAT(meter_refusal(preset, many), AllOf(HasSubstr("makes 1e+06 cells"), HasSubstr("take a cell of 0.02")));
  const Meter down{.type = Meter::Type::plane,
                   .name = "meter",
                   .position = {0, -0.4999, 0},
                   .normal = {0, 1, 0},
                   .size = {0.01, 0.01}};
  EXPECT_THAT(meter_refusal(preset, down), HasSubstr("turn its normal"));
}

std::string read_refusal(const std::string& meters) {
  return refusal_of([&] {
    preset::read_json(nlohmann::ordered_json::parse(
                          R"({"engine": "spectral", "scene": {"materials": {"m": {"type": "diffuse"}}, "objects":
        [{"name": "floor", "shape": {"type": "quad"}, "material": "m"}], "meters": )" +
                          meters + "}}"),
                      "p.json");
  });
}

TEST(MeterPreset, IsCheckedWhenItIsRead) {
  const std::string floor = R"({"type": "surface", "name": "a", "object": "floor")";
  EXPECT_THAT(read_refusal("[" + floor + R"(, "threshold": "2500"}])"), HasSubstr("W/m^2, kW/m^2, lx"));
  EXPECT_THAT(read_refusal("[" + floor + "}, " + floor + "}]"), HasSubstr("'a' would have the files of meter 0, 'a'"));
  EXPECT_THAT(read_refusal(R"([{"type": "surface", "name": "a", "object": "flor"}])"), HasSubstr("'floor'"));
  EXPECT_THAT(read_refusal(R"([{"type": "plane", "name": "a", "normal": [0, 0, 0]}])"), HasSubstr("has no length"));
  EXPECT_THAT(read_refusal(R"([{"type": "plane", "name": "a", "size": [0, 1]}])"), HasSubstr("/size"));
  EXPECT_THAT(read_refusal("[" + floor + R"(, "within": {"low": [0, 0, 0], "high": [0, 1, 1]}}])"),
              HasSubstr("has no volume"));
}

TEST(MeterPreset, QuantitiesHaveUnits) {
  const auto kilowatts = preset::quantity_in("2.5 kW/m^2");
  ASSERT_TRUE(kilowatts);
  EXPECT_EQ(kilowatts->value * preset::size_of(kilowatts->unit), 2500);
  for (const char* text : {"2500 W/m2", "2500 W/m²", "2500W/m^2 "})
    EXPECT_EQ(preset::quantity_in(text)->unit, Meter::Unit::watts) << text;
  EXPECT_EQ(preset::quantity_in("500lx")->unit, Meter::Unit::lux);
  EXPECT_EQ(preset::quantity_in("3 klx")->unit, Meter::Unit::kilolux);
  for (const char* text : {"", "500", "lx", "-1 lx", "1 W", "x lx", "inf lx"})
    EXPECT_FALSE(preset::quantity_in(text)) << text;
}

TEST(MeterPreset, AThresholdIsOfOneQuantity) {
  Meter meter;
  EXPECT_FALSE(preset::threshold_in(meter, Meter::Unit::watts));
  meter.threshold = "2.5 kW/m^2";
  EXPECT_EQ(preset::threshold_in(meter, Meter::Unit::watts), 2500);
  EXPECT_EQ(preset::threshold_in(meter, Meter::Unit::suns), 2.5);
  EXPECT_FALSE(preset::threshold_in(meter, Meter::Unit::lux));
}

} // namespace nephroid::surface_test
