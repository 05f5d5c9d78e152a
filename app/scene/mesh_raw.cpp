// SPDX-License-Identifier: Apache-2.0
#include "scene/mesh_raw.h"

#include "base/numbers.h"
#include "scene/mesh_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <unordered_map>

namespace nephroid::scene {
namespace {

/// Where coordinates are this many times the mesh's size, it is moved: single precision would lose more of it than
/// the last bits.
constexpr double farthest_in_sizes = 4;

/// The middle of a mesh far from the origin, which the positions are moved to; else (0, 0, 0).
glm::dvec3 move_to_middle(RawMesh& mesh) {
  glm::dvec3 low(std::numeric_limits<double>::max()), high(-std::numeric_limits<double>::max());
  for (const glm::uvec3& triangle : mesh.triangles)
    for (int i = 0; i < 3; ++i) {
      low = glm::min(low, mesh.positions[triangle[i]]);
      high = glm::max(high, mesh.positions[triangle[i]]);
    }
  const glm::dvec3 size = high - low, reach = glm::max(glm::abs(low), glm::abs(high));
  if (mesh.triangles.empty() ||
      std::max({reach.x, reach.y, reach.z}) <= farthest_in_sizes * std::max({size.x, size.y, size.z}))
    return glm::dvec3(0);
  const glm::vec3 middle(0.5 * low + 0.5 * high); // rounded: differences of a file's floats stay exact
  for (glm::dvec3& p : mesh.positions) p -= glm::dvec3(middle);
  return middle;
}

/// Joins equal vertices and removes those that no triangle uses.
void join_vertices(Mesh& mesh) { keep_used_vertices(mesh, first_equal_vertex(mesh, true)); }

/// A file's normal that is missing, or lies on the other side of the surface than its triangles say, would bend light
/// the wrong way: the mean of the triangles at that vertex takes its place.
void mend_normals(Mesh& mesh) {
  std::vector<std::uint32_t> itself(mesh.positions.size());
  for (std::uint32_t i = 0; i < itself.size(); ++i) itself[i] = i;
  const std::vector<glm::vec3> means = mean_normals(mesh, itself);
  for (std::size_t i = 0; i < means.size(); ++i) {
    if (glm::dot(mesh.normals[i], means[i]) > 0) continue;
    mesh.normals[i] = means[i] == glm::vec3(0) ? glm::vec3(0, 1, 0) : means[i];
    ++mesh.mended_normals;
  }
}

struct Cell {
  std::array<std::int64_t, 3> at;
  bool operator==(const Cell&) const = default;
};

struct CellHash {
  std::size_t operator()(const Cell& cell) const {
    std::uint64_t hash = 0;
    for (const std::int64_t place : cell.at) hash = (hash ^ static_cast<std::uint64_t>(place)) * 0x9e3779b97f4a7c15u;
    return static_cast<std::size_t>(hash ^ hash >> 32);
  }
};

/// For each vertex whether the triangles about it do not close: each has a neighbour before and one after it, which
/// are the same ones all round. Told by sums of numbers that stand for them: 0 by chance is one in 2^64.
std::vector<bool> is_on_rim(const Mesh& mesh, const std::vector<std::uint32_t>& joined) {
  const auto number = [](std::uint64_t vertex) { // the finalizer of SplitMix64 (Steele, Lea and Flood 2014)
    vertex = (vertex + 0x9e3779b97f4a7c15u) * 0xbf58476d1ce4e5b9u;
    vertex = (vertex ^ vertex >> 27) * 0x94d049bb133111ebu;
    return vertex ^ vertex >> 31;
  };
  std::vector<std::uint64_t> sums(mesh.positions.size(), 0);
  for (const glm::uvec3& triangle : mesh.triangles)
    for (int i = 0; i < 3; ++i)
      sums[joined[triangle[i]]] += number(joined[triangle[(i + 1) % 3]]) - number(joined[triangle[(i + 2) % 3]]);
  return {sums.begin(), sums.end()};
}

/// Gives vertices of open edges one position where they differ by the rounding of coordinates: a sphere's seam, whose
/// sin(2 pi) is no 0 but 2e-16, or in single precision 1.7e-7. Whether there was any.
bool close_seams(Mesh& mesh) {
  const std::vector<std::uint32_t> joined = first_equal_vertex(mesh, false);
  const std::vector<bool> is_open = is_on_rim(mesh, joined);
  float reach = 0;
  for (const glm::vec3& p : mesh.positions) reach = std::max({reach, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  const double width = 0x1p-21 * static_cast<double>(reach); // of a cell: eight roundings of the largest coordinate
  std::unordered_map<Cell, std::uint32_t, CellHash> found;
  std::vector<std::uint32_t> same = joined;
  for (std::uint32_t i = 0; i < joined.size(); ++i) {
    if (joined[i] != i || !is_open[i]) continue;
    const glm::dvec3 place = glm::dvec3(mesh.positions[i]) / width, corner = glm::floor(place - 0.5);
    // What is nearer than half a cell, four roundings, lies in one of these eight.
    for (int neighbour = 0; neighbour < 8 && same[i] == i; ++neighbour) {
      Cell cell{};
      for (std::size_t axis = 0; axis < 3; ++axis)
        cell.at[axis] = static_cast<std::int64_t>(corner[static_cast<int>(axis)]) + (neighbour >> axis & 1);
      if (const auto other = found.find(cell); other != found.end()) {
        const glm::dvec3 way = glm::dvec3(mesh.positions[other->second]) / width - place;
        if (std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)}) <= 0.5) same[i] = other->second;
      }
    }
    const glm::dvec3 own = glm::floor(place);
    if (same[i] == i)
      found.try_emplace(
          {{static_cast<std::int64_t>(own.x), static_cast<std::int64_t>(own.y), static_cast<std::int64_t>(own.z)}}, i);
  }
  if (same == joined) return false;
  for (std::size_t i = 0; i < joined.size(); ++i) mesh.positions[i] = mesh.positions[same[joined[i]]];
  return true;
}

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

double twice_area(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The polygon seen along its normal, so that it runs counter-clockwise.
std::vector<glm::dvec2> flattened(const RawMesh& mesh, std::span<const std::uint32_t> corners) {
  const glm::dvec3 origin = mesh.positions[corners[0]];
  glm::dvec3 normal(0);
  for (std::size_t i = 2; i < corners.size(); ++i)
    normal += glm::cross(mesh.positions[corners[i - 1]] - origin, mesh.positions[corners[i]] - origin);
  const glm::dvec3 size = glm::abs(normal);
  const int w = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2, u = (w + 1) % 3, v = (w + 2) % 3;
  std::vector<glm::dvec2> flat;
  for (const std::uint32_t corner : corners) {
    const glm::dvec3 p = mesh.positions[corner] - origin;
    flat.emplace_back(normal[w] < 0 ? -p[u] : p[u], p[v]);
  }
  return flat;
}

} // namespace

std::string printable(std::string_view text) {
  constexpr std::size_t longest = 200;
  std::string result(text.substr(0, longest));
  for (char& c : result)
    if (c < ' ' || c > '~') c = c == '\n' || c == '\t' ? ' ' : '?';
  while (!result.empty() && (result.back() == '.' || result.back() == ' ')) result.pop_back();
  return result;
}

std::string_view next_word(std::string_view& text, std::size_t* lines) {
  std::size_t begin = 0;
  for (; begin < text.size() && is_blank(text[begin]); ++begin)
    if (lines != nullptr && text[begin] == '\n') ++*lines;
  std::size_t end = begin;
  while (end < text.size() && !is_blank(text[end])) ++end;
  const std::string_view word = text.substr(begin, end - begin);
  text.remove_prefix(end);
  return word;
}

double coordinate_of(std::string_view word, std::size_t line) {
  const auto number = typed_number<double>(word);
  if (number && std::isfinite(static_cast<float>(*number))) return *number;
  const std::string where = line > 0 ? fmt::format("line {}: ", line) : std::string();
  if (word.empty()) throw std::runtime_error(where + "a coordinate is missing");
  if (word.find(',') != std::string_view::npos)
    throw std::runtime_error(
        where + fmt::format("'{}' has a decimal comma; numbers of the file need a point", printable(word)));
  throw std::runtime_error(where + fmt::format("'{}' is not a finite number", printable(word)));
}

glm::vec3 direction_of(const glm::dvec3& vector) {
  const double length = glm::length(vector);
  return length > 0 && std::isfinite(length) ? glm::vec3(vector / length) : glm::vec3(0);
}

std::uint32_t vertex_of(double index, const RawMesh& mesh, const std::string& what) {
  if (index >= 0 && index < static_cast<double>(mesh.positions.size())) return static_cast<std::uint32_t>(index);
  throw std::runtime_error(fmt::format("{} names vertex {} of {}", what, index, mesh.positions.size()));
}

// Ears are cut off, one after the other (Meisters 1975), from the corner after the last one.
void add_polygon(RawMesh& mesh, std::span<const std::uint32_t> corners, std::span<const glm::vec2> texcoords) {
  if (corners.size() < 3) return; // a point or a line
  if (mesh.triangles.size() + corners.size() > max_triangles)
    throw std::runtime_error(fmt::format("more than {} triangles", max_triangles));
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    mesh.triangles.emplace_back(corners[a], corners[b], corners[c]);
    if (!texcoords.empty()) mesh.texcoords.push_back({texcoords[a], texcoords[b], texcoords[c]});
  };
  if (corners.size() == 3) return add(0, 1, 2);
  const std::vector<glm::dvec2> flat = flattened(mesh, corners);
  std::vector<std::size_t> left(corners.size()), reflex; // these alone can lie within an ear
  for (std::size_t i = 0, n = left.size(); i < n; ++i) {
    left[i] = i;
    if (!(twice_area(flat[(i + n - 1) % n], flat[i], flat[(i + 1) % n]) > 0)) reflex.push_back(i);
  }
  const auto is_ear = [&](std::size_t a, std::size_t b, std::size_t c) {
    const glm::dvec2 &p = flat[a], &q = flat[b], &r = flat[c];
    return twice_area(p, q, r) > 0 && std::ranges::none_of(reflex, [&](std::size_t other) {
             const glm::dvec2& x = flat[other];
             return x != p && x != q && x != r && twice_area(p, q, x) >= 0 && twice_area(q, r, x) >= 0 &&
                    twice_area(r, p, x) >= 0;
           });
  };
  // Of a convex polygon these are a fan about its first corner; so is what is left of one that crosses itself or has no
  // area, where no ear is found.
  for (std::size_t at = 0, misses = 0; left.size() > 2;) {
    const std::size_t b = (at + 1) % left.size(), c = (at + 2) % left.size();
    if (misses < left.size() && !is_ear(left[at], left[b], left[c])) {
      at = b;
      ++misses;
      continue;
    }
    add(left[at], left[b], left[c]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(b));
    if (b < at) --at;
    if (misses < left.size() + 1) misses = 0;
  }
}

Mesh finished(RawMesh raw) {
  Mesh mesh;
  mesh.middle = move_to_middle(raw);
  mesh.positions.assign(raw.positions.begin(), raw.positions.end());
  raw.positions = {};
  mesh.normals = std::move(raw.normals);
  mesh.triangles = std::move(raw.triangles);
  mesh.texcoords = std::move(raw.texcoords);
  join_vertices(mesh);
  if (!std::ranges::all_of(mesh.positions, is_within_reach))
    throw std::runtime_error("a vertex lies more than 1e18 units from the origin or from the mesh's middle");
  if (close_seams(mesh)) join_vertices(mesh);
  if (!mesh.normals.empty()) mend_normals(mesh);
  return mesh;
}

} // namespace nephroid::scene
