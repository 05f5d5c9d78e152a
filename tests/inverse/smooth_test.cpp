// SPDX-License-Identifier: Apache-2.0
// Smooth surfaces and their meshes: splines against polynomials, meshes against the surface, light without rings.
#include "inverse/bending.h"
#include "inverse/facets/files.h"
#include "inverse/facets/smooth_solid.h"
#include "inverse/judge.h"
#include "tests/inverse/sound.h"
#include "tests/support/render.h"

#include <glm/gtc/constants.hpp>

#include <complex>
#include <numeric>

namespace nephroid::smooth_test {

using namespace inverse;

/// z at the facets' corners.
template <class F>
Grid corners_of(const Layout& layout, const F& z) {
  Grid grid(layout.facets.y + 1, layout.facets.x + 1);
  for (int b = 0; b <= layout.facets.y; ++b)
    for (int a = 0; a <= layout.facets.x; ++a)
      grid(b, a) = z(glm::dvec2(a * layout.facet().x - layout.size.x / 2, layout.size.y / 2 - b * layout.facet().y));
  return grid;
}

double waves(const glm::dvec2& p) { return 0.05 * std::sin(1.3 * p.x) * std::cos(0.9 * p.y + 0.4); }

// A spline through a quadratic is the quadratic, up to the rim.
TEST(Surface, HasAQuadraticsSlopesAndCurvatures) {
  const Layout layout{.size = {7, 5}, .facets = {9, 4}};
  const Surface surface(layout.size, corners_of(layout, [](const glm::dvec2& p) {
                          return 0.3 + 0.2 * p.x - 0.1 * p.y + 0.05 * p.x * p.x + 0.03 * p.x * p.y - 0.04 * p.y * p.y;
                        }));
  for (const glm::dvec2& p : {glm::dvec2(0.3, 0.7), {-3.5, 2.5}, {3.4, -2.4}, {1.1, -0.2}}) {
    const Surface::At at = surface.at(p);
    EXPECT_NEAR(at.z, 0.3 + 0.2 * p.x - 0.1 * p.y + 0.05 * p.x * p.x + 0.03 * p.x * p.y - 0.04 * p.y * p.y, 1e-12);
    EXPECT_NEAR(at.gradient.x, 0.2 + 0.1 * p.x + 0.03 * p.y, 1e-12);
    EXPECT_NEAR(at.gradient.y, -0.1 + 0.03 * p.x - 0.08 * p.y, 1e-12);
    EXPECT_NEAR(at.curvature[0][0], 0.1, 1e-11);
    EXPECT_NEAR(at.curvature[0][1], 0.03, 1e-11);
    EXPECT_NEAR(at.curvature[1][1], -0.08, 1e-11);
  }
}

// Neighbours in 1, 2, 4 and 8 parts.
TEST(SmoothSolid, IsClosedWhereFinerFacetsMeetCoarserOnes) {
  for (const glm::ivec2& facets : {glm::ivec2(12, 9), {1, 1}, {1, 5}, {6, 1}}) {
    const Layout layout{.size = {7, 5}, .thickness = 3, .facets = facets};
    const Surface surface(layout.size, corners_of(layout, waves));
    std::vector<int> parts;
    for (std::size_t i = 0; i < mesh_layout(layout).facet_count(); ++i) parts.push_back(1 << (i * 7 % 4));
    const Solid solid = make_smooth_solid(layout, surface, parts);
    test::expect_sound(solid.mesh,
                       scene::signed_volume(solid.mesh, 0, static_cast<std::uint32_t>(solid.mesh.triangles.size())));
    EXPECT_EQ(count_triangles(layout, parts), solid.mesh.triangles.size());
    double volume = 0, area = 0;
    for (int i = 0; i < 6400; ++i) {
      const glm::dvec2 p =
          (glm::dvec2(i % 80 + 0.5, i / 80 + 0.5) / 80.0 - 0.5) * layout.size; // NOLINT(bugprone-integer-division)
      volume += (layout.thickness - surface.at(p).z) * 35 / 6400;
    }
    for (std::size_t t = 0; t < solid.parts.size(); ++t)
      if (solid.parts[t] == Part::front) {
        const glm::uvec3& corner = solid.mesh.triangles[t];
        const glm::vec3 a = solid.mesh.positions[corner.x];
        area += glm::cross(solid.mesh.positions[corner.y] - a, solid.mesh.positions[corner.z] - a).z / 2;
      }
    EXPECT_NEAR(area, 35, 1e-4) << "the front faces up and has no gaps";
    const double has = scene::signed_volume(solid.mesh, 0, static_cast<std::uint32_t>(solid.mesh.triangles.size()));
    EXPECT_NEAR(has / volume, 1, 2e-3);
  }
}

// Every triangle's flat slope against the surface's at its corners, over the distance, in cells. Light counts as it is
// bright where it lands: as much as the surface's map makes the triangle smaller. What is astray where light is
// gathered is seen as much less.
TEST(SmoothSolid, SendsLightAsFarAstrayAsItSays) {
  const Layout layout{
      .size = {7, 5}, .thickness = 3, .facets = {28, 20}, .receiver = {7, 5}, .cells = {28, 20}, .distances = {20}};
  const Surface surface(layout.size, corners_of(layout, waves));
  std::size_t before = 0;
  for (const double error : {0.4, 0.1, 0.025}) {
    const Solid solid = make_smooth_solid(layout, surface, mesh_parts(layout, surface, error));
    double squares = 0, area = 0;
    for (std::size_t t = 0; t < solid.parts.size() && solid.parts[t] == Part::facet; ++t) {
      const auto corner = [&](int i) { return glm::dvec3(solid.mesh.positions[solid.mesh.triangles[t][i]]); };
      const glm::dvec3 across = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
      const glm::dvec2 slope = facet_slope(glm::dvec2(across) / -across.z, layout.n);
      std::array<glm::dvec2, 3> slopes, lands;
      for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        slopes[k] = facet_slope(surface.at(glm::dvec2(corner(i))).gradient, layout.n);
        lands[k] = glm::dvec2(corner(i)) + slopes[k] * 20.0;
      }
      const glm::dvec2 u = lands[1] - lands[0], v = lands[2] - lands[0];
      const double bright = std::abs(across.z) / std::max(std::abs(u.x * v.y - u.y * v.x), std::abs(across.z) / 1000),
                   light = std::abs(across.z) * bright, seen = std::min(1.0, 1 / bright);
      for (const glm::dvec2& at_corner : slopes) {
        const glm::dvec2 off = (at_corner - slope) * 20.0 / layout.cell() * seen;
        squares += glm::dot(off, off) * light;
      }
      area += 3 * light;
    }
    EXPECT_LT(std::sqrt(squares / area), error);
    EXPECT_GT(std::sqrt(squares / area), error / 10) << "no more triangles than it takes";
    EXPECT_GT(solid.mesh.triangles.size(), 2 * before);
    before = solid.mesh.triangles.size();
  }
}

// The ellipse within 7 x 5, cut out of facets in 1, 2, 4 and 8 parts.
TEST(SmoothSolid, IsClosedAlongARoundOutline) {
  for (const glm::ivec2& facets : {glm::ivec2(12, 9), {1, 1}, {1, 5}, {6, 1}, {40, 40}}) {
    const Layout layout{.size = {7, 5}, .round = true, .thickness = 3, .facets = facets};
    const Surface surface(layout.size, corners_of(layout, waves));
    for (const int most : {1, 4}) {
      std::vector<int> parts;
      for (std::size_t i = 0; i < mesh_layout(layout).facet_count(); ++i)
        parts.push_back(1 << (i * 7 % static_cast<std::size_t>(most)));
      const Solid solid = make_smooth_solid(layout, surface, parts);
      test::expect_sound(solid.mesh,
                         scene::signed_volume(solid.mesh, 0, static_cast<std::uint32_t>(solid.mesh.triangles.size())));
      std::array<double, 4> area{}; // of each part, as the light sees it
      for (std::size_t t = 0; t < solid.parts.size(); ++t) {
        const glm::uvec3& corner = solid.mesh.triangles[t];
        const glm::dvec3 a = solid.mesh.positions[corner.x], b = solid.mesh.positions[corner.y],
                         c = solid.mesh.positions[corner.z];
        area[static_cast<std::size_t>(solid.parts[t])] += glm::cross(b - a, c - a).z / 2;
        for (const glm::dvec3& p : {a, b, c}) EXPECT_LT(glm::length(glm::dvec2(p) / layout.size), 0.5 + 1e-6);
      }
      const image::Image map = height_map(layout, solid);
      EXPECT_EQ(map.data.front(), 0);
      EXPECT_GT(map.data[map.data.size() / 2 + static_cast<std::size_t>(map.width) / 2], 2);
      EXPECT_THAT(workshop_page(layout, solid, "glass"), HasSubstr("an ellipse"));
      EXPECT_NEAR(area[static_cast<std::size_t>(Part::facet)], -area[static_cast<std::size_t>(Part::front)], 1e-4);
      EXPECT_NEAR(area[static_cast<std::size_t>(Part::side)], 0, 1e-4);
      const double ellipse = glm::pi<double>() * 3.5 * 2.5, has = area[static_cast<std::size_t>(Part::front)];
      EXPECT_LT(has, ellipse);
      EXPECT_GT(has / ellipse, facets.x * facets.y > 100 ? 0.995 : 0.5) << facets.x << " " << most;
    }
  }
}

// A long facet is cut across, so that a mesh of the same error takes no more triangles than one of short facets.
TEST(SmoothSolid, HasFewTrianglesForLongFacets) {
  const auto triangles = [](const glm::ivec2& facets) {
    const Layout layout{.size = {60, 60},
                        .thickness = 3,
                        .facets = facets,
                        .receiver = {60, 60},
                        .cells = {60, 60},
                        .distances = {200}};
    const Surface surface(layout.size, corners_of(layout, [](const glm::dvec2& p) { return 0.002 * glm::dot(p, p); }));
    return count_triangles(layout, mesh_parts(layout, surface, 0.3));
  };
  EXPECT_LT(static_cast<double>(triangles({3, 120})), 1.1 * static_cast<double>(triangles({120, 120})));
}

/// How strong waves along the rows of a window in an even grey are, in parts of the grey: the strongest of those of two
/// cells and longer, and the noise of rays. Two judges with other rays see the same waves and another noise. So the
/// mean over rows of one's spectrum times the other's has the waves alone, and their difference has the noise alone.
struct Waves {
  double strongest = 0, noise = 0;
};

constexpr int first_wave = 8; ///< of those across the window: longer ones are the light's fall towards the rim

Waves waves_in(const Layout& layout, const Solid& solid) {
  const int n = layout.cells.x;
  std::vector<std::vector<std::complex<double>>> spectra; // of each judge, row by row
  for (const std::uint64_t seed : {1u, 2u}) {
    Judge judge(test::shared_context(), layout, solid, seed);
    while (!judge.finished()) judge.advance();
    const std::vector<double>& light = judge.light(0);
    const double mean = std::accumulate(light.begin(), light.end(), 0.0) / static_cast<double>(light.size());
    spectra.emplace_back();
    for (int y = 0; y < n; ++y)
      for (int k = first_wave; k <= n / 2; ++k) {
        std::complex<double> sum = 0;
        for (int x = 0; x < n; ++x)
          sum += (light[index_at(x, y, n)] / mean - 1) * std::polar(1.0, -2 * glm::pi<double>() * k * x / n) *
                 (1 - std::cos(2 * glm::pi<double>() * (x + 0.5) / n));
        spectra.back().push_back(2.0 / n * sum);
      }
  }
  Waves found;
  const auto waves = static_cast<std::size_t>(n / 2 - first_wave + 1);
  for (std::size_t k = 0; k < waves; ++k) {
    double both = 0, differ = 0;
    for (std::size_t row = 0; row < static_cast<std::size_t>(n); ++row) {
      const std::complex<double> a = spectra[0][row * waves + k], b = spectra[1][row * waves + k];
      both += (a * std::conj(b)).real() / n;
      differ += std::norm(a - b) / 2 / n;
    }
    found.strongest = std::max(found.strongest, std::sqrt(std::max(0.0, both)));
    found.noise = std::max(found.noise, std::sqrt(differ));
  }
  return found;
}

// A bowl sends parallel light evenly to a square of 60 mm, of which the receiver is a window. Facets, cells and the
// mesh's error are the defaults. A flat patch of every facet covers 2.8 times the place that it has. Patches that
// overlap make waves with the cells: rings.
TEST(SmoothSolid, ShowsNoRingsInEvenGrey) {
  Layout layout;
  layout.receiver = {51, 51};
  layout.distances = {150};
  const Surface surface(layout.size, corners_of(layout, [&](const glm::dvec2& p) {
                          return 0.4 / 150 / (layout.n - 1) / 2 * glm::dot(p, p);
                        }));
  std::vector<glm::dvec2> slopes;
  std::vector<double> heights;
  for (std::size_t i = 0; i < layout.facet_count(); ++i) {
    slopes.push_back(facet_slope(surface.at(layout.middle(i)).gradient, layout.n));
    heights.push_back(surface.at(layout.middle(i)).z);
  }
  const Waves smooth =
                  waves_in(layout, make_smooth_solid(layout, surface, mesh_parts(layout, surface, even_mesh_error))),
              flat = waves_in(layout, make_solid(layout, slopes, heights));
  EXPECT_LT(smooth.strongest, 0.01) << "the rays' noise is " << smooth.noise;
  EXPECT_GT(flat.strongest, 0.02);
}

// Four pixels a facet, between whose middles the surface bends.
TEST(SmoothSolid, HasTheSurfacesHeightsInItsMap) {
  const Layout layout{.size = {7, 5}, .thickness = 3, .facets = {256, 200}};
  const Surface surface(layout.size, corners_of(layout, [](const glm::dvec2& p) {
                          return 0.1 * std::sin(20 * p.x) * std::cos(30 * p.y);
                        }));
  const Solid solid = make_smooth_solid(layout, surface, std::vector<int>(layout.facet_count(), 1));
  const image::Image map = height_map(layout, solid);
  for (const auto& [x, y] : {std::pair(0, 0), {301, 77}, {1023, 799}, {512, 400}}) {
    const glm::dvec2 p((map.width - 1 - x + 0.5) / map.width * 7 - 3.5, 2.5 - (y + 0.5) / map.height * 5);
    EXPECT_NEAR(map.data[static_cast<std::size_t>(y * map.width + x)], 3 - surface.at(p).z, 1e-6) << x << " " << y;
  }
}

} // namespace nephroid::smooth_test
