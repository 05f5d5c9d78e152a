// SPDX-License-Identifier: Apache-2.0
// Tilted light, a lamp, the sun's disc and a band of wavelengths against Snell's law, solid angles and rays through the
// solid.
#include "inverse/assign/footprint.h"
#include "inverse/bending.h"
#include "inverse/judge.h"
#include "inverse/layout.h"
#include "inverse/light.h"
#include "optics/fresnel.h"
#include "tests/inverse/searches.h"
#include "tests/support/render.h"
#include "tests/support/test.h"

namespace nephroid::lights_test {

using namespace inverse;
using test::band;

Light tilted(double tilt_deg, double turn_deg) { return {.tilt_deg = tilt_deg, .turn_deg = turn_deg}; }

Light lamp(double distance_mm, std::array<double, 2> offset_mm = {0, 0}) {
  return {.type = Light::Type::point, .distance_mm = distance_mm, .offset_mm = offset_mm};
}

Layout with(Layout layout, const Light& light) {
  layout.light = make_illumination(layout, light, "own.json");
  return layout;
}

glm::dvec2 spot_of(const WayOut& way, double distance) {
  return glm::dvec2(way.from) - glm::dvec2(way.direction) / way.direction.z * (distance + way.from.z);
}

/// Where the ray enters that comes to a facet's middle.
glm::dvec3 entry(const Layout& layout, const glm::dvec2& middle, const glm::dvec2& sines) {
  const glm::dvec3 k = inverse::light_inside(sines, layout.n);
  return {middle + layout.thickness / k.z * sines, layout.thickness};
}

// The ray that incoming_at speaks of, sent through the mesh from in front of it, leaves the facet's middle with the
// facet's slope.
TEST(Lights, AFacetsSpotIsWhereItsSlopeSays) {
  for (const double n : {1.33, 1.5, 2.4})
    for (const Light& light : {tilted(25, 30), tilted(-10, 80), lamp(150), lamp(90, {30, -20})}) {
      Layout layout{
          .size = {1.2, 1.2}, .thickness = 1, .facets = {1, 1}, .n = n, .receiver = {100, 100}, .distances = {100}};
      layout = with(layout, light);
      const glm::dvec2 slope{0.1, -0.15};
      const Solid solid = make_solid(layout, {slope});
      const glm::dvec2 sines = (*layout.light.facets)[0].sines;
      const glm::dvec3 front = entry(layout, {0, 0}, sines), direction = light_ray(layout, front).direction;
      const glm::dvec3 nudge{1e-3, 5e-4, 0}; // off the vertex in the facet's middle
      const WayOut way =
          follow(test::shared_context(), solid, n, {{front + nudge - 1e-3 * direction, direction}}).front();
      EXPECT_NEAR(glm::length(spot_of(way, 100) - slope * 100.0), 0, 0.01) << n << " " << light.tilt_deg;
      const double entered = 1 - optics::fresnel_reflectance(-direction.z, 1, n);
      EXPECT_NEAR(way.part, entered * inverse::transmitted(slope, n, sines), 1e-5);
    }
}

// Finite differences of the engine's own refraction of a ray at a fixed facet.
TEST(Lights, ASlopeChangesWithLightAndIndexAsRaysDo) {
  const glm::dvec2 sines{0.2, -0.1}, slope{0.15, 0.3};
  const double n = 1.6, h = 1e-6;
  const glm::dvec3 normal =
      *inverse::facet_normal(inverse::light_inside(sines, n) / n, inverse::direction_of(slope), n);
  const auto refracted = [&](const glm::dvec2& s, double index) {
    const glm::dvec3 out = glm::refract(inverse::light_inside(s, index) / index, -normal, index); // GLSL's own
    return glm::dvec2(out) / -out.z;
  };
  const inverse::SlopeChange change = inverse::slope_change(slope, n, sines);
  EXPECT_NEAR(glm::length(refracted(sines, n) - slope), 0, 1e-12);
  for (int axis = 0; axis < 2; ++axis) {
    glm::dvec2 step(0);
    step[axis] = h;
    const glm::dvec2 expected = (refracted(sines + step, n) - refracted(sines - step, n)) / (2 * h);
    EXPECT_NEAR(glm::length(change.by_sines[axis] - expected), 0, 1e-6);
  }
  const glm::dvec2 expected = (refracted(sines, n + h) - refracted(sines, n - h)) / (2 * h);
  EXPECT_NEAR(glm::length(change.by_index - expected), 0, 1e-6);
}

/// Light in each column of a receiver, or in each row.
std::vector<double> lines_of(const Layout& layout, const inverse::Footprint& print, bool along_x) {
  const auto columns = static_cast<std::size_t>(layout.cells.x);
  std::vector<double> lines(along_x ? columns : static_cast<std::size_t>(layout.cells.y));
  for_cells(layout, print,
            [&](std::size_t cell, double part) { lines[along_x ? cell % columns : cell / columns] += part; });
  return lines;
}

// From a lamp at a before a slab of T, light at the axis goes as from a + T / n: a flat facet's beam grows by (a + T /
// n + d) over that.
TEST(Lights, ALampsBeamGrowsWithDistance) {
  Layout layout{.size = {5, 5}, .facets = {5, 5}, .receiver = {40, 40}, .cells = {400, 400}, .distances = {60, 300}};
  layout = with(layout, lamp(200));
  for (const std::size_t receiver : {0u, 1u}) {
    const std::vector<double> columns = lines_of(layout, footprint(layout, 12, {0, 0}, receiver), true);
    const double from = 200 + 10 / 1.5;
    const double most = *std::max_element(columns.begin(), columns.end());
    EXPECT_NEAR(0.1 / most, (from + layout.distances[receiver]) / from, 1e-3); // a cell is 0.1 mm
  }
}

// A lamp's light over the front is the front's solid angle, whose closed form the weights hold: their mean is 1, and
// beside the lamp's foot they fall as the cosine's cube.
TEST(Lights, ALampsLightIsASolidAngle) {
  Layout layout{.size = {80, 60}, .distances = {100}};
  layout = with(layout, lamp(120, {20, 10}));
  double sum = 0;
  for (int i = 0; i < 40000; ++i)
    sum += light_ray(layout, {(i % 200 + 0.5) * 0.4 - 40, (i / 200 + 0.5) * 0.3 - 30, layout.thickness}).weight;
  EXPECT_NEAR(sum / 40000, 1, 1e-5);
  const double foot = light_ray(layout, {20, 10, layout.thickness}).weight,
               beside = light_ray(layout, {-30, 10, layout.thickness}).weight;
  EXPECT_NEAR(beside / foot, std::pow(120 / 130.0, 3), 1e-12); // 50 beside 120: 130
}

TEST(Lights, AllLightIsAccountedFor) {
  for (const Light& light : {tilted(20, 200), lamp(120, {10, 0})}) {
    Layout layout{.facets = {20, 20}, .distances = {150}};
    layout = with(layout, light);
    double power = 0;
    for (const Incoming& in : layout.incoming()) power += in.power;
    EXPECT_NEAR(power, 400, 1e-9);
    const Solid solid = make_solid(layout, std::vector<glm::dvec2>(400, {-0.1, 0.1}));
    Judge judge(test::shared_context(), layout, solid, 1);
    while (!judge.finished()) judge.advance();
    const inverse::RayOutcomes f = judge.outcomes();
    EXPECT_NEAR(f.sent + f.reflected + f.lost, 1, 1e-4); // the lamp's weights are drawn
    EXPECT_LE(std::accumulate(judge.light(0).begin(), judge.light(0).end(), 0.0), 400 * f.sent * (1 + 1e-6));
  }
}

// How much a facet among others sends, its neighbours' shadows and all: each fifth one has the slope in question, the
// others are turned about straight on.
TEST(Lights, AFacetsPowerIsWhatRaysBring) {
  Layout layout{.facets = {40, 40}, .distances = {100}};
  layout = with(layout, tilted(20, 30));
  for (Incoming& in : *layout.light.facets) in.around = inverse::facet_gradient({0, 0}, layout.n, in.sines);
  const double straight = 0.96 * (1 - optics::fresnel_reflectance(std::cos(20 * 3.14159265 / 180), 1, 1.5));
  for (const glm::dvec2& slope :
       {glm::dvec2(-0.2, 0), {0.2, 0}, {0.4, 0}, {0.1, 0.2}, {0.1, -0.2}, {-0.2, 0.2}, {0.3, 0.3}}) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-0.1, 0.1);
    std::vector<glm::dvec2> slopes(1600);
    double believed = 0;
    for (std::size_t i = 0; i < slopes.size(); ++i) {
      const bool chosen = i % 40 % 5 == 2 && i / 40 % 5 == 2;
      slopes[i] = chosen ? slope : glm::dvec2(uniform(random), uniform(random));
      if (chosen) believed += facet_power(layout, i, slope) / (*layout.light.facets)[i].power;
    }
    const Solid solid = make_solid(layout, slopes);
    std::vector<Ray> rays;
    for (int i = 0; i < 90000; ++i) {
      const glm::dvec3 front((i % 300 + 0.503) / 3 - 50, (i / 300 + 0.503) / 3 - 50, layout.thickness);
      rays.push_back({front + glm::dvec3(0, 0, 1e-3), light_ray(layout, front).direction});
    }
    double sent = 0;
    for (const WayOut& way : follow(test::shared_context(), solid, layout.n, rays))
      if (way.part > 0 && glm::length(glm::dvec2(way.direction) / -way.direction.z - slope) < 1e-3)
        sent += way.part / 56.25;
    EXPECT_NEAR(sent / straight / believed, 1, 0.05) << slope.x << " " << slope.y;
  }
}

/// Mean and variance along x of what a single facet of the layout lights, from its footprint and from rays.
struct Moments {
  double mean = 0, variance = 0;
};
Moments moments(const std::vector<double>& columns) {
  Moments m;
  const double all = std::accumulate(columns.begin(), columns.end(), 0.0);
  for (std::size_t i = 0; i < columns.size(); ++i) m.mean += columns[i] / all * static_cast<double>(i);
  for (std::size_t i = 0; i < columns.size(); ++i)
    m.variance += columns[i] / all * std::pow(static_cast<double>(i) - m.mean, 2);
  return m;
}

void expect_same_spot(const Layout& layout, const glm::dvec2& slope, double tolerance) {
  const Solid solid = make_solid(layout, {slope});
  Judge judge(test::shared_context(), layout, solid, 1);
  while (!judge.finished()) judge.advance();
  const inverse::Footprint print = footprint(layout, 0, slope, 0);
  for (const bool along_x : {true, false}) {
    const auto cells = static_cast<std::size_t>(layout.cells.x);
    const std::vector<double> believed = lines_of(layout, print, along_x);
    std::vector<double> rays(cells);
    for (std::size_t c = 0; c < layout.cell_count(); ++c) rays[along_x ? c % cells : c / cells] += judge.light(0)[c];
    const Moments is = moments(believed), truth = moments(rays);
    EXPECT_NEAR(is.mean, truth.mean,
                0.2); // cells of half a millimetre; the disc and the band are not quite even about their middles
    EXPECT_NEAR(is.variance / truth.variance, 1, tolerance) << along_x;
  }
}

Layout one_facet() {
  return {.size = {1, 1}, .facets = {1, 1}, .receiver = {120, 120}, .cells = {240, 240}, .distances = {100}};
}

// A steep facet widens the sun's disc along the slope, by the derivative of Snell's law.
TEST(Lights, ASteepFacetWidensTheSun) {
  Layout layout = one_facet();
  layout.sun_radius = 0.03;
  expect_same_spot(layout, {0.45, 0.1}, 0.03);
  const auto variance = [&](const glm::dvec2& slope) {
    return moments(lines_of(layout, footprint(layout, 0, slope, 0), true)).variance;
  };
  const double flat = variance({0, 0}), steep = variance({0.45, 0});
  EXPECT_GT(steep, 2 * flat);
}

TEST(Lights, ABandOfWavelengthsPartsAlongTheSlope) {
  Layout layout = one_facet();
  layout.spectrum = band(1.5, 0.08);
  expect_same_spot(layout, {0.4, 0.2}, 0.05);
  const auto variance = [&](bool along_x) {
    return moments(lines_of(layout, footprint(layout, 0, {0.4, 0}, 0), along_x)).variance;
  };
  EXPECT_LT(variance(false), 0.1 * variance(true));
}

/// The judge's cells beside the footprint's, over what the judge's have: a root mean square.
double apart(const Layout& layout, const glm::dvec2& slope) {
  const Solid solid = make_solid(layout, {slope});
  Judge judge(test::shared_context(), layout, solid, 1);
  while (!judge.finished()) judge.advance();
  std::vector<double> rays = judge.light(0);
  const double all = std::accumulate(rays.begin(), rays.end(), 0.0);
  double norm = 0, squares = 0;
  for (double& value : rays) norm += std::pow(value /= all, 2);
  for_cells(layout, footprint(layout, 0, slope, 0), [&](std::size_t cell, double part) { rays[cell] -= part; });
  for (const double value : rays) squares += value * value;
  return std::sqrt(squares / norm);
}

// Colours and the sun's disc cell by cell, a facet and its blur being about a cell. As one box of its variance, which a
// band's line is not, the band is 0.39 off.
TEST(Lights, ABlurIsWhereRaysAre) {
  Layout layout{.size = {1, 1}, .facets = {1, 1}, .receiver = {60, 60}, .cells = {60, 60}, .distances = {100}};
  layout.spectrum = band(1.5, 0.04);
  EXPECT_LT(apart(layout, {0.15, 0.12}), 0.02);
  layout.spectrum.reset();
  layout.sun_radius = 0.012;
  EXPECT_LT(apart(layout, {0.15, 0.12}), 0.05);
}

// Two facets in light from the left: the right one lies in the shadow of the left one, as much as that is seen to fall
// towards it, less where it rises instead. In straight lines: t (g + h) / 2 of the width, t being the light's slope
// inside.
TEST(Lights, AFacetLiesInItsNeighboursShadow) {
  Layout layout{.size = {2, 1}, .thickness = 0.1, .facets = {2, 1}, .distances = {100}};
  layout = with(layout, tilted(20, 0));
  const glm::dvec2 slope = inverse::flat_slope(layout.light.sines),
                   inside = inverse::slope_inside(layout.light.sines, layout.n);
  const auto power = [&](const glm::dvec2& left) {
    (*layout.light.facets)[0].around = left;
    return facet_power(layout, 1, slope);
  };
  const double free = power({-0.4, 0});
  EXPECT_NEAR(power({0.4, 0}) / free, 1 - inside.x * 0.2, 1e-9);
  EXPECT_NEAR(power({0.2, 0}) / free, 1 - inside.x * 0.1, 1e-9);
  EXPECT_NEAR(power({0, 0.4}) / free, 1 - inside.x * 0.4 / 8, 1e-9); // half of the edge: a triangle, 0.2 high
}

TEST(Lights, ThatCannotBeAreRefused) {
  Layout layout{.distances = {100, 200}};
  const auto refusal = [&](const Light& light) { return test::refusal_of([&] { with(layout, light); }); };
  EXPECT_THAT(refusal(lamp(-50)),
              HasSubstr("own.json#/distance_mm: is -50 mm, and the light would stand behind the front"));
  EXPECT_THAT(refusal(lamp(0)), HasSubstr("expected more than 0 mm"));
  EXPECT_THAT(refusal(tilted(95, 0)),
              AllOf(HasSubstr("would not enter through the front"), HasSubstr("expected less than 90")));
  const std::string steep = refusal(tilted(60, 0)), near = refusal(lamp(15));
  EXPECT_THAT(
      steep, AllOf(HasSubstr("own.json#/tilt_deg: is 60 degrees"), HasSubstr("shadow"), HasSubstr("expected at most")));
  EXPECT_THAT(near, AllOf(HasSubstr("is 15 mm, so near"), HasSubstr("expected at least")));
  // What the lines offer works.
  const auto offered = [](const std::string& line, const std::string& after) {
    return std::stod(line.substr(line.find(after) + after.size()));
  };
  EXPECT_NO_THROW(with(layout, tilted(offered(steep, "expected at most ") - 0.1, 0)));
  EXPECT_NO_THROW(with(layout, lamp(offered(near, "expected at least ") + 0.1)));
  layout.distances = {100};
  layout.offsets = {{-105, 0}};
  EXPECT_NO_THROW(with(layout, tilted(0, 0)));
  EXPECT_THAT(refusal(tilted(40, 0)), HasSubstr("facets that bend such light to the receivers reflect all of it"));
}

} // namespace nephroid::lights_test
