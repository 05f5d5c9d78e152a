// SPDX-License-Identifier: Apache-2.0
// Objects with random facets, and what is asked of every mesh of one.
#pragma once
#include "inverse/facets/solid.h"
#include "tests/support/test.h"

namespace nephroid::test {

using inverse::Layout;

inline Layout small(int columns, int rows) { return {.size = {7, 5}, .thickness = 3, .facets = {columns, rows}}; }

inline std::vector<glm::dvec2> random_slopes(const Layout& layout, double most, int seed) {
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  std::uniform_real_distribution<double> uniform(-most, most);
  std::vector<glm::dvec2> slopes(layout.facet_count());
  for (glm::dvec2& s : slopes) s = {uniform(random), uniform(random)};
  return slopes;
}

using Vertices = std::array<float, 3>;
inline Vertices at(const scene::Mesh& mesh, std::uint32_t id) {
  return {mesh.positions[id].x, mesh.positions[id].y, mesh.positions[id].z};
}

/// Pieces that hang together by edges; vertices at one place are one.
inline std::size_t bodies(const scene::Mesh& mesh) {
  std::map<std::pair<Vertices, Vertices>, std::size_t> edges;
  std::vector<std::size_t> parent(mesh.triangles.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t t) {
    while (parent[t] != t) t = parent[t] = parent[parent[t]];
    return t;
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const auto edge = std::minmax({at(mesh, mesh.triangles[t][i]), at(mesh, mesh.triangles[t][(i + 1) % 3])});
      const auto [known, added] = edges.try_emplace({edge.first, edge.second}, t);
      if (!added) parent[root(t)] = root(known->second);
    }
  std::size_t count = 0;
  for (std::size_t t = 0; t < parent.size(); ++t) count += root(t) == t;
  return count;
}

/// volume: what the mesh encloses.
inline void expect_sound(const scene::Mesh& mesh, double volume) {
  const scene::MeshReport report = scene::inspect(mesh);
  EXPECT_EQ(report.open_edges, 0u);
  EXPECT_EQ(report.crowded_edges, 0u);
  EXPECT_EQ(report.degenerate, 0u);
  EXPECT_EQ(report.duplicated, 0u);
  EXPECT_NEAR(report.signed_volume / volume, 1, 1e-5); // outwards, too
  EXPECT_EQ(bodies(mesh), 1u);
}

/// Facets are planes, so that the prism over each has the volume that its middle's height gives.
inline double volume_of(const Layout& layout, const inverse::Solid& solid) {
  double sum = 0;
  for (const inverse::Facet& f : solid.facets)
    sum += layout.facet().x * layout.facet().y * (layout.thickness - f.height);
  return sum;
}

inline void expect_sound(const Layout& layout, const inverse::Solid& solid) {
  expect_sound(solid.mesh, volume_of(layout, solid));
}

} // namespace nephroid::test
