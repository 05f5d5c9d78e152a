// SPDX-License-Identifier: Apache-2.0
// What a workshop gets: walls that lean, errors of making and what they do, the page to print.
#include "inverse/facets/files.h"
#include "inverse/facets/plate.h"
#include "inverse/facets/tool.h"
#include "inverse/print_page.h"
#include "inverse/tolerances.h"
#include "tests/inverse/sound.h"
#include "tests/support/render.h"
#include "tests/support/saved_jobs.h"

#include <regex>

namespace nephroid::workshop_test {

using namespace inverse;
using inverse::Layout;

Layout drafted(Layout layout, double degrees) {
  layout.draft = std::tan(glm::radians(degrees));
  return layout;
}

void expect_closed(const scene::Mesh& mesh) {
  const scene::MeshReport report = scene::inspect(mesh);
  EXPECT_EQ(report.open_edges, 0u);
  EXPECT_EQ(report.crowded_edges, 0u);
  EXPECT_EQ(report.degenerate, 0u);
  EXPECT_EQ(report.duplicated, 0u);
  EXPECT_GT(report.signed_volume, 0); // outwards
  EXPECT_EQ(test::bodies(mesh), 1u);
}

glm::dvec3 normal_of(const scene::Mesh& mesh, std::size_t triangle) {
  const glm::uvec3& t = mesh.triangles[triangle];
  const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
  return glm::normalize(glm::cross(b - a, c - a));
}

// By the mesh itself: no wall is steeper, some are as steep, and facets look where they looked before.
TEST(Draft, WallsLeanAndFacetsStay) {
  for (const double degrees : {1.0, 5.0, 12.0}) {
    const Layout layout = drafted(test::small(23, 17), degrees);
    const std::vector<glm::dvec2> slopes = test::random_slopes(layout, 0.3, 4);
    const Solid solid = make_solid(layout, slopes);
    expect_closed(solid.mesh);
    double steepest = 0;
    std::size_t facet = 0;
    for (std::size_t t = 0; t < solid.parts.size(); ++t) {
      const glm::dvec3 normal = normal_of(solid.mesh, t);
      if (solid.parts[t] == Part::wall) steepest = std::max(steepest, glm::degrees(std::acos(std::abs(normal.z))));
      if (solid.parts[t] == Part::facet) {
        EXPECT_GT(glm::dot(normal, inverse::normal_of(layout, facet / 2, slopes[facet / 2])), 1 - 1e-6);
        ++facet;
      }
    }
    EXPECT_LT(steepest, 90 - degrees + 0.05);
    EXPECT_GT(steepest, 90 - degrees - 1);
    EXPECT_NEAR(solid.steepest_wall_deg, steepest, 0.05);
    EXPECT_THAT(workshop_page(layout, solid, "glass"), HasSubstr("degrees from the front |\n| highest wall"));
  }
}

TEST(Draft, IsClosedWhereHeightsTieAndInOneRow) {
  for (const glm::ivec2& facets :
       {glm::ivec2(1, 1), glm::ivec2(1, 9), glm::ivec2(9, 1), glm::ivec2(2, 2), glm::ivec2(8, 8)}) {
    const Layout layout = drafted(test::small(facets.x, facets.y), 5);
    std::vector<glm::dvec2> slopes(layout.facet_count());
    expect_closed(make_solid(layout, slopes).mesh);
    for (std::size_t i = 0; i < slopes.size(); ++i)
      slopes[i] = 0.2 * glm::dvec2(static_cast<double>(i % 3) - 1, static_cast<double>(i / 2 % 3) - 1);
    expect_closed(make_solid(layout, slopes).mesh);
  }
}

// Walls without height are part of the window: both sides let 0.96 through.
TEST(Draft, OfASlabIsAWindow) {
  const Layout layout = drafted({.facets = {16, 16}, .cells = {8, 8}, .distances = {50}}, 5);
  const Solid solid = make_solid(layout, std::vector<glm::dvec2>(256));
  Judge judge(test::shared_context(), layout, solid, 1);
  while (!judge.finished()) judge.advance();
  EXPECT_NEAR(judge.outcomes().sent, 0.96 * 0.96, 1e-6);
}

TEST(Draft, AMeshRepairerFindsNothingToRepair) {
  if (std::system("admesh --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "needs the package admesh";
  const test::TemporaryFolder folder;
  const Layout layout = drafted(test::small(15, 11), 4);
  const Solid solid = make_solid(layout, test::random_slopes(layout, 0.5, 2));
  const auto stl = folder.path() / "object.stl", said = folder.path() / "said";
  write_file_whole(stl, [&](ByteSink& to) { inverse::write_stl(solid.mesh, to); });
  ASSERT_EQ(std::system(("admesh '" + stl.string() + "' > '" + said.string() + "'").c_str()), 0);
  const std::string report = read_file(said);
  for (const char* nothing :
       {"Total disconnected facets", "Degenerate facets", "Edges fixed", "Facets reversed", "Backwards edges"})
    EXPECT_TRUE(std::regex_search(report, std::regex(nothing + std::string(" *: *0\\b")))) << nothing << "\n" << report;
  EXPECT_TRUE(std::regex_search(report, std::regex("Number of parts *: *1\\b"))) << report;
}

TEST(Tolerances, WavesHaveTheirHeightAndLeaveTheFront) {
  const Layout layout{.facets = {100, 100}};
  const Solid flat = make_solid(layout, std::vector<glm::dvec2>(10000)), off = with_waves(layout, flat, 0.02, 3);
  double squares = 0, count = 0;
  for (std::size_t i = 0; i < flat.mesh.positions.size(); ++i) {
    const glm::vec3 a = flat.mesh.positions[i], b = off.mesh.positions[i];
    if (a.z > 9) {
      EXPECT_EQ(a, b);
      continue;
    }
    squares += static_cast<double>(b.z - a.z) * (b.z - a.z);
    ++count;
  }
  EXPECT_NEAR(std::sqrt(squares / count), 0.02, 0.002);
}

std::vector<Tolerances::Row> all_of(Tolerances& tolerances) {
  while (!tolerances.finished()) tolerances.advance();
  return tolerances.rows();
}

// A slab that is turned or stands farther away stays a window: all cells alike, but the rim by the turn's tan(1 degree)
// * 50 mm / 3 or so. Waves of 20 um and 5 mm bend light by a slope of 0.5 * 2 pi 0.02 / 5 = 0.013: 1.3 mm at 100 mm, a
// fraction of their length. Light from a degree aside moves it by 1.75 mm: a column in 20 loses 0.35 of its light.
TEST(Tolerances, OfASlabAreThoseOfAWindow) {
  const Layout layout{.facets = {48, 48}, .cells = {20, 20}, .distances = {100}};
  const Solid solid = make_solid(layout, std::vector<glm::dvec2>(layout.facet_count()));
  const std::vector<Target> targets{Target(400, 1.0 / 400)};
  Tolerances tolerances(test::shared_context(), layout, targets, solid, 1);
  const auto rows = all_of(tolerances);
  ASSERT_THAT(rows, SizeIs(6));
  EXPECT_LT(rows[0].costs[0].rel_l2, rows[2].costs[0].rel_l2 / 5); // 1 um
  EXPECT_GT(rows[2].costs[0].rel_l2, 0.05);
  EXPECT_LT(rows[3].costs[0].rel_l2, 0.02);
  EXPECT_NEAR(rows[4].costs[0].rel_l2, 0.35 / std::sqrt(20), 0.01);
  EXPECT_LT(rows[5].costs[0].rel_l2, 5e-3); // cells part facets, whose rays are jittered
}

// Waves are the same on wide facets as on narrow ones: a slab of 16 x 16 facets, 6 mm wide each, is off like one of 80
// x 80.
TEST(Tolerances, WavesBendWideFacets) {
  const auto off = [](int across) {
    const Layout layout{.facets = {across, across}, .cells = {20, 20}, .distances = {100}};
    const Solid solid = with_waves(layout, make_solid(layout, std::vector<glm::dvec2>(layout.facet_count())), 0.02, 1);
    expect_closed(solid.mesh);
    Judge judge(test::shared_context(), layout, solid, 1);
    while (!judge.finished()) judge.advance();
    return judge.costs({Target(400, 1.0 / 400)}).front().rel_l2;
  };
  const double narrow = off(80);
  EXPECT_NEAR(off(16) / narrow, 1, 0.1);
}

// Cut within the second error.
TEST(Tolerances, GoOnWithTheSameFigures) {
  const Layout layout{.facets = {24, 24}, .cells = {12, 12}, .distances = {80, 160}};
  const Solid solid = make_solid(layout, test::random_slopes(layout, 0.2, 1));
  const std::vector<Target> targets(2, Target(144, 1.0 / 144));
  Tolerances whole(test::shared_context(), layout, targets, solid, 1),
      first(test::shared_context(), layout, targets, solid, 1),
      second(test::shared_context(), layout, targets, solid, 1);
  for (int i = 0; i < 17; ++i) first.advance();
  ASSERT_TRUE(test::load<Archive>(second, test::saved<Archive>(first)));
  const auto is = all_of(second), expected = all_of(whole);
  ASSERT_EQ(is.size(), expected.size());
  for (std::size_t i = 0; i < is.size(); ++i) {
    EXPECT_EQ(is[i].what, expected[i].what);
    for (const std::size_t j : {0u, 1u}) EXPECT_EQ(is[i].costs[j].rel_l2, expected[i].costs[j].rel_l2);
  }
  EXPECT_THAT(tolerance_csv(is[0].costs, is), StartsWith("error,receiver,cost,rel_l2\nnone,1,"));
  EXPECT_THAT(tolerance_table(is[0].costs, is), HasSubstr("\n| receivers 1 % farther | "));
}

job::Picture grey_picture() {
  job::Picture picture;
  picture.width = 3;
  picture.height = 2;
  picture.rgb.assign(18, 0.5f);
  return picture;
}

/// Of a page, in millimetres, which are the drawing's units, too.
glm::dvec2 sheet_of(const std::string& page) {
  std::smatch found;
  if (!std::regex_search(
          page, found, std::regex("width=\"([0-9.]+)mm\" height=\"([0-9.]+)mm\" viewBox=\"0 0 ([0-9.]+) ([0-9.]+)\"")))
    return glm::dvec2(0);
  EXPECT_EQ(found[1], found[3]);
  EXPECT_EQ(found[2], found[4]);
  return {std::stod(found[1]), std::stod(found[2])};
}

// Each receiver's picture is as large as the receiver, on the smallest sheet that holds it.
TEST(PrintPages, AreInRealSizeOnSheetsThatPrintersHave) {
  Layout layout{.size = {70, 40}, .receiver = {120, 90}, .cells = {3, 2}, .distances = {55, 88}};
  const std::string object = object_page(layout, "a & b"), second = receiver_page(layout, 1, grey_picture(), "a & b");
  EXPECT_EQ(sheet_of(object), glm::dvec2(210, 297));
  EXPECT_EQ(sheet_of(second), glm::dvec2(210, 297));
  EXPECT_THAT(object, AllOf(HasSubstr("width=\"70\" height=\"40\""), HasSubstr("a &amp; b")));
  EXPECT_THAT(second, HasSubstr("88 mm from the facets"));
  EXPECT_TRUE(std::regex_search(second, std::regex("<image [^>]*width=\"120\" height=\"90\"")));
  for (const auto& [receiver, sheet] :
       std::map<double, glm::dvec2>{{260, {297, 210}}, {274, {420, 297}}, {2000, {2024, 138}}}) {
    layout.receiver = {receiver, 90};
    EXPECT_EQ(sheet_of(receiver_page(layout, 0, grey_picture(), "")), sheet) << receiver;
  }
}

/// Two facets with these gradients and heights, 2 mm wide each.
std::pair<Layout, Solid> two_facets(double left, double right, double left_z, double right_z) {
  const Layout layout{.size = {4, 2}, .facets = {2, 1}};
  Solid solid;
  solid.facets = {{{}, {left, 0}, left_z}, {{}, {right, 0}, right_z}};
  return {layout, solid};
}

// A ball of radius r touches both sides of a V, which rise by alpha, at r sin(alpha) from its bottom, and comes no
// nearer.
TEST(Tool, LeavesAFilletInAGroove) {
  for (const double degrees : {10.0, 30.0, 45.0})
    for (const double radius : {0.3, 1.0}) {
      const double alpha = glm::radians(degrees), rise = std::tan(alpha);
      const auto [layout, valley] = two_facets(rise, -rise, -rise, -rise); // z: the tool comes from below
      EXPECT_NEAR(unreached_part(layout, valley, radius), radius * std::sin(alpha) / 2, 0.003)
          << degrees << " " << radius;
      const auto [same, ridge] = two_facets(-rise, rise, rise, rise);
      EXPECT_EQ(unreached_part(same, ridge, radius), 0);
    }
}

// Beside a step of height h a ball stands as far away as it is wide there: sqrt(2 r h - h^2), or r where the step is
// higher than that.
TEST(Tool, StandsBesideAWall) {
  for (const double step : {0.1, 0.4, 3.0}) {
    const auto [layout, solid] = two_facets(0, 0, 0, step);
    const double radius = 0.8, strip = step < radius ? std::sqrt(2 * radius * step - step * step) : radius;
    EXPECT_NEAR(unreached_part(layout, solid, radius), strip / 4, 0.003) << step;
  }
}

// z = -x^2 / (2 R) is a trough for a tool from below, of curvature 1 / R at its bottom; the other way round it is a
// ridge.
TEST(Tool, FindsTheTightestValleyOfALens) {
  const Layout layout{.size = {20, 20}, .facets = {81, 81}};
  const double radius = 40;
  Grid corners(82, 82);
  for (int y = 0; y < 82; ++y)
    for (int x = 0; x < 82; ++x) corners(y, x) = -std::pow(x * 20.0 / 81 - 10, 2) / (2 * radius);
  const Valley valley = tightest_valley(layout, Surface(layout.size, corners));
  EXPECT_NEAR(valley.radius, radius, 0.01);
  EXPECT_NEAR(valley.at.x, 0, 1e-9);
  EXPECT_TRUE(std::isinf(tightest_valley(layout, Surface(layout.size, -corners)).radius));
}

// z = -a cos(x) is tightest at x = 0, where the radius is 1 / a: a facet's corner, between the middles of two facets.
TEST(Tool, LooksAtFacetsCornersToo) {
  const Layout layout{.size = {8, 8}, .facets = {8, 8}};
  Grid corners(9, 9);
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 9; ++x) corners(y, x) = 0.2 * std::cos(x - 4.0);
  const Surface surface(layout.size, corners);
  const Valley valley = tightest_valley(layout, surface);
  EXPECT_NEAR(valley.at.x, 0, 1e-3);
  EXPECT_NEAR(valley.radius, -1 / surface.at({0, valley.at.y}).curvature[0][0], 1e-6);
  EXPECT_LT(valley.radius, -1 / surface.at({0.5, valley.at.y}).curvature[0][0] * 0.95) << "a facet's middle";
}

TEST(Workshop, SaysHowItsFilesDiffer) {
  const Layout layout = drafted(test::small(9, 7), 5);
  const Solid solid = make_solid(layout, test::random_slopes(layout, 0.1, 4));
  const std::string page = workshop_page(layout, solid, "glass");
  EXPECT_THAT(page, AllOf(HasSubstr("the mesh has the draft"), HasSubstr("a line a facet, as if walls stood upright"),
                          HasSubstr("of the sheet that holds it")));
  EXPECT_THAT(workshop_page(test::small(9, 7), solid, "glass"), Not(HasSubstr("draft")));
}

TEST(Workshop, SaysWhatToolAndPrinterLeave) {
  const Layout layout = test::small(9, 7);
  const Solid solid = make_solid(layout, test::random_slopes(layout, 0.3, 4));
  const std::string page = workshop_page(layout, solid, "glass", {0.2, solid.relief() / 12.5});
  EXPECT_THAT(page, AllOf(HasSubstr("| a ball of 0.2 mm radius | cannot touch "), HasSubstr(" | 13 in the relief.")));
  EXPECT_THAT(workshop_page(layout, solid, "glass"), Not(HasSubstr("a ball of")));
}

/// No two overlap or are nearer than the gap, and none is beside the plate.
void expect_apart(const glm::dvec2& plate, double gap, const std::vector<PlatePart>& bodies) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const glm::dvec2 rim = plate / 2.0 - glm::abs(bodies[i].middle) - bodies[i].size / 2.0;
    EXPECT_GE(std::min(rim.x, rim.y), gap - 1e-6);
    for (std::size_t j = 0; j < i; ++j) {
      const glm::dvec2 between =
          glm::abs(bodies[i].middle - bodies[j].middle) - (bodies[i].size + bodies[j].size) / 2.0;
      EXPECT_GE(std::max(between.x, between.y), gap - 1e-6) << i << " " << j;
    }
  }
}

TEST(Plate, KeepsObjectsApart) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> side(10, 60);
  std::vector<PlatePart> bodies(24);
  for (PlatePart& body : bodies) body.size = {side(random), side(random)};
  const glm::dvec2 plate(300, 330);
  ASSERT_FALSE(put_on_shelves(plate, 4, bodies));
  expect_apart(plate, 4, bodies);
}

// Three of 46 mm with gaps of 4 mm fill a row of 154 mm exactly.
TEST(Plate, IsFilledToItsRimAndNoFurther) {
  std::vector<PlatePart> bodies(6, {"", {46, 46}, {}});
  EXPECT_FALSE(put_on_shelves({154, 104}, 4, bodies));
  EXPECT_EQ(put_on_shelves({153.9, 104}, 4, bodies), 4u);
  EXPECT_EQ(put_on_shelves({154, 103.9}, 4, bodies), 3u);
  bodies[2].size.x = 200;
  EXPECT_EQ(put_on_shelves({154, 1000}, 4, bodies), 2u);
}

TEST(Plate, IsAsManyClosedBodies) {
  const Layout layout = test::small(9, 7);
  const scene::Mesh mesh = make_solid(layout, test::random_slopes(layout, 0.3, 4)).mesh;
  std::vector<PlatePart> bodies(3, {"", layout.size, {}});
  ASSERT_FALSE(put_on_shelves({30, 30}, 1, bodies));
  const scene::Mesh plate = plate_mesh({mesh, mesh, mesh}, bodies);
  const scene::MeshReport report = scene::inspect(plate), one = scene::inspect(mesh);
  EXPECT_TRUE(report.closed());
  EXPECT_NEAR(report.signed_volume, 3 * one.signed_volume, 1e-3 * one.signed_volume);
  EXPECT_EQ(test::bodies(plate), 3u);
}

} // namespace nephroid::workshop_test
