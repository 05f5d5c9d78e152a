// SPDX-License-Identifier: Apache-2.0
// Finished objects as meshes and as maps: a run's own mesh is judged as the run was; a map of a smooth surface, a
// thicker object, a deviation that is known, and what is refused.
#include "inverse/assign/footprint.h"
#include "inverse/bending.h"
#include "inverse/facets/files.h"
#include "inverse/facets/smooth_solid.h"
#include "inverse/finished.h"
#include "inverse/judge.h"
#include "tests/inverse/searches.h"

#include <random>

namespace nephroid::finished_test {

using namespace inverse;
using inverse::Layout;

Layout few_facets() {
  return {.size = {40, 30}, .facets = {16, 12}, .receiver = {40, 30}, .cells = {8, 6}, .distances = {100, 200}};
}

/// Facets that lean this way and that.
Solid facets(const Layout& layout) {
  std::vector<glm::dvec2> slopes;
  for (std::size_t i = 0; i < layout.facet_count(); ++i)
    slopes.push_back(0.1 * glm::dvec2(std::sin(3.0 * static_cast<double>(i)), std::cos(5.0 * static_cast<double>(i))));
  return make_solid(layout, slopes);
}

std::vector<double> light(const Layout& layout, const Solid& solid) {
  Judge judge(test::shared_context(), layout, solid, 1);
  while (!judge.finished()) judge.advance();
  return judge.light(1);
}

std::array<double, 4> areas(const Solid& solid) {
  std::array<double, 4> of_parts{};
  for (std::size_t i = 0; i < solid.parts.size(); ++i) {
    const glm::uvec3& t = solid.mesh.triangles[i];
    const glm::dvec3 a = solid.mesh.positions[t.x], b = solid.mesh.positions[t.y], c = solid.mesh.positions[t.z];
    of_parts[static_cast<std::size_t>(solid.parts[i])] += glm::length(glm::cross(b - a, c - a)) / 2;
  }
  return of_parts;
}

std::string why_not(const Layout& layout, const scene::Mesh& mesh) {
  return test::error_of([&] { solid_of_mesh(layout, mesh, Location("made.stl")); }).line();
}

// Walls are found by their steepness, sides by where they are. A draft's patches between facets may be either.
TEST(Finished, MeshesAreTheSolidThatTheyWereMadeOf) {
  Layout leaning = few_facets();
  leaning.draft = 0.1;
  for (const Layout& layout : {few_facets(), leaning}) {
    const Solid solid = facets(layout);
    scene::Mesh turned = solid.mesh;
    scene::turn_triangles(turned);
    for (const scene::Mesh& mesh : {solid.mesh, turned}) {
      const Solid made = solid_of_mesh(layout, mesh, Location("made.stl"));
      EXPECT_EQ(light(layout, made), light(layout, solid));
      for (std::size_t part = 0; part < 4; ++part)
        EXPECT_NEAR(areas(made)[part], areas(solid)[part], layout.draft > 0 ? 12 : 1e-3) << part; // of 1200 mm^2
    }
  }
}

TEST(Finished, WhatIsNoSuchObjectIsRefused) {
  const Layout layout = few_facets();
  scene::Mesh mesh = facets(layout).mesh, open = mesh, inches = mesh, upside_down = mesh, beside = mesh;
  open.triangles.pop_back();
  for (glm::vec3& p : inches.positions) p /= 25.4f;
  for (glm::vec3& p : upside_down.positions) p = {p.x, -p.y, 10 - p.z};
  for (glm::vec3& p : beside.positions) p.x += 20;
  EXPECT_THAT(why_not(layout, open), testing::HasSubstr("made.stl: has holes: 3 edges have one triangle"));
  EXPECT_THAT(why_not(layout, inches), testing::HasSubstr("is 1.5748 x 1.1811 mm, and the design 40 x 30 mm"));
  EXPECT_THAT(why_not(layout, upside_down), testing::HasSubstr("no flat side at the top"));
  EXPECT_THAT(why_not(layout, beside), testing::HasSubstr("has its middle at (20, 0) mm"));
  image::Image map = height_map(layout, facets(layout));
  map.data[5] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(test::error_of([&] { solid_of_heights(layout, map, Location("made.exr")); }).line(),
              testing::HasSubstr("made.exr: has holes: 1 of "));
}

// Facets are planes, but for the pixels at their edges.
TEST(Finished, AMapIsTheSolidThatItWasMadeOf) {
  const Layout layout = few_facets();
  const Solid solid = facets(layout), made = solid_of_heights(layout, height_map(layout, solid), Location("made.exr"));
  EXPECT_TRUE(scene::inspect(made.mesh).closed());
  const double volume = scene::inspect(solid.mesh).signed_volume;
  EXPECT_NEAR(scene::inspect(made.mesh).signed_volume, volume, 1e-4 * volume);
  EXPECT_NEAR(top_of(made), layout.thickness, 1e-3);
  const Deviation off = deviation(layout, solid, made, 1);
  EXPECT_LT(off.median_cells, 1e-3);
  const double pixels = static_cast<double>(height_map(layout, solid).width) / layout.facets.x;
  EXPECT_LT(off.part_off, 1.01 - std::pow(1 - 1 / pixels, 2));
}

// A prism of the gradient g in a surface of otherwise flat facets: light goes (n - 1) g of the distance aside.
TEST(Finished, DeviationsAreInCells) {
  const Layout layout = few_facets();
  std::vector<glm::dvec2> slopes(layout.facet_count());
  const Solid flat = make_solid(layout, slopes);
  slopes[37] = {0.04, 0};
  const Deviation off = deviation(layout, flat, make_solid(layout, slopes), 1); // 8 mm over cells of 5 mm
  for (std::size_t i = 0; i < slopes.size(); ++i) EXPECT_EQ(off.off[i], i == 37 ? 1 : 0) << i;
  EXPECT_NEAR(off.part_off, 1.0 / static_cast<double>(slopes.size()), 1e-6);
  EXPECT_EQ(deviation(layout, flat, make_solid(layout, slopes), 0).part_off, 0); // 4 mm
}

TEST(Finished, TheFlatSideMoves) {
  const Layout layout = few_facets();
  Solid solid = facets(layout);
  const double volume = scene::inspect(solid.mesh).signed_volume;
  move_top(solid, layout.thickness + 2);
  EXPECT_NEAR(scene::inspect(solid.mesh).signed_volume, volume + 2 * 40 * 30, 1e-3 * volume);
}

TEST(Finished, ScreensAreAboutTheirReceivers) {
  Layout layout = few_facets();
  layout.offsets = {{{1, 2}, {3, 4}}};
  const Layout through = through_focus(layout, 0.1, 5);
  ASSERT_EQ(through.distances.size(), 10u);
  for (const auto& [screen, distance] : {std::pair{0u, 90.0}, {2u, 100.0}, {4u, 110.0}, {5u, 180.0}, {9u, 220.0}})
    EXPECT_NEAR(through.distances[screen], distance, 1e-9);
  EXPECT_EQ(through.offset(9), glm::dvec2(3, 4));
}

} // namespace nephroid::finished_test
