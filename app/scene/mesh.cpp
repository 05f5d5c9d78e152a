// SPDX-License-Identifier: Apache-2.0
// Checks and repairs of triangle meshes; ellipsoids. All sums are in double: positions are floats, so products of two
// of their differences are exact or nearly so.
#include "scene/mesh.h"

#include "base/parallel.h"
#include "base/recent.h"
#include "scene/mesh_parts.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

namespace nephroid::scene {
namespace {

using VertexKey = std::array<std::uint32_t, 6>; ///< bits of the position and the normal

/// -0 becomes 0.
VertexKey vertex_key(const Mesh& mesh, std::uint32_t vertex, bool with_normal) {
  VertexKey key{};
  for (int axis = 0; axis < 3; ++axis) {
    key[axis] = std::bit_cast<std::uint32_t>(mesh.positions[vertex][axis] + 0.0f);
    if (with_normal) key[3 + axis] = std::bit_cast<std::uint32_t>(mesh.normals[vertex][axis] + 0.0f);
  }
  return key;
}

std::array<glm::dvec3, 3> corners(const Mesh& mesh, const glm::uvec3& triangle) {
  return {mesh.positions[triangle.x], mesh.positions[triangle.y], mesh.positions[triangle.z]};
}

/// The triangle's joined corners, turned so that the lowest comes first: equal for triangles that face the same way.
std::array<std::uint32_t, 3> canonical(const glm::uvec3& triangle, const std::vector<std::uint32_t>& joined) {
  std::array<std::uint32_t, 3> key{joined[triangle.x], joined[triangle.y], joined[triangle.z]};
  std::rotate(key.begin(), std::min_element(key.begin(), key.end()), key.end());
  return key;
}

/// True for each triangle that equals an earlier one.
std::vector<char> find_duplicates(const Mesh& mesh, const std::vector<std::uint32_t>& joined) {
  struct Entry {
    std::array<std::uint32_t, 3> key;
    std::uint32_t triangle;
    auto operator<=>(const Entry&) const = default;
  };
  std::vector<Entry> entries(mesh.triangles.size());
  for (std::uint32_t i = 0; i < entries.size(); ++i) entries[i] = {canonical(mesh.triangles[i], joined), i};
  std::sort(entries.begin(), entries.end());
  std::vector<char> duplicate(entries.size(), 0);
  for (std::size_t i = 1; i < entries.size(); ++i)
    if (entries[i].key == entries[i - 1].key) duplicate[entries[i].triangle] = 1;
  return duplicate;
}

/// Every directed edge as low << 33 | high << 1 | (runs from high to low): sorted, the uses of an edge lie side by
/// side. Joined indices stay below 2^31 because max_triangles does. A triangle with two equal corners closes nothing
/// and is left out; a sliver with three different ones does close the surface between its neighbours.
std::vector<std::uint64_t> directed_edges(const Mesh& mesh, const std::vector<std::uint32_t>& joined,
                                          const std::vector<char>& duplicate) {
  std::vector<std::uint64_t> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto corner = canonical(mesh.triangles[i], joined);
    if (duplicate[i] || corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0]) continue;
    for (std::size_t side = 0; side < 3; ++side) {
      const std::uint64_t from = corner[side], to = corner[(side + 1) % 3];
      edges.push_back(std::min(from, to) << 33 | std::max(from, to) << 1 | (from > to ? 1 : 0));
    }
  }
  std::sort(edges.begin(), edges.end());
  return edges;
}

void count_edges(const std::vector<std::uint64_t>& edges, MeshReport& report) {
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end] >> 1 == edges[begin] >> 1) ++end;
    if (end - begin == 1)
      ++report.open_edges;
    else if (end - begin > 2 || edges[begin] == edges[begin + 1])
      ++report.crowded_edges;
  }
}

/// What of a mesh stays while its vertices move and none of them come to lie in one place.
struct Topology {
  std::vector<glm::uvec3> triangles;
  std::vector<std::uint32_t> joined; ///< first_equal_vertex
  std::vector<char> duplicate;       ///< find_duplicates
  MeshReport report;                 ///< what of it depends on nothing else
};

/// The last ones are kept: sorting is most of the work, and the frames of an animation have the same one.
std::shared_ptr<const Topology> topology_of(const Mesh& mesh) {
  static Recent<Topology> recent(std::uint64_t{64} << 20);
  std::vector<std::uint32_t> joined = first_equal_vertex(mesh, false);
  if (auto same =
          recent.find([&](const Topology& kept) { return kept.joined == joined && kept.triangles == mesh.triangles; }))
    return same;
  Topology topology{mesh.triangles, std::move(joined), {}, {}};
  topology.duplicate = find_duplicates(mesh, topology.joined);
  topology.report.duplicated = static_cast<std::uint32_t>(std::ranges::count(topology.duplicate, 1));
  count_edges(directed_edges(mesh, topology.joined, topology.duplicate), topology.report);
  const std::uint64_t bytes = mesh.triangles.size() * (sizeof(glm::uvec3) + 1) + mesh.positions.size() * 4;
  return recent.add(std::move(topology), bytes);
}

/// Six times the tetrahedron's volume; summed over a closed surface it does not depend on `apex`, but its rounding
/// does.
double six_volumes(const Mesh& mesh, const glm::uvec3& triangle, const glm::dvec3& apex) {
  const auto [a, b, c] = corners(mesh, triangle);
  return glm::dot(a - apex, glm::cross(b - apex, c - apex));
}

std::array<double, 3> lengths(const Ellipsoid& ellipsoid) {
  std::array<double, 3> result{};
  for (std::size_t i = 0; i < 3; ++i) result[i] = glm::length(glm::dvec3(ellipsoid.half_axes[i]));
  return result;
}

glm::dvec3 on_unit_sphere(const Ellipsoid& ellipsoid, const glm::dvec3& point) {
  const auto rows = to_unit_sphere(ellipsoid);
  const glm::dvec3 way = point - glm::dvec3(ellipsoid.centre);
  return {glm::dot(rows[0], way), glm::dot(rows[1], way), glm::dot(rows[2], way)};
}

} // namespace

bool is_within_reach(const glm::vec3& place) {
  constexpr float farthest = 0x1p60f;
  return std::abs(place.x) <= farthest && std::abs(place.y) <= farthest && std::abs(place.z) <= farthest;
}

bool is_degenerate(const Mesh& mesh, const glm::uvec3& triangle) {
  const auto [a, b, c] = corners(mesh, triangle);
  const double longest = std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
  return !(glm::length(glm::cross(b - a, c - a)) > 0x1p-24 * longest * longest);
}

std::vector<std::uint32_t> first_equal_vertex(const Mesh& mesh, bool compare_normals) {
  const bool with_normals = compare_normals && !mesh.normals.empty();
  // A table with open places: a third of the time of std::unordered_map.
  constexpr std::uint32_t free = ~0u;
  std::vector<std::uint32_t> table(std::bit_ceil(2 * mesh.positions.size() + 1), free);
  std::vector<std::uint32_t> result(mesh.positions.size());
  for (std::uint32_t i = 0; i < result.size(); ++i) {
    const VertexKey key = vertex_key(mesh, i, with_normals);
    std::uint64_t hash = 0;
    for (const std::uint32_t word : key) {
      hash = (hash ^ word) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 32;
    }
    std::size_t place = hash & (table.size() - 1);
    while (table[place] != free && vertex_key(mesh, table[place], with_normals) != key)
      place = (place + 1) & (table.size() - 1);
    if (table[place] == free) table[place] = i;
    result[i] = table[place];
  }
  return result;
}

std::vector<glm::vec3> mean_normals(const Mesh& mesh, const std::vector<std::uint32_t>& same) {
  std::vector<glm::dvec3> sums(mesh.positions.size());
  for (const glm::uvec3& triangle : mesh.triangles) {
    if (is_degenerate(mesh, triangle)) continue;
    const auto corner = corners(mesh, triangle);
    const glm::dvec3 normal = glm::normalize(glm::cross(corner[1] - corner[0], corner[2] - corner[0]));
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 u = corner[(i + 1) % 3] - corner[i], v = corner[(i + 2) % 3] - corner[i];
      sums[same[triangle[i]]] += std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v)) * normal;
    }
  }
  std::vector<glm::vec3> means(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double length = glm::length(sums[same[i]]);
    if (length > 1e-9)
      means[i] = glm::vec3(sums[same[i]] / length); // shorter: triangles back to back, with no mean direction
  }
  return means;
}

bool has_area(const Mesh& mesh) {
  return std::ranges::any_of(mesh.triangles,
                             [&](const glm::uvec3& triangle) { return !is_degenerate(mesh, triangle); });
}

MeshReport inspect(const Mesh& mesh) {
  const std::shared_ptr<const Topology> topology = topology_of(mesh);
  MeshReport report = topology->report;
  struct Sum {
    std::uint32_t degenerate = 0;
    double six_volumes = 0;
  };
  constexpr std::size_t block_size = 1 << 14;
  std::vector<Sum> sums(mesh.triangles.size() / block_size + 1);
  for_ranges(mesh.triangles.size(), block_size, [&](std::size_t block, Range range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      if (topology->duplicate[i]) continue;
      sums[block].degenerate += is_degenerate(mesh, mesh.triangles[i]);
      sums[block].six_volumes += six_volumes(mesh, mesh.triangles[i], mesh.positions[mesh.triangles[0].x]);
    }
  });
  for (const Sum& sum : sums) {
    report.degenerate += sum.degenerate;
    report.signed_volume += sum.six_volumes / 6;
  }
  return report;
}

void drop_useless(Mesh& mesh) {
  const std::shared_ptr<const Topology> topology = topology_of(mesh);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (topology->duplicate[i] || is_degenerate(mesh, mesh.triangles[i])) continue;
    if (!mesh.texcoords.empty()) mesh.texcoords[kept] = mesh.texcoords[i];
    mesh.triangles[kept++] = mesh.triangles[i];
  }
  mesh.triangles.resize(kept);
  if (!mesh.texcoords.empty()) mesh.texcoords.resize(kept);
  std::vector<std::uint32_t> same(mesh.positions.size());
  std::iota(same.begin(), same.end(), 0);
  keep_used_vertices(mesh, same);
}

void keep_used_vertices(Mesh& mesh, const std::vector<std::uint32_t>& same) {
  constexpr std::uint32_t unused = ~0u;
  std::vector<std::uint32_t> new_index(mesh.positions.size(), unused);
  const std::vector<glm::vec3> positions = std::exchange(mesh.positions, {}), normals = std::exchange(mesh.normals, {});
  for (glm::uvec3& triangle : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t old = same[triangle[i]];
      if (new_index[old] == unused) {
        new_index[old] = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(positions[old]);
        if (!normals.empty()) mesh.normals.push_back(normals[old]);
      }
      triangle[i] = new_index[old];
    }
}

void turn_triangles(Mesh& mesh) {
  for (glm::uvec3& triangle : mesh.triangles) std::swap(triangle.y, triangle.z);
  for (Texcoords& texcoords : mesh.texcoords) std::swap(texcoords[1], texcoords[2]);
}

void turn_round(Mesh& mesh) {
  turn_triangles(mesh);
  for (glm::vec3& normal : mesh.normals) normal = -normal;
  for (Ellipsoid& ellipsoid : mesh.ellipsoids) ellipsoid.inwards = !ellipsoid.inwards;
}

namespace {

/// Gives the corners on either side of a sharp edge vertices of their own. Corners are numbered triangle by triangle.
void split_at_creases(Mesh& mesh, double crease_deg) {
  const std::vector<std::uint32_t> joined = first_equal_vertex(mesh, false);
  const auto count = static_cast<std::uint32_t>(3 * mesh.triangles.size());
  const auto vertex = [&](std::uint32_t corner) {
    return joined[mesh.triangles[corner / 3][static_cast<int>(corner % 3)]];
  };
  const auto next = [](std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; };
  const auto normal = [&](std::uint32_t corner) {
    const auto [a, b, c] = corners(mesh, mesh.triangles[corner / 3]);
    return glm::normalize(glm::cross(b - a, c - a));
  };
  // The corners that share a vertex without a sharp edge between them: each leads towards the first of them.
  std::vector<std::uint32_t> before(count), edges(count);
  std::iota(before.begin(), before.end(), 0);
  std::iota(edges.begin(), edges.end(), 0); // an edge is the corner that it begins at
  const auto first_of = [&](std::uint32_t corner) {
    while (before[corner] != corner) corner = before[corner] = before[before[corner]];
    return corner;
  };
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    a = first_of(a), b = first_of(b);
    before[std::max(a, b)] = std::min(a, b);
  };
  const auto ends = [&](std::uint32_t edge) { return std::minmax({vertex(edge), vertex(next(edge))}); };
  std::ranges::sort(edges, {}, [&](std::uint32_t edge) { return std::pair(ends(edge), edge); });
  const double sharp = std::cos(glm::radians(crease_deg));
  for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
    while (end < edges.size() && ends(edges[end]) == ends(edges[i])) ++end;
    if (end - i != 2) continue;
    const std::uint32_t a = edges[i], b = edges[i + 1];
    if (vertex(a) != vertex(next(b)) || glm::dot(normal(a), normal(b)) < sharp) continue;
    join(a, next(b));
    join(next(a), b);
  }
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> number(count);
  std::vector<glm::uvec3> triangles(mesh.triangles.size());
  for (std::uint32_t corner = 0; corner < count; ++corner) {
    if (first_of(corner) == corner) {
      number[corner] = static_cast<std::uint32_t>(positions.size());
      positions.push_back(mesh.positions[vertex(corner)]);
    }
    triangles[corner / 3][static_cast<int>(corner % 3)] = number[first_of(corner)];
  }
  mesh.positions = std::move(positions);
  mesh.triangles = std::move(triangles);
}

} // namespace

void compute_smooth_normals(Mesh& mesh, double crease_deg) {
  std::vector<std::uint32_t> joined;
  if (crease_deg < 180) {
    split_at_creases(mesh, crease_deg);
    joined.resize(mesh.positions.size());
    std::iota(joined.begin(), joined.end(), 0);
  } else
    joined = first_equal_vertex(mesh, false);
  mesh.normals = mean_normals(mesh, joined);
  // Where the mean has no direction (a sheet with two sides) each vertex takes a normal of its own triangles; a vertex
  // without any triangle gets +y, so that every normal is a unit vector.
  for (const glm::uvec3& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      glm::vec3& normal = mesh.normals[triangle[i]];
      if (normal != glm::vec3(0) || is_degenerate(mesh, triangle)) continue;
      const auto [a, b, c] = corners(mesh, triangle);
      normal = glm::vec3(glm::normalize(glm::cross(b - a, c - a)));
    }
  }
  for (glm::vec3& normal : mesh.normals)
    if (normal == glm::vec3(0)) normal = {0, 1, 0};
}

double winding_number(const Mesh& mesh, std::uint32_t first_triangle, std::uint32_t count, const glm::dvec3& p) {
  double half_solid_angles = 0;
  for (std::uint32_t i = first_triangle; i < first_triangle + count; ++i) {
    auto [a, b, c] = corners(mesh, mesh.triangles[i]);
    a -= p, b -= p, c -= p;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    // tan(omega / 2) = a . (b x c) / (|a||b||c| + (a.b)|c| + (b.c)|a| + (c.a)|b|)
    const double denominator = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    half_solid_angles += std::atan2(glm::dot(a, glm::cross(b, c)), denominator);
  }
  return half_solid_angles / (2 * std::numbers::pi);
}

double signed_volume(const Mesh& mesh, std::uint32_t first_triangle, std::uint32_t count) {
  double sum = 0;
  for (std::uint32_t i = first_triangle; i < first_triangle + count; ++i)
    sum += six_volumes(mesh, mesh.triangles[i], mesh.positions[mesh.triangles[first_triangle].x]);
  return sum / 6;
}

std::array<glm::dvec3, 3> to_unit_sphere(const Ellipsoid& ellipsoid) {
  std::array<glm::dvec3, 3> rows{};
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec3 axis = ellipsoid.half_axes[i];
    rows[i] = axis / glm::dot(axis, axis);
  }
  return rows;
}

bool contains(const Ellipsoid& ellipsoid, const glm::dvec3& point) {
  return glm::length(on_unit_sphere(ellipsoid, point)) < 1;
}

glm::dvec3 half_extent(const Ellipsoid& ellipsoid) {
  // The support function: the largest coordinate of sum of u_i a_i over unit vectors u is the length of the a_i's
  // coordinates.
  glm::dvec3 squares(0);
  for (const glm::dvec3 axis : ellipsoid.half_axes) squares += axis * axis;
  return glm::sqrt(squares);
}

double longest_half_axis(const Ellipsoid& ellipsoid) { return std::ranges::max(lengths(ellipsoid)); }
double shortest_half_axis(const Ellipsoid& ellipsoid) { return std::ranges::min(lengths(ellipsoid)); }

double volume_of(const Ellipsoid& ellipsoid) {
  const auto [a, b, c] = lengths(ellipsoid);
  return 4 * std::numbers::pi / 3 * a * b * c;
}

// The gradient of |M (p - c)|^2 is 2 M^T M (p - c).
glm::dvec3 normal_at(const Ellipsoid& ellipsoid, const glm::dvec3& point) {
  const auto rows = to_unit_sphere(ellipsoid);
  const glm::dvec3 unit = on_unit_sphere(ellipsoid, point);
  const glm::dvec3 outwards = glm::normalize(unit.x * rows[0] + unit.y * rows[1] + unit.z * rows[2]);
  return ellipsoid.inwards ? -outwards : outwards;
}

std::vector<glm::vec3> extreme_points(const Mesh& mesh) {
  std::vector<glm::vec3> points = mesh.positions;
  for (const Ellipsoid& ellipsoid : mesh.ellipsoids)
    for (const float side : {-1.0f, 1.0f})
      points.push_back(ellipsoid.centre + side * glm::vec3(half_extent(ellipsoid)));
  return points;
}

Sphere enclosing_sphere(const Mesh& mesh, std::span<const glm::uvec3> triangles,
                        std::span<const Ellipsoid> ellipsoids) {
  glm::vec3 low(std::numeric_limits<float>::max()), high(-std::numeric_limits<float>::max());
  constexpr std::size_t block_size = 1 << 14;
  std::vector<std::array<glm::vec3, 2>> boxes(triangles.size() / block_size + 1, {low, high});
  for_ranges(triangles.size(), block_size, [&](std::size_t block, Range range) {
    auto& [least, most] = boxes[block];
    for (const glm::uvec3& triangle : triangles.subspan(range.begin, range.end - range.begin))
      for (int i = 0; i < 3; ++i) {
        least = glm::min(least, mesh.positions[triangle[i]]);
        most = glm::max(most, mesh.positions[triangle[i]]);
      }
  });
  for (const auto& [least, most] : boxes) low = glm::min(low, least), high = glm::max(high, most);
  for (const Ellipsoid& ellipsoid : ellipsoids) {
    const glm::vec3 half(half_extent(ellipsoid));
    low = glm::min(low, ellipsoid.centre - half);
    high = glm::max(high, ellipsoid.centre + half);
  }
  Sphere sphere{0.5f * low + 0.5f * high, 0};
  std::vector<double> squares(boxes.size());
  for_ranges(triangles.size(), block_size, [&](std::size_t block, Range range) {
    for (const glm::uvec3& triangle : triangles.subspan(range.begin, range.end - range.begin))
      for (int i = 0; i < 3; ++i) {
        const glm::dvec3 way = glm::dvec3(mesh.positions[triangle[i]]) - glm::dvec3(sphere.centre);
        squares[block] = std::max(squares[block], glm::dot(way, way));
      }
  });
  double radius = std::sqrt(std::ranges::max(squares));
  for (const Ellipsoid& ellipsoid : ellipsoids)
    radius = std::max(radius, glm::distance(glm::dvec3(ellipsoid.centre), glm::dvec3(sphere.centre)) +
                                  longest_half_axis(ellipsoid));
  sphere.radius = std::nextafter(static_cast<float>(radius), std::numeric_limits<float>::max());
  return sphere;
}

} // namespace nephroid::scene
