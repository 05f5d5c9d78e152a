// SPDX-License-Identifier: Apache-2.0
// Mirrors against the law of reflection, a flat mirror, a paraboloid, and rays through the mesh.
#include "inverse/assign/footprint.h"
#include "inverse/bending.h"
#include "inverse/facets/heights.h"
#include "inverse/judge.h"
#include "inverse/layout.h"
#include "inverse/light.h"
#include "preset/read.h"
#include "tests/inverse/drawn.h"
#include "tests/inverse/sound.h"
#include "tests/support/render.h"
#include "tests/support/test.h"

namespace nephroid::mirror_test {

using namespace inverse;

Layout mirror(Layout layout, const Light& light) {
  layout.n = mirror_index;
  layout.steepest = steepest_mirror;
  layout.light = make_illumination(layout, light, "own.json");
  return layout;
}

Light lamp(double distance_mm, std::array<double, 2> offset_mm) {
  return {.type = Light::Type::point, .distance_mm = distance_mm, .offset_mm = offset_mm};
}

/// The true way of light that is folded at z = 0.
glm::dvec3 unfolded(const glm::dvec3& v) { return {v.x, v.y, -v.z}; }

preset::Preset preset_of(const char* inverse) {
  return preset::parse_preset(std::string(R"({"engine": "inverse", "inverse": )") + inverse + "}", "own.json");
}

// out = in - 2 (in . N) N (Born and Wolf, 3.2.2), for light from below and a normal out of the mirror.
TEST(Mirror, ReflectsByTheLaw) {
  for (const glm::dvec2& sines : {glm::dvec2(0), {0.3, -0.2}, {-0.1, 0.6}})
    for (const glm::dvec2& slope : {glm::dvec2(0.1, 0.2), {-0.7, 0.1}, {0.5, -0.9}}) {
      const glm::dvec3 in(sines, std::sqrt(1 - glm::dot(sines, sines)));
      const glm::dvec2 g = facet_gradient(slope, mirror_index, sines);
      const auto sent = [&](const glm::dvec3& way) {
        const glm::dvec3 out = glm::reflect(way, glm::normalize(glm::dvec3(g, -1)));
        return glm::dvec2(out) / -out.z;
      };
      EXPECT_NEAR(glm::length(sent(in) - slope), 0, 1e-12);
      EXPECT_NEAR(glm::length(facet_slope(g, mirror_index, sines) - slope), 0, 1e-12);
      EXPECT_EQ(transmitted(slope, mirror_index, sines), 1);
      const SlopeChange change = slope_change(slope, mirror_index, sines);
      constexpr double h = 1e-6;
      for (int axis = 0; axis < 2; ++axis) {
        const auto moved = [&](double by) {
          glm::dvec2 to = sines;
          to[axis] += by;
          return sent({to, std::sqrt(1 - glm::dot(to, to))});
        };
        EXPECT_NEAR(glm::length(change.by_sines[axis] - (moved(h) - moved(-h)) / (2 * h)), 0, 1e-8);
      }
    }
}

// z = -r^2 / (4 f) sends all light along z to the focus.
TEST(Mirror, IsAParaboloidWhereItFocuses) {
  constexpr double f = 120;
  for (const glm::dvec2& p : {glm::dvec2(10, 0), {-30, 20}, {5, -60}}) {
    const double z = -glm::dot(p, p) / (4 * f);
    const glm::dvec2 g = facet_gradient(-p / (f + z), mirror_index);
    EXPECT_NEAR(glm::length(g + p / (2 * f)), 0, 1e-12);
  }
}

// A lamp before a flat mirror lights the place where its image behind the mirror would throw light.
TEST(Mirror, ThatIsFlatHasAnImageOfTheLamp) {
  const Layout layout = mirror({.size = {40, 30}, .facets = {4, 3}, .distances = {200}}, lamp(150, {60, -20}));
  std::vector<glm::dvec2> slopes;
  for (std::size_t i = 0; i < layout.facet_count(); ++i) slopes.push_back(flat_slope(layout.sines_on(i)));
  const Solid solid = make_solid(layout, slopes);
  EXPECT_LT(solid.relief(), 1e-12);
  test::expect_sound(layout, solid);
  std::vector<Ray> rays;
  std::vector<glm::dvec2> at;
  for (std::size_t i = 0; i < layout.facet_count(); ++i) {
    at.push_back(layout.middle(i) + glm::dvec2(1e-3, 5e-4)); // off the vertex in the facet's middle
    const glm::dvec3 place(at.back(), 0);
    rays.push_back({unfolded(*layout.light.lamp), place - unfolded(*layout.light.lamp)});
  }
  const std::vector<WayOut> ways = follow(test::shared_context(), solid, layout.n, rays);
  for (std::size_t i = 0; i < ways.size(); ++i) {
    EXPECT_EQ(ways[i].part, 1);
    const glm::dvec2 spot = glm::dvec2(ways[i].from) -
                            glm::dvec2(ways[i].direction) / ways[i].direction.z * (200 + ways[i].from.z),
                     expected = at[i] + (at[i] - glm::dvec2(60, -20)) / 150.0 * 200.0;
    EXPECT_NEAR(glm::length(spot - expected), 0, 1e-3);
  }
}

/// The light on a receiver by its cells beside that of rays through the mesh, over all of it.
double apart(const Layout& layout, const std::vector<glm::dvec2>& slopes) {
  Judge judge(test::shared_context(), layout, make_solid(layout, slopes), 1);
  while (!judge.finished()) judge.advance();
  const std::vector<double> believed = light_of_all(layout, slopes, heights_of(layout, slopes)).front();
  double sum = 0, all = 0;
  for (std::size_t c = 0; c < believed.size(); ++c) {
    sum += std::abs(judge.light(0)[c] - believed[c]);
    all += believed[c];
  }
  return sum / all;
}

// Facets that all aim at one half of the receiver, straight on and tilted, in parallel light, that of the sun and of
// lamps, each with its neighbours' shadows.
TEST(Mirror, FootprintsAreWhereRaysAre) {
  struct Case {
    const char* what;
    Light light;
    glm::dvec2 offset;
    double sun = 0;
    bool free_heights = false;
  };
  for (const Case& c : {Case{"straight", {}, {0, 0}},
                        {"tilted", {.tilt_deg = 30, .turn_deg = 90}, {0, 90}},
                        {"tilted, aside", {.tilt_deg = -25, .turn_deg = 20}, {-60, 0}},
                        {"tilted, turned back", {.tilt_deg = 30, .turn_deg = 90}, {0, 0}},
                        {"the sun", {.tilt_deg = 30, .turn_deg = 90}, {0, 90}, 0.02},
                        {"a lamp", lamp(200, {0, -100}), {0, 90}},
                        {"an area",
                         {.type = Light::Type::area, .distance_mm = 200, .offset_mm = {0, -100}, .size_mm = {15, 10}},
                         {0, 90}},
                        {"free heights", {.tilt_deg = 30, .turn_deg = 90}, {0, 90}, 0, true}}) {
    SCOPED_TRACE(c.what);
    Layout layout{.facets = {40, 40}, .cells = {24, 24}, .distances = {150}};
    layout.offsets = {c.offset};
    layout.sun_radius = c.sun;
    layout.free_heights = c.free_heights;
    layout = mirror(layout, c.light);
    std::vector<glm::dvec2> slopes;
    for (std::size_t i = 0; i < layout.facet_count(); ++i) {
      const glm::dvec2 to = c.offset + glm::dvec2(0.5, 0.8) * layout.middle(i);
      slopes.push_back(
          nearest_reachable((to - layout.middle(i)) / 150.0, layout.n, layout.sines_on(i), layout.steepest));
    }
    if (layout.light.facets)
      for (std::size_t i = 0; i < slopes.size(); ++i)
        (*layout.light.facets)[i].around = facet_gradient(slopes[i], layout.n, layout.sines_on(i));
    EXPECT_LT(apart(layout, slopes), 0.05);
  }
}

// A mirror that faces south, in the afternoon: the sun stands in the west, at the right of who looks along the light
// that the mirror sends, and lights what is to the left. Light that goes north through glass has the west at the left.
TEST(Mirror, HasTheSunOnItsOwnSide) {
  Settings settings;
  settings.front_azimuth_deg = 180;
  Light sun;
  sun.type = Light::Type::sun;
  sun.place.latitude_deg = 60;
  sun.place.longitude_deg = 0;
  sun.place.utc_offset_h = 0;
  sun.place.date = "2026-03-20";
  sun.place.hour = 13;
  Layout layout{.facets = {8, 8}, .distances = {2000}};
  const glm::dvec2 glass = make_illumination(layout, sun, "own.json", settings).sines;
  settings.kind = Settings::Kind::mirror;
  layout.n = mirror_index;
  layout.steepest = steepest_mirror;
  layout.offsets = {glm::dvec2(-600, -1200)};
  const glm::dvec2 mirrored = make_illumination(layout, sun, "own.json", settings).sines;
  EXPECT_GT(glass.x, 0.1);
  EXPECT_NEAR(mirrored.x, -glass.x, 1e-12);
  EXPECT_NEAR(mirrored.y, glass.y, 1e-12);
}

// Straight light passes the receiver on its way. A tilt of 45 degrees brings the light of the mirror past one that
// stands as far aside as it is away.
TEST(Mirror, TellsWhatStandsInItsLight) {
  Layout layout{.facets = {32, 32}, .distances = {100}};
  EXPECT_EQ(shaded_part(mirror(layout, {}), 0), 1);
  layout.offsets = {glm::dvec2(0, 110)};
  EXPECT_EQ(shaded_part(mirror(layout, {.tilt_deg = 45, .turn_deg = 90}), 0), 0);
  layout.offsets = {glm::dvec2(50, 0)};
  EXPECT_NEAR(shaded_part(mirror(layout, {}), 0), 0.5, 0.02);
  EXPECT_EQ(shaded_part(mirror(layout, lamp(60, {0, 0})), 0), 0) << "the lamp stands before the receiver";
  layout.n = 1.5;
  EXPECT_EQ(shaded_part(layout, 0), 0);
}

TEST(Mirror, RefusesWhatIsOfGlass) {
  EXPECT_EQ(
      test::refusal_of([] {
        preset_of(
            R"({"kind": "mirror", "index": 1.6, "receivers": [{"distance_mm": 100, "picture": {"type": "disc"}}]})");
      }),
      "own.json#/inverse/index: is of glass, and \"kind\" is \"mirror\"; expected none; remove it");
  EXPECT_THAT(
      test::refusal_of([] {
        preset_of(
            R"({"kind": "mirror", "band_nm": 20, "receivers": [{"distance_mm": 100, "picture": {"type": "disc"}}]})");
      }),
      testing::HasSubstr("a mirror sends all wavelengths alike"));
  EXPECT_THAT(
      test::refusal_of([] {
        const preset::Preset p = preset_of(
            R"({"kind": "mirror", "receivers": [{"distance_mm": 20, "offset_mm": [300, 0], "picture": {"type": "disc"}}]})");
        const Layout l = make_layout(p);
        check_reach(l, {drawn({}, l)}, p);
      }),
      testing::HasSubstr("the constraints on the facets let it have a slope of 1.33 at most"));
}

} // namespace nephroid::mirror_test
