// SPDX-License-Identifier: Apache-2.0
// The object is one closed solid, whatever its facets are, and its files say so to an independent reader (Assimp, behind load_mesh).
#include "base/files.h"
#include "inverse/bending.h"
#include "inverse/facets/solid.h"
#include "scene/mesh.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <random>

namespace {

using namespace nephroid;
using inverse::Layout;
using inverse::Part;
using inverse::Solid;

Layout small(int columns, int rows)
{
  Layout layout;
  layout.size = {7, 5};
  layout.thickness = 3;
  layout.facets = {columns, rows};
  return layout;
}

std::vector<glm::dvec2> random_slopes(const Layout& layout, double most, int seed)
{
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  std::uniform_real_distribution<double> uniform(-most, most);
  std::vector<glm::dvec2> slopes(layout.facet_count());
  for (glm::dvec2& s : slopes) s = {uniform(random), uniform(random)};
  return slopes;
}

using Vertices = std::array<float, 3>;
Vertices at(const scene::Mesh& mesh, std::uint32_t id) { return {mesh.positions[id].x, mesh.positions[id].y, mesh.positions[id].z}; }

/// Pieces that hang together by edges; vertices at one place are one.
std::size_t bodies(const scene::Mesh& mesh)
{
  std::map<std::pair<Vertices, Vertices>, std::size_t> edges;
  std::vector<std::size_t> parent(mesh.triangles.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t t) {
    while (parent[t] != t) t = parent[t] = parent[parent[t]];
    return t;
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      auto edge = std::minmax(at(mesh, mesh.triangles[t][i]), at(mesh, mesh.triangles[t][(i + 1) % 3]));
      const auto [known, added] = edges.try_emplace({edge.first, edge.second}, t);
      if (!added) parent[root(t)] = root(known->second);
    }
  std::size_t count = 0;
  for (std::size_t t = 0; t < parent.size(); ++t) count += root(t) == t;
  return count;
}

/// Facets are planes through their middles at z = 0, so every prism under them has the slab's volume.
void expect_sound(const Layout& layout, const scene::Mesh& mesh)
{
  const scene::MeshReport report = scene::inspect(mesh);
  EXPECT_EQ(report.open_edges, 0u);
  EXPECT_EQ(report.crowded_edges, 0u);
  EXPECT_EQ(report.degenerate, 0u);
  EXPECT_EQ(report.duplicated, 0u);
  const double slab = layout.size.x * layout.size.y * layout.thickness;
  EXPECT_NEAR(report.signed_volume / slab, 1, 1e-5); // outwards, too
  EXPECT_EQ(bodies(mesh), 1u);
}

TEST(Solid, IsClosedWithAnySlopes)
{
  for (int seed = 0; seed < 12; ++seed) {
    const Layout layout = small(23, 17);
    expect_sound(layout, make_solid(layout, random_slopes(layout, 0.7, seed)).mesh);
  }
}

// Equal heights at a corner, equal edges, and two high facets across from two low ones.
TEST(Solid, IsClosedWhereHeightsTie)
{
  const Layout layout = small(8, 8);
  std::mt19937_64 random(3);
  for (int round = 0; round < 40; ++round) {
    std::vector<glm::dvec2> slopes(layout.facet_count());
    for (glm::dvec2& s : slopes) s = 0.2 * glm::dvec2(static_cast<int>(random() % 3) - 1, static_cast<int>(random() % 3) - 1);
    expect_sound(layout, make_solid(layout, slopes).mesh);
  }
}

TEST(Solid, IsClosedWhereHeightsNearlyTie)
{
  const Layout layout = small(12, 12);
  for (int seed = 0; seed < 8; ++seed) {
    std::vector<glm::dvec2> slopes = random_slopes(layout, 1e-7 * std::pow(10, seed), seed);
    for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] += 0.1 * glm::dvec2(i % 2, i % 3);
    expect_sound(layout, make_solid(layout, slopes).mesh);
  }
}

TEST(Solid, OfOneFacetOrOneRow)
{
  for (const glm::ivec2& facets : {glm::ivec2(1, 1), glm::ivec2(1, 9), glm::ivec2(9, 1), glm::ivec2(2, 2)}) {
    const Layout layout = small(facets.x, facets.y);
    expect_sound(layout, make_solid(layout, random_slopes(layout, 0.3, 1)).mesh);
  }
}

TEST(Solid, FacetsHaveTheirNormals)
{
  const Layout layout = small(9, 7);
  const std::vector<glm::dvec2> slopes = random_slopes(layout, 0.6, 5);
  const Solid solid = make_solid(layout, slopes);
  ASSERT_EQ(solid.parts.size(), solid.mesh.triangles.size());
  std::size_t facets = 0;
  for (std::size_t t = 0; t < solid.parts.size(); ++t) {
    const glm::uvec3 corners = solid.mesh.triangles[t];
    const glm::dvec3 a = solid.mesh.positions[corners.x], b = solid.mesh.positions[corners.y], c = solid.mesh.positions[corners.z];
    const glm::dvec3 cross = glm::cross(b - a, c - a), middle = (a + b + c) / 3.0;
    const Part part = solid.parts[t];
    if (part == Part::front) {
      EXPECT_GT(cross.z, 0.9999 * glm::length(cross));
    } else if (part != Part::facet) {
      EXPECT_LT(std::abs(cross.z), 1e-5 * glm::length(cross));
    }
    if (part != Part::facet) continue;
    ++facets;
    const glm::dvec2 cell = (glm::dvec2(middle.x, -middle.y) + layout.size / 2.0) / layout.facet();
    const std::size_t facet = static_cast<std::size_t>(cell.y) * 9 + static_cast<std::size_t>(cell.x);
    const glm::dvec3 normal = *inverse::facet_normal({0, 0, -1}, inverse::direction_of(slopes[facet]), layout.n);
    EXPECT_GT(glm::dot(glm::normalize(cross), normal), 1 - 1e-6) << t;
  }
  EXPECT_GE(facets, 4u * 63);
}

TEST(Solid, FilesAreReadByOthers)
{
  const test::TemporaryFolder folder;
  const Layout layout = small(15, 11);
  const Solid solid = make_solid(layout, random_slopes(layout, 0.5, 2));
  write_file_whole(folder.path() / "object.obj", inverse::to_obj(solid.mesh));
  write_file_whole(folder.path() / "object.stl", inverse::to_stl(solid.mesh));
  for (const char* file : {"object.obj", "object.stl"}) {
    const scene::Mesh mesh = scene::load_mesh(folder.path() / file);
    EXPECT_EQ(mesh.triangles.size(), solid.mesh.triangles.size());
    expect_sound(layout, mesh);
  }
}

} // namespace
