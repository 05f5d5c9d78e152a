// SPDX-License-Identifier: Apache-2.0
// A picture for each light, and lamps of some size: against rays through the solid, and the host against the device.
#include "inverse/assign/device_facets.h"
#include "inverse/bending.h"
#include "inverse/judge.h"
#include "inverse/light.h"
#include "inverse/plan.h"
#include "preset/read.h"
#include "tests/inverse/searches.h"
#include "tests/support/render.h"
#include "tests/support/test.h"

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include <numeric>
#include <random>

namespace nephroid::own_lights_test {

using namespace inverse;
using test::ring_and_disc;

constexpr const char* two_lamps = R"({"engine": "inverse", "inverse": {
  "facets": [32, 32], "cells": [16, 16], "receivers": [
    {"distance_mm": 250, "light": {"type": "point", "distance_mm": 600, "offset_mm": [-150, 0]},
     "picture": {"type": "ring"}},
    {"distance_mm": 250, "light": {"type": "parallel", "tilt_deg": 12, "turn_deg": 70},
     "picture": {"type": "disc"}}]}})";

Layout layout_of(const preset::Overrides& overrides = {}) {
  return make_layout(preset::parse_preset(two_lamps, "own.json", overrides));
}

std::string refusal(const preset::Overrides& overrides) {
  return test::refusal_of([&] { make_plan(preset::parse_preset(two_lamps, "own.json", overrides)); });
}

std::vector<glm::dvec2> slopes_of(const Layout& layout) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-0.2, 0.2);
  std::vector<glm::dvec2> slopes(layout.facet_count());
  for (glm::dvec2& slope : slopes) slope = {uniform(random), uniform(random)};
  return slopes;
}

double apart(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0, all = 0;
  for (std::size_t c = 0; c < a.size(); ++c) {
    sum += std::abs(a[c] - b[c]);
    all += a[c];
  }
  return sum / all;
}

// Whatever the light of all is: a lamp, or tilted.
TEST(OwnLights, HaveNothingOfTheLightOfAll) {
  const Layout plain = layout_of();
  for (const preset::Overrides& of : {preset::Overrides{R"(inverse.light={"type": "point", "distance_mm": 400})"},
                                      {R"(inverse.light={"type": "area", "distance_mm": 400})"},
                                      {R"(inverse.light={"type": "parallel", "tilt_deg": 5})"}}) {
    const Layout layout = layout_of(of);
    EXPECT_FALSE(layout.light_on(1).lamp);
    EXPECT_TRUE(layout.light_on(0).lamp_places.empty());
    for (const std::size_t j : {0u, 1u}) EXPECT_EQ(layout.light_on(j).sines, plain.light_on(j).sines) << j;
  }
}

// A facet that is one prism: a ray in each receiver's light leaves it with the slope that lit_facet says.
TEST(OwnLights, AFacetBendsEachLightAsARayGoes) {
  const Layout layout = layout_of({"inverse.facets=[1, 1]", "inverse.size_mm=[1.2, 1.2]", "inverse.thickness_mm=1",
                                   "inverse.receiver_mm=[100, 100]"});
  const glm::dvec2 slope{0.1, -0.15};
  const Solid solid = make_solid(layout, {slope});
  for (const std::size_t j : {0u, 1u}) {
    const LitFacet lit = lit_facet(layout, 0, slope, j);
    const glm::dvec3 k = light_inside(lit.in.sines, layout.n);
    const glm::dvec3 front{layout.thickness / k.z * lit.in.sines + glm::dvec2(1e-3, 5e-4), layout.thickness};
    const glm::dvec3 direction = light_ray(receiver_alone(layout, j), front).direction;
    const WayOut way = follow(test::shared_context(), solid, layout.n, {{front - 1e-3 * direction, direction}}).front();
    EXPECT_NEAR(glm::length(glm::dvec2(way.direction) / -way.direction.z - lit.slope), 0, 1e-4) << j;
    EXPECT_GT(glm::length(lit.slope - slope), 0.1) << j;
    EXPECT_NEAR(glm::length(slope_towards(layout, 0, lit.slope, j) - slope), 0, 1e-9) << j;
  }
}

struct LampMesh {
  std::string obj;
  test::TemporaryFolder folder{};
  std::string light(double distance_mm = 500) const {
    const std::filesystem::path file = folder.write("lamp.obj", obj);
    return fmt::format(R"({{"type": "mesh", "file": "{}", "distance_mm": {}}})", file.string(), distance_mm);
  }
};

/// A bar in a plane along the front, from one corner of a rectangle to the other.
LampMesh bar() { return {"v -30 -15 0\nv -25 -15 0\nv 30 15 0\nv 25 15 0\nf 1 2 3 4\n"}; }

LampMesh strip() { return {"v 0 -5 -200\nv 40 -5 200\nv 40 5 200\nv 0 5 -200\nf 1 2 3 4\n"}; }

LampMesh ball(double radius) {
  std::string obj;
  constexpr int around = 96, down = 48;
  for (int i = 0; i <= down; ++i)
    for (int k = 0; k < around; ++k) {
      const double theta = glm::pi<double>() * i / down, phi = 2 * glm::pi<double>() * k / around;
      obj += fmt::format("v {} {} {}\n", radius * std::sin(theta) * std::cos(phi),
                         radius * std::sin(theta) * std::sin(phi), radius * std::cos(theta));
    }
  for (int i = 0; i < down; ++i)
    for (int k = 0; k < around; ++k) {
      const int next = (k + 1) % around, row = around * i + 1;
      obj += fmt::format("f {} {} {}\nf {} {} {}\n", row + k, row + around + k, row + next, row + next,
                         row + around + k, row + around + next);
    }
  return {obj};
}

// A ball is a disc at whatever distance it is looked at: R = D tan(asin(r / 500)), with a variance of R^2 / 4.
TEST(OwnLights, AMeshIsALampOfItsOutline) {
  const auto lamp_of = [](const std::string& light) { return layout_of({"inverse.light=" + light}).light; };
  const LampMesh square{"v -30 -15 0\nv 30 -15 0\nv 30 15 0\nv -30 15 0\nf 1 2 3 4\n"};
  const Illumination mesh = lamp_of(square.light()),
                     flat =
                         lamp_of(R"({"type": "area", "distance_mm": 500, "shape": "rectangle", "size_mm": [60, 30]})");
  ASSERT_EQ(mesh.lamp_places.size(), flat.lamp_places.size());
  EXPECT_LT(glm::distance(*mesh.lamp, *flat.lamp), 0.01);
  for (std::size_t i = 0; i < mesh.lamp_places.size(); ++i)
    EXPECT_TRUE(std::abs(mesh.lamp_places[i].x) < 30.01 && std::abs(mesh.lamp_places[i].y) < 15.01) << i;
  for (const int k : {0, 1}) EXPECT_NEAR(mesh.lamp_covariance[k][k] / flat.lamp_covariance[k][k], 1, 5e-3) << k;
  // Of two narrow parts far apart neither is overlooked: .2 and .18 mm wide, 99.81 mm between their middles.
  const Illumination parts = lamp_of(LampMesh{"v -50 -2 0\nv -49.8 -2 0\nv -49.8 2 0\nv -50 2 0\n"
                                              "v 49.82 -2 0\nv 50 -2 0\nv 50 2 0\nv 49.82 2 0\nf 1 2 3 4\nf 5 6 7 8\n"}
                                         .light());
  EXPECT_NEAR(std::sqrt(parts.lamp_covariance[0][0]), 99.81 * std::sqrt(0.2 * 0.18) / 0.38, 0.05);
  // A strip that leads away, from z = 300 to 700 mm: the nearer, the larger it looks. The mean of x / z is the integral
  // of s z^-4 over that of z^-3, with x = 40 s and z = 300 + 400 s.
  const Illumination leads = lamp_of(strip().light());
  EXPECT_NEAR(leads.lamp->x / (leads.lamp->z - 10), 0.024762, 2e-5);
  const double r = 100;
  const Illumination sphere = lamp_of(ball(r).light());
  const double outline = (sphere.lamp->z - 10) * std::tan(std::asin(r / 500));
  for (const int k : {0, 1}) EXPECT_NEAR(std::sqrt(sphere.lamp_covariance[k][k]) / (outline / 2), 1, 3e-3) << k;
  EXPECT_NEAR(sphere.lamp_covariance[0][1] / (outline * outline), 0, 1e-3);
}

TEST(OwnLights, AMeshIsFoundBesideThePreset) {
  const LampMesh square = bar();
  square.light();
  const std::string preset = square.folder.write("own.json", two_lamps);
  const Layout layout = make_layout(
      preset::read_preset(preset, {R"(inverse.light={"type": "mesh", "file": "lamp.obj", "distance_mm": 500})"}));
  EXPECT_EQ(layout.light.lamp_places.size(), 4096);
}

/// light: whose it is.
std::string sun(const char* hour, const char* light = "inverse.light") {
  return light + std::string(R"(={"type": "sun", "place": {"latitude_deg": 52.5, "longitude_deg": 13.4, )") +
         R"("date": "2026-03-20", "utc_offset_h": 1, "hour": )" + hour + "}}";
}

TEST(OwnLights, DeviceAndHostSendTheSameLight) {
  const LampMesh lamp = bar(), away = strip();
  for (const preset::Overrides& of :
       {preset::Overrides{},
        {"inverse.sun_deg=0.53"},
        {"inverse.kind=mirror"},
        {sun("12", "inverse.receivers.1.light"), "inverse.front_elevation_deg=37.5", "inverse.cells=[64, 64]"},
        {"inverse.light=" + lamp.light(), "inverse.receivers.0.light=null"},
        {"inverse.light=" + lamp.light(), "inverse.receivers.0.light=" + away.light(), "inverse.scatter_deg=0.3"}}) {
    const Layout l = layout_of(of);
    const std::vector<Target> targets = ring_and_disc(l);
    DeviceFacets facets(test::shared_context(), l, targets, picture_weights(l, targets));
    const std::vector<double> z(l.facet_count());
    facets.put(slopes_of(l), z);
    const auto truth = light_of_all(l, facets.slopes(), z), light = facets.light();
    for (const std::size_t j : {0u, 1u}) EXPECT_LT(apart(truth[j], light[j]), 2e-4) << j;
  }
}

// The search believes what the judge then finds, and each picture is there in its own light alone.
TEST(OwnLights, EachPictureIsThereInItsOwnLightAlone) {
  for (const char* const kind : {"glass", "mirror"}) {
    const Layout l = layout_of({std::string("inverse.kind=") + kind});
    const std::vector<Target> targets = ring_and_disc(l);
    Assignment search(test::shared_context(), l, targets, 1);
    test::sweep(search, 5);
    Judge judge(test::shared_context(), l, search.solid(), 1, targets);
    while (!judge.finished()) judge.advance();
    const std::vector<Cost> judged = judge.costs(targets);
    for (const std::size_t j : {0u, 1u}) {
      EXPECT_NEAR(judged[j].cost, search.costs()[j].cost, 0.1) << j;
      EXPECT_LT(judged[j].rel_l2, 0.15) << j;
      EXPECT_GT(cost_of(targets[j], judge.light_under(j, 1 - j), 1).rel_l2, 0.4) << j;
    }
  }
}

// Facets in random directions; the lamp's width is ten cells on the receiver and more.
TEST(OwnLights, ALampsSizeBlursAsRaysSay) {
  const auto flat = [](const char* shape) {
    return R"({"type": "area", "distance_mm": 500, "shape": ")" + std::string(shape) + R"(", "size_mm": [60, 30]})";
  };
  const LampMesh askew = bar(), round = ball(25), away = strip(),
                 two{"v -30 -5 0\nv -20 -5 0\nv -20 5 0\nv -30 5 0\nv 20 -5 0\nv 30 -5 0\nv 30 5 0\nv 20 5 0\n"
                     "f 1 2 3 4\nf 5 6 7 8\n"};
  for (const std::string& light :
       {flat("disc"), flat("rectangle"), askew.light(), round.light(), away.light(), two.light()}) {
    const Layout l = layout_of({"inverse.light=" + light, "inverse.receivers.0.light=null",
                                "inverse.receivers.1.light=null", "inverse.receivers.1.distance_mm=300"});
    ASSERT_TRUE(l.own_lights.empty());
    const std::vector<glm::dvec2> slopes(l.facet_count(), glm::dvec2(0.02, 0));
    Layout point = l;
    point.light.lamp_places.clear();
    point.light.lamp_covariance = glm::dmat3(0);
    const std::vector<double> z(l.facet_count());
    Judge judge(test::shared_context(), l, make_solid(l, slopes), 1);
    while (!judge.finished()) judge.advance();
    const auto believed = light_of_all(l, slopes, z), sharp = light_of_all(point, slopes, z);
    for (const std::size_t j : {0u, 1u}) {
      std::vector<double> of_rays = judge.light(j);
      for (double& cell : of_rays)
        cell *= std::accumulate(believed[j].begin(), believed[j].end(), 0.0) /
                std::accumulate(judge.light(j).begin(), judge.light(j).end(), 0.0);
      EXPECT_LT(apart(believed[j], of_rays), 0.03) << light << j;
      EXPECT_GT(apart(sharp[j], of_rays), 2 * apart(believed[j], of_rays)) << light << j;
    }
  }
}

// Half way between a lamp of 4 mm and one of 60 mm light is that of one of 32 mm. Neither is the light of all.
TEST(OwnLights, AFrameIsInALampBetweenThoseOfItsReceivers) {
  const auto judged = [](const char* first, const char* second) {
    const auto light = [](const char* size) {
      return R"({"type": "area", "distance_mm": 500, "size_mm": )" + std::string(size) + "}";
    };
    const Layout l =
        layout_of({"inverse.receivers.0.light=" + light(first), "inverse.receivers.1.light=" + light(second),
                   "inverse.receivers.1.distance_mm=250.01", "inverse.receiver_mm=[200, 200]", "inverse.frames=1"});
    Judge judge(test::shared_context(), l, make_solid(l, std::vector<glm::dvec2>(l.facet_count())), 1);
    while (!judge.finished()) judge.advance();
    return std::vector<std::vector<double>>{judge.light(0), judge.light(1), judge.light(2)};
  };
  const auto mixed = judged("[4, 4]", "[60, 60]"), plain = judged("[32, 32]", "[32.01, 32.01]");
  EXPECT_LT(apart(plain[0], mixed[2]), 0.005);
  for (const std::size_t end : {0u, 1u}) EXPECT_GT(apart(plain[0], mixed[end]), 0.03) << end;
}

// At the equinox the sun stands 90 - 52.5 degrees high at local noon, .89 h - .12 h before the clock's by longitude and
// the equation of time.
TEST(OwnLights, TheNoonSunFallsStraightOnAFrontThatFacesIt) {
  const Layout l = layout_of({sun("12.23"), "inverse.front_elevation_deg=37.5"});
  EXPECT_LT(glm::length(l.light.sines), 0.01);
  EXPECT_LT(layout_of({sun("11.23"), "inverse.front_elevation_deg=37.5"}).light.sines.x, -0.2); // goes to the west
  EXPECT_LT(layout_of({sun("12.23"), "inverse.front_elevation_deg=15"}).light.sines.y, -0.3);   // and down
}

// Wherever it is named, and no light beside it. What the settings say is of all lights.
TEST(OwnLights, TheSunHasItsDisc) {
  const auto discs = [](const preset::Overrides& more) {
    preset::Overrides of{sun("12", "inverse.receivers.1.light"), "inverse.front_elevation_deg=37.5"};
    of.insert(of.end(), more.begin(), more.end());
    const Layout l = layout_of(of);
    return std::array{l.disc(l.light_on(0)), l.disc(l.light_on(1)), l.blurs() ? 1.0 : 0.0};
  };
  const double half = std::tan(glm::radians(0.533 / 2)), wide = std::tan(glm::radians(0.5));
  EXPECT_THAT(discs({}), testing::ElementsAre(0, testing::DoubleEq(half), 1));
  EXPECT_THAT(discs({"inverse.sun_deg=0"}), testing::Each(0));
  EXPECT_THAT(discs({"inverse.sun_deg=1"}), testing::ElementsAre(testing::DoubleEq(wide), testing::DoubleEq(wide), 1));
  const auto judged = [](const char* more) {
    const Layout l = layout_of({sun("12"), "inverse.front_elevation_deg=37.5", "inverse.receivers.0.light=null",
                                "inverse.receivers.1.light=null", "inverse.receivers.1.distance_mm=2000", more});
    Judge judge(test::shared_context(), l, make_solid(l, std::vector<glm::dvec2>(l.facet_count())), 1);
    while (!judge.finished()) judge.advance();
    return judge.light(1);
  };
  EXPECT_EQ(judged("inverse.cells=[16, 16]"), judged("inverse.sun_deg=0.533"));
  EXPECT_GT(apart(judged("inverse.cells=[16, 16]"), judged("inverse.sun_deg=0")), 0.02);
}

TEST(OwnLights, BadLightIsRefused) {
  EXPECT_NO_THROW(layout_of({sun("12")}));
  EXPECT_THAT(refusal({sun("3")}), testing::HasSubstr("below the horizon"));
  EXPECT_THAT(refusal({sun("12"), "inverse.front_azimuth_deg=0"}), testing::HasSubstr("behind the front"));
  EXPECT_THAT(refusal({"inverse.receivers.0.light=null", "inverse.receivers.1.light=null"}),
              testing::HasSubstr("same place in the same light"));
  EXPECT_THAT(refusal({"inverse.method=thesis"}), testing::HasSubstr("the method 'thesis' has one light"));
  EXPECT_THAT(refusal({"inverse.receivers.0.light.spectrum=D65"}), testing::HasSubstr("all lights have the spectrum"));
  EXPECT_THAT(refusal({"inverse.frames=3"}), testing::HasSubstr("lit by lamps and by parallel light"));
  EXPECT_THAT(refusal({"inverse.receivers.0.light.type=area", "inverse.sun_deg=0.5"}),
              testing::HasSubstr("a lamp has a size"));
  const LampMesh large = ball(40), edge{"v 0 -9 0\nv 0 9 0\nv 0 0 20\nf 1 2 3\n"};
  EXPECT_THAT(refusal({"inverse.light=" + large.light(30)}),
              testing::HasSubstr("#/inverse/light/distance_mm: is 30 mm, and the lamp reaches 10 mm behind the front"));
  EXPECT_THAT(refusal({"inverse.light=" + edge.light()}), testing::HasSubstr("sees only an edge"));
  EXPECT_THAT(refusal({R"(inverse.light={"type": "mesh", "file": "no.obj"})"}),
              testing::HasSubstr("#/inverse/light/file: "));
}

} // namespace nephroid::own_lights_test
