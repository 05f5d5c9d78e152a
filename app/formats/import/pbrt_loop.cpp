// SPDX-License-Identifier: Apache-2.0
// Loop's subdivision surfaces (C. Loop, Smooth Subdivision Surfaces Based on Triangles, 1987), with the rules of Hoppe
// et al. (Piecewise Smooth Surface Reconstruction, 1994) at the rim.
#include "formats/import/pbrt_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::formats {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

Edge edge_of(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

struct Neighbours {
  std::set<std::uint32_t> all, on_rim; ///< on_rim: along edges with one triangle
};

/// The corners opposite to each edge.
std::map<Edge, std::vector<std::uint32_t>> opposites_of(const scene::Mesh& mesh) {
  std::map<Edge, std::vector<std::uint32_t>> opposites;
  for (const glm::uvec3& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) opposites[edge_of(t[i], t[(i + 1) % 3])].push_back(t[(i + 2) % 3]);
  return opposites;
}

std::vector<Neighbours> neighbours_of(const std::map<Edge, std::vector<std::uint32_t>>& opposites, std::size_t count) {
  std::vector<Neighbours> neighbours(count);
  for (const auto& [edge, corners] : opposites)
    for (const auto& [a, b] : {edge, Edge(edge.second, edge.first)}) {
      neighbours[a].all.insert(b);
      if (corners.size() == 1) neighbours[a].on_rim.insert(b);
    }
  return neighbours;
}

glm::dvec3 sum_of(const std::vector<glm::dvec3>& positions, const std::set<std::uint32_t>& vertices) {
  glm::dvec3 sum(0);
  for (const std::uint32_t v : vertices) sum += positions[v];
  return sum;
}

/// Loop's weight of each of n neighbours.
double beta(std::size_t n) {
  if (n == 3) return 3.0 / 16;
  const double x = 3.0 / 8 + std::cos(2 * std::numbers::pi / static_cast<double>(n)) / 4;
  return (5.0 / 8 - x * x) / static_cast<double>(n);
}

/// Each vertex with `inner` of every neighbour, and with `rim` of the two along the rim.
template <class Weight>
std::vector<glm::dvec3> averaged(const std::vector<glm::dvec3>& from, const std::vector<Neighbours>& neighbours,
                                 const Weight& inner, double rim) {
  std::vector<glm::dvec3> to = from;
  for (std::size_t v = 0; v < from.size(); ++v) {
    const auto& [all, on_rim] = neighbours[v];
    if (all.empty()) continue;
    const bool border = !on_rim.empty();
    const double weight = border ? rim : inner(all.size());
    const auto count = static_cast<double>(border ? on_rim.size() : all.size());
    to[v] = (1 - count * weight) * from[v] + weight * sum_of(from, border ? on_rim : all);
  }
  return to;
}

} // namespace

scene::Mesh subdivided(const scene::Mesh& mesh, int levels) {
  scene::Mesh result;
  result.triangles = mesh.triangles;
  std::vector<glm::dvec3> positions(mesh.positions.begin(), mesh.positions.end());
  for (int level = 0; level < levels; ++level) {
    const auto opposites = opposites_of(result);
    std::vector<glm::dvec3> next = averaged(positions, neighbours_of(opposites, positions.size()), beta, 1.0 / 8);
    std::map<Edge, std::uint32_t> middles;
    for (const auto& [edge, corners] : opposites) {
      const glm::dvec3 ends = positions[edge.first] + positions[edge.second];
      middles[edge] = static_cast<std::uint32_t>(next.size());
      next.push_back(corners.size() == 2 ? 3.0 / 8 * ends + (positions[corners[0]] + positions[corners[1]]) / 8.0
                                         : ends / 2.0);
    }
    std::vector<glm::uvec3> triangles;
    for (const glm::uvec3& t : result.triangles) {
      const std::uint32_t a = middles[edge_of(t.x, t.y)], b = middles[edge_of(t.y, t.z)],
                          c = middles[edge_of(t.z, t.x)];
      for (const glm::uvec3& part :
           {glm::uvec3(t.x, a, c), glm::uvec3(a, t.y, b), glm::uvec3(c, b, t.z), glm::uvec3(a, b, c)})
        triangles.push_back(part);
    }
    result.triangles = std::move(triangles);
    positions = std::move(next);
  }
  const auto limit = [](std::size_t n) { return 1 / (static_cast<double>(n) + 3 / (8 * beta(n))); };
  positions = averaged(positions, neighbours_of(opposites_of(result), positions.size()), limit, 1.0 / 5);
  result.positions.assign(positions.begin(), positions.end());
  scene::compute_smooth_normals(result);
  return result;
}

} // namespace nephroid::formats
