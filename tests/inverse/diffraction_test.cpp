// SPDX-License-Identifier: Apache-2.0
// Light that facets spread because it is a wave: the judge against Fraunhofer's slit and square, by the phases over a
// tilted facet; footprints beside it; and what is said of it.
#include "inverse/assign/device_facets.h"
#include "inverse/assign/footprint.h"
#include "inverse/bending.h"
#include "inverse/diffraction.h"
#include "inverse/judge.h"
#include "tests/inverse/searches.h"

#include <glm/gtc/constants.hpp>

namespace nephroid::diffraction_test {

using namespace inverse;
using inverse::Layout;

constexpr double nm = 1e-6; // in mm

double sinc_squared(double t) {
  const double x = glm::pi<double>() * t;
  return x == 0 ? 1 : std::pow(std::sin(x) / x, 2);
}

/// 30 x 30 facets side by side, 1 m before a screen. Each spreads light by 10 cells at 500 nm.
Layout many_facets(const glm::dvec2& facet = {0.05, 0.05}) {
  return {.size = 30.0 * facet,
          .facets = {30, 30},
          .receiver = {61, 61},
          .cells = {61, 61},
          .distances = {1000},
          .wavelength = 500 * nm,
          .diffracts = true};
}

Judge judged(const Layout& layout, const glm::dvec2& slope) {
  Judge judge(test::shared_context(), layout, make_solid(layout, std::vector<glm::dvec2>(layout.facet_count(), slope)),
              7);
  while (!judge.finished()) judge.advance();
  return judge;
}

/// Fraunhofer's integral (Hecht 2017, Optics, 10.2.4): the phases over the facet, which lies in its own plane, are
/// those of the way to a place less those of the way where rays go. The mean over the facets; it sums to 1 over all
/// places.
std::vector<double> fraunhofer(const Layout& layout, const glm::dvec2& slope, double wavelength) {
  constexpr int parts = 12; // of a cell and of the row of facets, along each axis
  const glm::dvec2 g = facet_gradient(slope, layout.n), facet = layout.facet();
  const glm::dvec3 straight = direction_of(slope);
  const double distance = layout.distances[0];
  std::vector<double> light(layout.cell_count());
  const glm::ivec2 fine = parts * layout.cells;
  const auto phases = [&](const glm::dvec2& way) { // in turns over the facet
    const glm::dvec3 change = direction_of(way / distance) - straight;
    return facet / wavelength * (glm::dvec2(change) + g * change.z);
  };
  for (std::size_t i = 0; i < light.size() * parts * parts; ++i) {
    const glm::dvec2 at = Layout::middle_of(i, fine, layout.receiver) + layout.offset(0);
    glm::dvec2 turns = phases(at);
    constexpr double step = 1e-3;
    const glm::dmat2 by_place((phases(at + glm::dvec2(step, 0)) - turns) / step,
                              (phases(at + glm::dvec2(0, step)) - turns) / step);
    const double there = sinc_squared(turns.x) * sinc_squared(turns.y) * std::abs(glm::determinant(by_place)) *
                         layout.cell().x * layout.cell().y / parts / parts;
    const auto columns = static_cast<std::size_t>(fine.x);
    light[index_at(static_cast<int>(i % columns) / parts, static_cast<int>(i / columns) / parts, layout.cells.x)] +=
        there;
  }
  return light;
}

/// The sum of all differences; `a` is scaled to all of the light.
double difference(const std::vector<double>& a, double sent, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t c = 0; c < a.size(); ++c) sum += std::abs(a[c] / sent - b[c]);
  return sum;
}

// The facets together are 1.5 mm wide, a cell and a half: beside ten cells of spread that is .002 of the light.
TEST(Diffraction, OfASquareIsFraunhofers) {
  for (const glm::dvec2& slope : {glm::dvec2(0), glm::dvec2(0.3, 0.1), glm::dvec2(-0.2, 0.45)}) {
    Layout layout = many_facets();
    layout.offsets = {{slope * 1000.0}};
    const Judge judge = judged(layout, slope);
    const std::vector<double> truth = fraunhofer(layout, slope, layout.wavelength);
    EXPECT_LT(difference(judge.light(0), judge.outcomes().sent * 900, truth), 0.025) << slope.x << ' ' << slope.y;
    layout.diffracts = false;
    const Judge rays = judged(layout, slope);
    EXPECT_GT(difference(rays.light(0), rays.outcomes().sent * 900, truth), 1.5);
  }
}

// .902823 of a slit's light is between its first two zeros (Si(2 pi) 2 / pi).
TEST(Diffraction, OfASlitHasItsLightBetweenTheZeros) {
  Layout layout = many_facets({0.05, 1});
  layout.receiver = {20, 100};
  layout.cells = {2, 2};
  const Judge judge = judged(layout, {});
  const double sent = judge.outcomes().sent * 900;
  double within = 0, above = 0;
  for (const double cell : judge.light(0)) within += cell / sent;
  for (const std::size_t c : {0u, 1u}) above += judge.light(0)[c] / sent;
  EXPECT_NEAR(within, 0.902823, 1e-3); // the facets are 1.5 of 20 mm wide: less at the edges by .0003
  EXPECT_NEAR(above, within / 2, 1e-3);
}

// Red light spreads more than blue light, as the wavelengths are.
TEST(Diffraction, OfEachColourIsItsOwn) {
  Layout layout = many_facets();
  const double mean = 550;
  layout.wavelength = mean * nm;
  layout.spectrum = Spectrum{{{1.5, {0, 0.5, 1}, 450}, {1.5, {1, 0.5, 0}, 650}}, true};
  const Judge judge = judged(layout, {});
  const std::vector<glm::dvec3> xyz = judge.colours(0);
  for (const auto& [channel, wavelength] : {std::pair{0, 650.0}, std::pair{2, 450.0}}) {
    std::vector<double> light;
    for (const glm::dvec3& cell : xyz) light.push_back(cell[channel]);
    EXPECT_LT(difference(light, judge.outcomes().sent * 900, fraunhofer(layout, {}, wavelength * nm)), 0.03) << channel;
    EXPECT_GT(difference(light, judge.outcomes().sent * 900, fraunhofer(layout, {}, mean * nm)), 0.1) << channel;
  }
}

// Footprints have a box instead. Over a place as wide as the spread it is a third off, rays are all off.
TEST(Diffraction, IsABoxInFootprints) {
  for (const glm::dvec2& slope : {glm::dvec2(0), glm::dvec2(0.3, 0.1)}) {
    Layout layout = many_facets();
    layout.offsets = {{slope * 1000.0}};
    const std::vector<double> truth = fraunhofer(layout, slope, layout.wavelength);
    const std::vector<glm::dvec2> slopes(900, slope);
    const std::vector<double> heights(900);
    const auto light = [&] { return light_of_all(layout, slopes, heights)[0]; };
    const double sent = light_sent(layout, slopes);
    EXPECT_LT(difference(light(), sent, truth), 0.55);
    DeviceFacets device(test::shared_context(), layout, {Target(layout.cell_count(), 1.0)}, std::vector{1.0});
    device.put(slopes, heights);
    const std::vector<double> on_device = device.light()[0], on_host = light();
    for (std::size_t c = 0; c < on_host.size(); ++c) EXPECT_NEAR(on_device[c], on_host[c], 1e-3);
    layout.diffracts = false;
    EXPECT_GT(difference(light(), sent, truth), 1.5);
  }
}

// Where it is below a quarter of a cell, footprints and their kernels leave it out.
TEST(Diffraction, IsLeftOutOfFootprintsThatDoNotShowIt) {
  Layout layout = many_facets();
  EXPECT_TRUE(layout.blurs());
  EXPECT_EQ(layout.wave_width(), 1.2 * layout.diffraction());
  layout.distances = {20};
  EXPECT_FALSE(layout.blurs());
}

} // namespace nephroid::diffraction_test
