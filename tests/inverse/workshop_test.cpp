// SPDX-License-Identifier: Apache-2.0
// What a workshop gets: walls that lean, errors of making and what they do, the page to print.
#include "inverse/facets/draft.h"
#include "inverse/facets/files.h"
#include "inverse/print_page.h"
#include "inverse/tolerances.h"
#include "tests/inverse/sound.h"
#include "tests/support/render.h"
#include "tests/support/saved_jobs.h"

#include <regex>

namespace nephroid::workshop_test {

using namespace inverse;
using inverse::Layout;

Layout drafted(Layout layout, double degrees)
{
  layout.draft = std::tan(glm::radians(degrees));
  return layout;
}

void expect_closed(const scene::Mesh& mesh)
{
  const scene::MeshReport report = scene::inspect(mesh);
  EXPECT_EQ(report.open_edges, 0u);
  EXPECT_EQ(report.crowded_edges, 0u);
  EXPECT_EQ(report.degenerate, 0u);
  EXPECT_EQ(report.duplicated, 0u);
  EXPECT_GT(report.signed_volume, 0); // outwards
  EXPECT_EQ(test::bodies(mesh), 1u);
}

glm::dvec3 normal_of(const scene::Mesh& mesh, std::size_t triangle)
{
  const glm::uvec3& t = mesh.triangles[triangle];
  const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
  return glm::normalize(glm::cross(b - a, c - a));
}

// By the mesh itself: no wall is steeper, some are as steep, and facets look where they looked before.
TEST(Draft, WallsLeanAndFacetsStay)
{
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

TEST(Draft, IsClosedWhereHeightsTieAndInOneRow)
{
  for (const glm::ivec2& facets : {glm::ivec2(1, 1), glm::ivec2(1, 9), glm::ivec2(9, 1), glm::ivec2(2, 2), glm::ivec2(8, 8)}) {
    const Layout layout = drafted(test::small(facets.x, facets.y), 5);
    std::vector<glm::dvec2> slopes(layout.facet_count());
    expect_closed(make_solid(layout, slopes).mesh);
    for (std::size_t i = 0; i < slopes.size(); ++i)
      slopes[i] = 0.2 * glm::dvec2(static_cast<double>(i % 3) - 1, static_cast<double>(i / 2 % 3) - 1);
    expect_closed(make_solid(layout, slopes).mesh);
  }
}

// Walls without height are part of the window: both sides let 0.96 through.
TEST(Draft, OfASlabIsAWindow)
{
  const Layout layout = drafted({.facets = {16, 16}, .cells = {8, 8}, .distances = {50}}, 5);
  const Solid solid = make_solid(layout, std::vector<glm::dvec2>(256));
  Judge judge(test::shared_context(), layout, solid, 1);
  while (!judge.finished()) judge.advance();
  EXPECT_NEAR(judge.fates().sent, 0.96 * 0.96, 1e-6);
}

TEST(Draft, AMeshRepairerFindsNothingToRepair)
{
  if (std::system("admesh --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "needs the package admesh";
  const test::TemporaryFolder folder;
  const Layout layout = drafted(test::small(15, 11), 4);
  const Solid solid = make_solid(layout, test::random_slopes(layout, 0.5, 2));
  const auto stl = folder.path() / "object.stl", said = folder.path() / "said";
  write_file_whole(stl, [&](ByteSink& to) { inverse::write_stl(solid.mesh, to); });
  ASSERT_EQ(std::system(("admesh '" + stl.string() + "' > '" + said.string() + "'").c_str()), 0);
  const std::string report = read_file(said);
  for (const char* nothing : {"Total disconnected facets", "Degenerate facets", "Edges fixed", "Facets reversed", "Backwards edges"})
    EXPECT_TRUE(std::regex_search(report, std::regex(nothing + std::string(" *: *0\\b")))) << nothing << "\n" << report;
  EXPECT_TRUE(std::regex_search(report, std::regex("Number of parts *: *1\\b"))) << report;
}

TEST(Tolerances, WavesHaveTheirHeightAndLeaveTheFront)
{
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

std::vector<Tolerances::Row> all_of(Tolerances& tolerances)
{
  while (!tolerances.finished()) tolerances.advance();
  return tolerances.rows();
}

// A slab that is turned or stands farther away stays a window: all cells alike, but the rim by the turn's tan(1 degree) * 50 mm / 3 or so.
// Waves of 20 um and 5 mm bend light by a slope of 0.5 * 2 pi 0.02 / 5 = 0.013: 1.3 mm at 100 mm, a fraction of their length.
TEST(Tolerances, OfASlabAreThoseOfAWindow)
{
  const Layout layout{.facets = {48, 48}, .cells = {20, 20}, .distances = {100}};
  const Solid solid = make_solid(layout, std::vector<glm::dvec2>(layout.facet_count()));
  const std::vector<Target> targets{Target(400, 1.0 / 400)};
  Tolerances tolerances(test::shared_context(), layout, targets, solid, 1);
  const auto rows = all_of(tolerances);
  ASSERT_THAT(rows, SizeIs(5));
  EXPECT_LT(rows[0].costs[0].rel_l2, rows[2].costs[0].rel_l2 / 5); // 1 um
  EXPECT_GT(rows[2].costs[0].rel_l2, 0.05);
  EXPECT_LT(rows[3].costs[0].rel_l2, 0.02);
  EXPECT_LT(rows[4].costs[0].rel_l2, 5e-3); // cells part facets, whose rays are jittered
}

// Cut within the second error.
TEST(Tolerances, GoOnWithTheSameFigures)
{
  const Layout layout{.facets = {24, 24}, .cells = {12, 12}, .distances = {80, 160}};
  const Solid solid = make_solid(layout, test::random_slopes(layout, 0.2, 1));
  const std::vector<Target> targets(2, Target(144, 1.0 / 144));
  Tolerances whole(test::shared_context(), layout, targets, solid, 1), first(test::shared_context(), layout, targets, solid, 1),
      second(test::shared_context(), layout, targets, solid, 1);
  for (int i = 0; i < 17; ++i) first.advance();
  ASSERT_TRUE(test::load<State>(second, test::saved<State>(first)));
  const auto is = all_of(second), expected = all_of(whole);
  ASSERT_EQ(is.size(), expected.size());
  for (std::size_t i = 0; i < is.size(); ++i) {
    EXPECT_EQ(is[i].what, expected[i].what);
    for (const std::size_t j : {0u, 1u}) EXPECT_EQ(is[i].costs[j].rel_l2, expected[i].costs[j].rel_l2);
  }
  EXPECT_THAT(tolerance_csv(is[0].costs, is), StartsWith("error,receiver,cost,rel_l2\nnone,1,"));
  EXPECT_THAT(tolerance_table(is[0].costs, is), HasSubstr("\n| receivers 1 % farther | "));
}

// A unit of the drawing is a millimetre, and each receiver's picture is as large as the receiver.
TEST(PrintPage, IsInRealSize)
{
  const Layout layout{.size = {70, 40}, .receiver = {120, 90}, .cells = {3, 2}, .distances = {55, 88}};
  auto picture = std::make_shared<job::Picture>();
  picture->width = 3;
  picture->height = 2;
  picture->rgb.assign(18, 0.5f);
  const std::string page = print_page(layout, {picture, picture}, "a & b");
  std::smatch found;
  ASSERT_TRUE(
      std::regex_search(page, found, std::regex("width=\"([0-9.]+)mm\" height=\"([0-9.]+)mm\" viewBox=\"0 0 ([0-9.]+) ([0-9.]+)\"")));
  EXPECT_EQ(found[1], found[3]);
  EXPECT_EQ(found[2], found[4]);
  EXPECT_THAT(page, AllOf(HasSubstr("width=\"70\" height=\"40\""), HasSubstr("a &amp; b"), HasSubstr("88 mm from the facets")));
  const std::regex image("<image [^>]*width=\"120\" height=\"90\"");
  EXPECT_EQ(std::distance(std::sregex_iterator(page.begin(), page.end(), image), std::sregex_iterator()), 2);
}

} // namespace nephroid::workshop_test
