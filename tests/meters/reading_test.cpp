// SPDX-License-Identifier: Apache-2.0
// Intervals: of numbers whose truth is known, made by a random generator, and of runs against closed forms.
// tests/experiments/meters.py has more of the latter.
#include "meters/map.h"
#include "run/meters.h"
#include "tests/support/presets.h"
#include "tests/support/render.h"
#include "tests/support/saved_jobs.h"
#include "tracing/archive.h"

namespace nephroid::reading_test {

using meters::Interval;
using meters::Quantity;
using preset::Meter;

constexpr std::size_t parts = photons::meter_replicates;

bool holds(const Interval& interval, double truth) { return interval.low <= truth && truth <= interval.high; }

/// A surface of so many cells of one square metre.
scene::MeterSurface cells(std::size_t count) {
  scene::MeterSurface surface;
  surface.areas.assign(count, 1);
  surface.centres.assign(count, glm::dvec3(0));
  surface.normals.assign(count, glm::dvec3(0, 1, 0));
  return surface;
}

/// What a run of independent normal noise would show of these irradiances.
meters::Reading noisy_reading(const std::vector<double>& truth, double noise, std::mt19937& random,
                              const Meter& meter = {}) {
  std::normal_distribution<double> normal(0, 1);
  photons::MeterLayer layer{"direct", {}};
  for (std::size_t part = 0; part < parts; ++part)
    for (const double value : truth) {
      const double shown = value + noise * std::sqrt(double(parts)) * normal(random);
      layer.replicates.insert(layer.replicates.end(), {shown, shown / 2});
    }
  return meters::read(meter, cells(truth.size()), 1, {layer});
}

TEST(MeterReading, IntervalsHoldTheTruthInNinetyFiveOfAHundred) {
  std::mt19937 random(1);
  constexpr int runs = 4000;
  int held = 0;
  for (int run = 0; run < runs; ++run)
    held += holds(noisy_reading({3, 5}, 0.1, random).all().numbers(Quantity::irradiance).mean, 4);
  EXPECT_NEAR(held, 0.95 * runs, 4 * std::sqrt(0.95 * 0.05 * runs));
}

TEST(MeterReading, ThePeakOfNoisyCellsIsNotItsNoise) {
  std::mt19937 random(2);
  // Flat, with one cell above, and rising: the highest of 100 noisy cells is some 2.5 sigma too high.
  std::vector<double> flat(100, 1), one(100, 1), rising;
  one[7] = 1.1;
  for (int i = 0; i < 100; ++i) rising.push_back(1 + 0.002 * i);
  constexpr int runs = 1000;
  for (const std::vector<double>& truth : {flat, one, rising}) {
    int peaks = 0, leasts = 0;
    for (int run = 0; run < runs; ++run) {
      const meters::Reading reading = noisy_reading(truth, 0.02, random);
      const meters::Numbers& numbers = reading.all().numbers(Quantity::irradiance);
      peaks += holds(numbers.peak, std::ranges::max(truth));
      leasts += holds(numbers.least, std::ranges::min(truth));
    }
    EXPECT_GT(peaks, 0.93 * runs);
    EXPECT_GT(leasts, 0.93 * runs);
  }
}

// Noise of colour makes cells with little light negative now and then.
TEST(MeterReading, CellsBelowNothingAreRead) {
  std::mt19937 random(4);
  const meters::Reading reading = noisy_reading({-1, -2, -3}, 0, random);
  EXPECT_EQ(reading.all().numbers(Quantity::irradiance).peak.value, -1);
  EXPECT_EQ(reading.all().numbers(Quantity::irradiance).least.value, -3);
}

TEST(MeterReading, WhatHasNoNoiseHasTheRoundingAlone) {
  std::mt19937 random(3);
  Meter meter;
  meter.threshold = "1.5 W/m^2";
  const meters::Reading reading = noisy_reading({1, 1, 1, 2}, 0, random, meter);
  const meters::Numbers& numbers = reading.all().numbers(Quantity::irradiance);
  EXPECT_DOUBLE_EQ(numbers.mean.value, 1.25);
  EXPECT_NEAR(numbers.mean.half(), 4e-6 * 1.25, 1e-12);
  EXPECT_DOUBLE_EQ(numbers.peak.value, 2);
  EXPECT_EQ(numbers.peak_cell, 3u);
  EXPECT_DOUBLE_EQ(numbers.uniformity.value, 0.8);
  EXPECT_DOUBLE_EQ(numbers.total.value, 5);
  ASSERT_TRUE(reading.share_above);
  EXPECT_DOUBLE_EQ(reading.share_above->low, 0.25);
  EXPECT_DOUBLE_EQ(reading.share_above->high, 0.25);
  EXPECT_DOUBLE_EQ(reading.all().numbers(Quantity::illuminance).mean.value, 683.002 * 1.25 / 2);
}

TEST(MeterReading, AMapHasACellWhereTheSurfaceHas) {
  scene::MeterSurface surface = cells(3);
  surface.charts = {{.columns = 2, .rows = 2}};
  surface.cells = {0, 1, -1, 2};
  std::mt19937 random(4);
  const meters::Reading reading = noisy_reading({1, 2, 3}, 0, random);
  const image::Image picture = meters::picture(surface, 1, reading);
  EXPECT_EQ(picture.width, 2);
  const auto value = [&](std::size_t pixel) { return picture.data[pixel * picture.channels.size()]; };
  EXPECT_EQ(picture.channels[0], "irradiance");
  EXPECT_FLOAT_EQ(value(1), 2);
  EXPECT_FLOAT_EQ(value(2), 0);
  EXPECT_FLOAT_EQ(value(3), 3);
  const std::string table = meters::csv(surface, {10, 0, 0}, 1, reading);
  EXPECT_THAT(table, HasSubstr("\n2,10,0,0,0,1,0,1,3,"));
}

// The end of the colours is the 99th of a hundred values, but what is above the threshold has to be told from what is
// not.
TEST(MeterReading, TheScaleOfAMapReachesAThresholdThatIsMet) {
  std::vector<float> values(1000, 40);
  values.back() = 3000;
  EXPECT_EQ(meters::map_scale(values, std::nullopt), 50);
  EXPECT_EQ(meters::map_scale(values, 2500), 5000);
  EXPECT_EQ(meters::map_scale(values, 3500), 50) << "nothing is above it";
  EXPECT_EQ(meters::map_scale(values, 20), 50);
}

TEST(MeterReading, AMapHasItsThresholdAndItsPeak) {
  scene::MeterSurface surface = cells(100);
  surface.charts = {{.columns = 10, .rows = 10}};
  surface.cells.resize(100);
  std::ranges::generate(surface.cells, [cell = 0]() mutable { return cell++; });
  std::vector<float> values(100, 1);
  values[55] = 9;
  const meters::ColouredMap without = meters::coloured(surface, values, 10, std::nullopt, 200),
                            with = meters::coloured(surface, values, 10, 5, 200);
  const auto greens = [](const meters::ColouredMap& map) {
    int count = 0;
    for (int y = 0; y < map.bitmap.height; ++y)
      for (int x = 0; x < map.bitmap.width; ++x)
        count += map.bitmap.at(x, y) == std::array<unsigned char, 3>{0, 255, 128};
    return count;
  };
  EXPECT_EQ(greens(without), 0);
  EXPECT_GT(greens(with), 40);
  EXPECT_LT(greens(with), 120) << "a line about one cell of 20 x 20 pixels";
  constexpr std::array<unsigned char, 3> white{255, 255, 255};
  EXPECT_EQ(with.bitmap.at(5 * 20 + 10, 5 * 20 + 10), white) << "the cross";
}

TEST(MeterReading, NoEndOfLightIsBelowNothing) {
  const Interval interval = meters::interval_of(std::vector<double>{0, 0, 0, 8}, 0);
  EXPECT_EQ(interval.value, 2);
  EXPECT_EQ(interval.low, 0);
  EXPECT_NEAR(interval.high, 2 + 3.182 * 2, 1e-9); // Student's t of 3, and a standard error of 2
}

// Runs.

preset::Preset room(double reflectance) {
  preset::Preset p;
  p.name = "room";
  p.source = "room.json";
  p.scene.materials = {{"wall", white(reflectance)}, {"glass", glass(1.5)}};
  preset::Shape walls = box(2, 2, 2);
  walls.inwards = true;
  p.scene.objects = {object("room", walls, "wall"), object("ball", check::ball(0.4), "glass")};
  p.scene.lights = {{.position = {0.3, 0.7, 0.2}}};
  p.scene.meters = {{.type = Meter::Type::surface, .name = "walls", .object = "room", .cell = 0.25}};
  return p;
}

meters::Reading measured(const preset::Preset& preset, std::int64_t cycles) {
  const run::Prepared prepared = run::prepare(preset);
  run::Metering metering(prepared, {shared_context(), Communicator(nullptr)});
  while (metering.meters()[0].run->cycles() < cycles) metering.advance();
  return *metering.meters()[0].reading;
}

// Walls take the lamp's watt in the end, after each has sent on half of what falls on it: so what falls on them is 1 /
// (1 - 1/2) W, whatever the glass does with it. It is by all ways: straight, caustics, and from wall to wall.
TEST(MeterRun, AClosedRoomKeepsTheLampsPower) {
  const meters::Reading reading = measured(room(0.5), 4);
  const Interval& total = reading.all().numbers(Quantity::irradiance).total;
  EXPECT_NEAR(reading.extent, 24, 1e-5);
  EXPECT_LT(total.half(), 0.02 * total.value);
  EXPECT_NEAR(total.value, 2, 2 * total.half()); // 5e-6 of all seeds are further off (Student's t of 7)
  double sum = 0;
  for (std::size_t layer = 1; layer < reading.layers.size(); ++layer) {
    EXPECT_GT(reading.layers[layer].numbers(Quantity::irradiance).total.value, 0.05) << reading.layers[layer].name;
    sum += reading.layers[layer].numbers(Quantity::irradiance).total.value;
  }
  EXPECT_NEAR(sum, total.value, 1e-9);
}

// Photons on a round wall, whose cells end at seams between its six charts: all of the lamp's watt, and no cell that
// has the photons of another one's area. A glass ball beside the lamp throws caustics on the wall.
TEST(MeterRun, ABallsCellsGetTheirOwnPhotons) {
  preset::Preset p = room(0);
  p.scene.objects[0].shape = check::ball(1);
  p.scene.objects[0].shape->inwards = true;
  p.scene.lights[0].position = {0, 0.6, 0};
  p.scene.meters[0].cell = 0.1;
  const meters::Reading reading = measured(p, 4);
  const Interval& total = reading.all().numbers(Quantity::irradiance).total;
  EXPECT_NEAR(total.value, 1, 2 * total.half());
  EXPECT_LT(total.half(), 5e-3);
}

// What two boxes hold of the walls is what they hold together.
TEST(MeterRun, PartsOfASurfaceAddUp) {
  preset::Preset p = room(0.5);
  p.scene.meters = {{.type = Meter::Type::surface, .name = "left", .object = "room", .cell = 0.3},
                    {.type = Meter::Type::surface, .name = "right", .object = "room", .cell = 0.3}};
  p.scene.meters[0].within = preset::Box{{-9, -9, -9}, {0.123, 9, 9}};
  p.scene.meters[1].within = preset::Box{{0.123, -9, -9}, {9, 9, 9}};
  const run::Prepared prepared = run::prepare(p);
  run::Metering metering(prepared, {shared_context(), Communicator(nullptr)});
  while (metering.meters()[1].run->cycles() < 4) metering.advance();
  double total = 0, half = 0;
  for (const run::MeterInHand& meter : metering.meters()) {
    total += meter.reading->all().numbers(Quantity::irradiance).total.value;
    half += meter.reading->all().numbers(Quantity::irradiance).total.half();
  }
  EXPECT_NEAR(total, 2, 2 * half);
  EXPECT_LT(half, 0.05);
}

TEST(MeterRun, InTheDarkItMeasuresNought) {
  preset::Preset p = room(0.5);
  p.scene.lights.clear();
  const run::Prepared prepared = run::prepare(p);
  run::Metering metering(prepared, {shared_context(), Communicator(nullptr)});
  EXPECT_THAT(metering.notes(), Contains(AllOf(HasSubstr("walls is dark"), HasSubstr("the scene has no light"))));
  ASSERT_TRUE(metering.advance());
  EXPECT_TRUE(metering.is_enough(1));
  const meters::Numbers& numbers = metering.meters()[0].reading->all().numbers(Quantity::irradiance);
  EXPECT_EQ(numbers.peak.high, 0);
  EXPECT_EQ(numbers.total.high, 0);
}

// A point's light on a cell is its power over 4 pi times the solid angle of the cell: of a cube's side a sixth.
TEST(MeterRun, APlaneInTheAirMeasuresAndBlocksNothing) {
  preset::Preset p = room(0);
  p.scene.objects.pop_back();
  p.scene.lights[0].position = {0, 0, 0};
  p.scene.meters = {{.type = Meter::Type::plane, .name = "air", .position = {0, -0.5, 0}, .size = {1, 1}, .cell = 0.1},
                    {.type = Meter::Type::surface, .name = "walls", .object = "room", .cell = 0.25}};
  const run::Prepared prepared = run::prepare(p);
  run::Metering metering(prepared, {shared_context(), Communicator(nullptr)});
  while (metering.meters()[1].run->cycles() < 4) metering.advance();
  const Interval air = metering.meters()[0].reading->all().numbers(Quantity::irradiance).total,
                 walls = metering.meters()[1].reading->all().numbers(Quantity::irradiance).total;
  EXPECT_NEAR(air.value, 1 / 6.0, 2 * air.half());
  EXPECT_LT(air.half(), 1e-3 * air.value);
  EXPECT_NEAR(walls.value, 1, 2 * walls.half());
}

// Light that glass bends crosses a plane on its way to the floor: both show the same.
TEST(MeterRun, ACausticCrossesAPlaneAsItMeetsAFloor) {
  preset::Preset p;
  p.source = "p.json";
  p.scene.materials = {{"floor", white(0)}, {"glass", glass(1.5)}};
  p.scene.objects = {object("floor", quad(2, 2), "floor", at({0, -1, 0})), object("ball", check::ball(0.6), "glass")};
  p.scene.lights = {{.type = preset::Light::Type::directional}};
  p.scene.meters = {
      {.type = Meter::Type::surface, .name = "floor", .object = "floor", .cell = 0.1},
      {.type = Meter::Type::plane, .name = "air", .position = {0, -0.999, 0}, .size = {2, 2}, .cell = 0.1}};
  const run::Prepared prepared = run::prepare(p);
  run::Metering metering(prepared, {shared_context(), Communicator(nullptr)});
  while (metering.meters()[1].run->cycles() < 2) metering.advance();
  const auto peak = [&](std::size_t meter) {
    return metering.meters()[meter].reading->all().numbers(Quantity::irradiance).peak;
  };
  EXPECT_GT(peak(0).value, 3); // suns
  EXPECT_NEAR(peak(0).value, peak(1).value, 0.02 * peak(0).value);
}

TEST(MeterRun, TheSameSeedGivesTheSameBits) {
  const auto watts = [](std::uint64_t seed) {
    preset::Preset p = room(0.5);
    p.seed = seed;
    return measured(p, 6).all().numbers(Quantity::irradiance).mean.value; // the last by the noise of the first
  };
  EXPECT_EQ(watts(1), watts(1));
  EXPECT_NE(watts(1), watts(2));
}

// After a cycle in which an unbroken run reads nothing: the resumed one reads for its first time, and its work goes on
// where it went.
TEST(MeterRun, ResumedItGoesOnWithTheSameBits) {
  const run::Prepared prepared = run::prepare(room(0.5));
  const auto until = [](run::Metering& metering, std::int64_t cycles) {
    while (metering.meters()[0].run->cycles() < cycles) metering.advance();
  };
  run::Metering whole(prepared, {shared_context(), Communicator(nullptr)}),
      resumed(prepared, {shared_context(), Communicator(nullptr)});
  until(whole, 5);
  EXPECT_TRUE(test::load<tracing::Archive>(resumed, test::saved<tracing::Archive>(whole)));
  until(whole, 12);
  until(resumed, 12);
  const auto mean = [](const run::Metering& metering) {
    return metering.meters()[0].reading->all().numbers(Quantity::irradiance).mean.value;
  };
  EXPECT_EQ(mean(resumed), mean(whole));
}

TEST(MeterRun, SaysWhatItCannotMeasure) {
  preset::Preset p = room(0.5);
  const auto refused = [&](const std::string& only) {
    const run::Prepared prepared = run::prepare(p);
    return refusal_of([&] { run::Metering(prepared, {shared_context(), Communicator(nullptr)}, only); });
  };
  EXPECT_THAT(refused("wals"), HasSubstr("did you mean 'walls'?"));
  p.scene.meters.clear();
  EXPECT_THAT(refused(""), HasSubstr("there is nothing to measure"));
}

} // namespace nephroid::reading_test
