// SPDX-License-Identifier: Apache-2.0
// Smooth surfaces and their meshes: splines against polynomials, meshes against the surface, light without rings.
#include "inverse/bending.h"
#include "inverse/facets/files.h"
#include "inverse/facets/smooth_solid.h"
#include "inverse/judge.h"
#include "tests/inverse/sound.h"
#include "tests/support/render.h"

namespace nephroid::smooth_test {

using namespace inverse;

/// z at the facets' corners.
template <class F>
Grid corners_of(const Layout& layout, const F& z)
{
  Grid grid(layout.facets.y + 1, layout.facets.x + 1);
  for (int b = 0; b <= layout.facets.y; ++b)
    for (int a = 0; a <= layout.facets.x; ++a)
      grid(b, a) = z(glm::dvec2(a * layout.facet().x - layout.size.x / 2, layout.size.y / 2 - b * layout.facet().y));
  return grid;
}

double waves(const glm::dvec2& p) { return 0.05 * std::sin(1.3 * p.x) * std::cos(0.9 * p.y + 0.4); }

// A spline through a quadratic is the quadratic, up to the rim.
TEST(Surface, HasAQuadraticsSlopesAndCurvatures)
{
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
TEST(SmoothSolid, IsClosedWhereFinerFacetsMeetCoarserOnes)
{
  for (const glm::ivec2& facets : {glm::ivec2(12, 9), {1, 1}, {1, 5}, {6, 1}}) {
    const Layout layout{.size = {7, 5}, .thickness = 3, .facets = facets};
    const Surface surface(layout.size, corners_of(layout, waves));
    std::vector<int> parts;
    for (std::size_t i = 0; i < layout.facet_count(); ++i) parts.push_back(1 << (i * 7 % 4));
    const Solid solid = make_smooth_solid(layout, surface, parts);
    test::expect_sound(solid.mesh, scene::signed_volume(solid.mesh, 0, static_cast<std::uint32_t>(solid.mesh.triangles.size())));
    EXPECT_EQ(count_triangles(layout, parts), solid.mesh.triangles.size());
    double volume = 0, area = 0;
    for (int i = 0; i < 6400; ++i) {
      const glm::dvec2 p = (glm::dvec2(i % 80 + 0.5, i / 80 + 0.5) / 80.0 - 0.5) * layout.size; // NOLINT(bugprone-integer-division)
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

// Every triangle's flat slope against the surface's at its corners, over the distance, in cells.
TEST(SmoothSolid, SendsLightAsFarAstrayAsItSays)
{
  const Layout layout{.size = {7, 5}, .thickness = 3, .facets = {28, 20}, .receiver = {7, 5}, .cells = {28, 20}, .distances = {20}};
  const Surface surface(layout.size, corners_of(layout, waves));
  std::size_t before = 0;
  for (const double error : {0.4, 0.1, 0.025}) {
    const Solid solid = make_smooth_solid(layout, surface, mesh_parts(layout, surface, error));
    double squares = 0, area = 0;
    for (std::size_t t = 0; t < solid.parts.size() && solid.parts[t] == Part::facet; ++t) {
      const auto corner = [&](int i) { return glm::dvec3(solid.mesh.positions[solid.mesh.triangles[t][i]]); };
      const glm::dvec3 across = glm::cross(corner(1) - corner(0), corner(2) - corner(0));
      const glm::dvec2 slope = facet_slope(glm::dvec2(across) / -across.z, layout.n);
      for (int i = 0; i < 3; ++i) {
        const glm::dvec2 off = (facet_slope(surface.at(glm::dvec2(corner(i))).gradient, layout.n) - slope) * 20.0 / layout.cell();
        squares += glm::dot(off, off) * std::abs(across.z);
      }
      area += 3 * std::abs(across.z);
    }
    EXPECT_LT(std::sqrt(squares / area), error);
    EXPECT_GT(std::sqrt(squares / area), error / 10) << "no more triangles than it takes";
    EXPECT_GT(solid.mesh.triangles.size(), 2 * before);
    before = solid.mesh.triangles.size();
  }
}

// A bowl sends parallel light evenly to a smaller square. Flat patches overlap there, which makes rings.
TEST(SmoothSolid, ShowsNoRingsInEvenGrey)
{
  const Layout layout{.size = {40, 40}, .thickness = 5, .facets = {32, 32}, .receiver = {20, 20}, .cells = {40, 40}, .distances = {100}};
  const Surface surface(layout.size, corners_of(layout, [](const glm::dvec2& p) { return 0.0066 / 2 * glm::dot(p, p); }));
  std::vector<glm::dvec2> slopes;
  std::vector<double> heights;
  for (std::size_t i = 0; i < layout.facet_count(); ++i) {
    slopes.push_back(facet_slope(surface.at(layout.middle(i)).gradient, layout.n));
    heights.push_back(surface.at(layout.middle(i)).z);
  }
  const auto unevenness = [&](const Solid& solid) {
    Judge judge(test::shared_context(), layout, solid, 1);
    while (!judge.finished()) judge.advance();
    double sum = 0, squares = 0; // of cells against their neighbours: the light falls a little towards the rim
    for (int y = 1; y + 1 < layout.cells.y; ++y)
      for (int x = 1; x + 1 < layout.cells.x; ++x) {
        const auto light = [&](int u, int v) { return judge.light(0)[index_at(u, v, layout.cells.x)]; };
        const double off = light(x, y) - (light(x - 1, y) + light(x + 1, y) + light(x, y - 1) + light(x, y + 1)) / 4;
        sum += light(x, y);
        squares += off * off;
      }
    return std::sqrt(squares * (layout.cells.x - 2) * (layout.cells.y - 2)) / sum;
  };
  EXPECT_LT(unevenness(make_smooth_solid(layout, surface, mesh_parts(layout, surface, 0.1))), 0.03) << "the rays' noise is 0.016";
  EXPECT_GT(unevenness(make_solid(layout, slopes, heights)), 0.1);
}

// Four pixels a facet, between whose middles the surface bends.
TEST(SmoothSolid, HasTheSurfacesHeightsInItsMap)
{
  const Layout layout{.size = {7, 5}, .thickness = 3, .facets = {256, 200}};
  const Surface surface(layout.size, corners_of(layout, [](const glm::dvec2& p) { return 0.1 * std::sin(20 * p.x) * std::cos(30 * p.y); }));
  const Solid solid = make_smooth_solid(layout, surface, std::vector<int>(layout.facet_count(), 1));
  const image::Image map = height_map(layout, solid);
  for (const auto& [x, y] : {std::pair(0, 0), {301, 77}, {1023, 799}, {512, 400}}) {
    const glm::dvec2 p((map.width - 1 - x + 0.5) / map.width * 7 - 3.5, 2.5 - (y + 0.5) / map.height * 5);
    EXPECT_NEAR(map.data[static_cast<std::size_t>(y * map.width + x)], 3 - surface.at(p).z, 1e-6) << x << " " << y;
  }
}

} // namespace nephroid::smooth_test
