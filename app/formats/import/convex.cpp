// SPDX-License-Identifier: Apache-2.0
// A large box is cut by one half-space after the other. Faces share their corners, and what cuts an edge is made once:
// so the surface stays closed, whatever the roundings are.
#include "formats/import/convex.h"

#include "base/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>

namespace nephroid::formats {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;
using Loop = std::vector<std::uint32_t>;

constexpr double box_size = 1e4; ///< half an edge of the box, in largest distances of the half-spaces
constexpr std::array<glm::dvec3, 6> box_axes{{{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

class Cutting {
public:
  /// tolerance: a corner that is so near to a plane is on it. Faces of the box have the numbers from `count` on.
  Cutting(double half_size, double tolerance, std::size_t count) : tolerance_(tolerance) {
    for (int i = 0; i < 8; ++i)
      body.corners.push_back(half_size * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
    constexpr std::array<std::array<std::uint32_t, 4>, 6> sides{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    for (const auto& side : sides) body.faces.push_back({count++, {side.begin(), side.end()}});
  }

  /// Returns false where roundings leave no convex body.
  bool cut(const HalfSpace& by, std::size_t number) {
    sides_.clear();
    heights_.clear();
    for (const glm::dvec3& p : body.corners) {
      const double height = glm::dot(by.normal, p) - by.distance;
      heights_.push_back(height);
      sides_.push_back(height > tolerance_ ? 1 : height < -tolerance_ ? -1 : 0);
    }
    new_corners_.clear();
    bool is_cut = false;
    for (const ConvexBody::Face& face : body.faces)
      is_cut = is_cut || std::ranges::any_of(face.corners, [&](std::uint32_t v) { return sides_[v] > 0; });
    if (!is_cut) return true;
    for (ConvexBody::Face& face : body.faces) face.corners = below(face.corners);
    std::erase_if(body.faces, [](const ConvexBody::Face& face) { return face.corners.size() < 3; });
    const std::optional<Loop> cap = open_edge();
    if (cap) body.faces.push_back({number, *cap});
    return cap.has_value();
  }

  /// Edges shorter than this become a corner.
  void join(double distance) {
    std::vector<std::uint32_t> joined(body.corners.size());
    std::iota(joined.begin(), joined.end(), 0u);
    const auto root = [&](std::uint32_t v) {
      while (joined[v] != v) v = joined[v];
      return v;
    };
    for (const ConvexBody::Face& face : body.faces)
      for (std::size_t i = 0; i < face.corners.size(); ++i) {
        const std::uint32_t a = root(face.corners[i]), b = root(face.corners[(i + 1) % face.corners.size()]);
        if (glm::length(body.corners[a] - body.corners[b]) < distance) joined[std::max(a, b)] = std::min(a, b);
      }
    for (ConvexBody::Face& face : body.faces) {
      for (std::uint32_t& v : face.corners) v = root(v);
      face.corners.erase(std::unique(face.corners.begin(), face.corners.end()), face.corners.end());
      while (face.corners.size() > 1 && face.corners.front() == face.corners.back()) face.corners.pop_back();
    }
    std::erase_if(body.faces, [](const ConvexBody::Face& face) { return face.corners.size() < 3; });
    renumber();
  }

  /// Puts each corner where its planes meet, in the sense of least squares where they are more than three.
  void settle(std::span<const HalfSpace> half_spaces) {
    std::vector<glm::dmat3> squares(body.corners.size(), glm::dmat3(0));
    std::vector<glm::dvec3> misses(body.corners.size(), glm::dvec3(0));
    for (const ConvexBody::Face& face : body.faces)
      for (const std::uint32_t v : face.corners) {
        const HalfSpace& plane = half_spaces[face.half_space];
        squares[v] += glm::outerProduct(plane.normal, plane.normal);
        misses[v] += (plane.distance - glm::dot(plane.normal, body.corners[v])) * plane.normal;
      }
    constexpr double flat = 1e-6; // of planes that meet at so small an angle that roundings would move the corner
    for (std::size_t v = 0; v < body.corners.size(); ++v)
      if (glm::determinant(squares[v]) > flat) body.corners[v] += glm::inverse(squares[v]) * misses[v];
  }

  /// Each edge has two faces of opposite directions, and corners - edges + faces is 2.
  bool is_closed() const {
    std::set<Edge> edges;
    for (const ConvexBody::Face& face : body.faces)
      for (std::size_t i = 0; i < face.corners.size(); ++i)
        if (!edges.insert({face.corners[i], face.corners[(i + 1) % face.corners.size()]}).second) return false;
    for (const auto& [from, to] : edges)
      if (!edges.contains({to, from})) return false;
    return body.corners.size() + body.faces.size() == edges.size() / 2 + 2;
  }

  ConvexBody body;

private:
  /// What of the polygon is not above the plane; nothing of one that is not below it anywhere.
  Loop below(const Loop& loop) {
    Loop kept;
    bool is_below = false;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
      is_below = is_below || sides_[a] < 0;
      if (sides_[a] <= 0) kept.push_back(a);
      if (sides_[a] * sides_[b] < 0) kept.push_back(corner_between(std::min(a, b), std::max(a, b)));
    }
    return is_below ? kept : Loop();
  }

  std::uint32_t corner_between(std::uint32_t a, std::uint32_t b) {
    const auto [at, is_new] = new_corners_.try_emplace({a, b}, static_cast<std::uint32_t>(body.corners.size()));
    if (is_new) {
      const double t = heights_[a] / (heights_[a] - heights_[b]);
      body.corners.push_back(glm::mix(body.corners[a], body.corners[b], t));
    }
    return at->second;
  }

  /// The edges that have one face, turned round, as a polygon; nothing if they are none.
  std::optional<Loop> open_edge() const {
    const auto is_on = [&](std::uint32_t v) { return v >= sides_.size() || sides_[v] == 0; };
    std::set<Edge> edges;
    for (const ConvexBody::Face& face : body.faces)
      for (std::size_t i = 0; i < face.corners.size(); ++i) {
        const std::uint32_t a = face.corners[i], b = face.corners[(i + 1) % face.corners.size()];
        if (is_on(a) && is_on(b)) edges.insert({a, b});
      }
    std::map<std::uint32_t, std::uint32_t> next;
    for (const auto& [from, to] : edges)
      if (!edges.contains({to, from}) && !next.try_emplace(to, from).second) return std::nullopt;
    if (next.size() < 3) return std::nullopt;
    Loop loop;
    for (std::uint32_t v = next.begin()->first; loop.empty() || v != loop.front(); v = next.at(v)) {
      loop.push_back(v);
      if (loop.size() > next.size() || !next.contains(v)) return std::nullopt;
    }
    return loop.size() == next.size() ? std::optional(loop) : std::nullopt;
  }

  /// Leaves out the corners that no face has.
  void renumber() {
    std::map<std::uint32_t, std::uint32_t> numbers;
    std::vector<glm::dvec3> corners;
    for (ConvexBody::Face& face : body.faces)
      for (std::uint32_t& v : face.corners) {
        const auto [at, is_new] = numbers.try_emplace(v, static_cast<std::uint32_t>(corners.size()));
        if (is_new) corners.push_back(body.corners[v]);
        v = at->second;
      }
    body.corners = std::move(corners);
  }

  double tolerance_;
  std::vector<double> heights_; ///< of corners above the plane
  std::vector<int> sides_;      ///< of the plane: 1 above, 0 on it, -1 below
  std::map<Edge, std::uint32_t> new_corners_;
};

/// The smallest height of the triangles of a fan about the corner at `apex`.
double lowest_of_fan(const ConvexBody& body, const Loop& loop, std::size_t apex) {
  double lowest = 1e300;
  const auto corner = [&](std::size_t i) { return body.corners[loop[(apex + i) % loop.size()]]; };
  for (std::size_t i = 2; i < loop.size(); ++i) {
    const glm::dvec3 a = corner(0), b = corner(i - 1), c = corner(i);
    const double longest = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
    lowest = std::min(lowest, glm::length(glm::cross(b - a, c - a)) / longest);
  }
  return lowest;
}

} // namespace

double ConvexBody::volume() const {
  double six = 0;
  for (const Face& face : faces)
    for (std::size_t i = 2; i < face.corners.size(); ++i)
      six += glm::dot(corners[face.corners[0]], glm::cross(corners[face.corners[i - 1]], corners[face.corners[i]]));
  return six / 6;
}

ConvexBody intersection(std::span<const HalfSpace> half_spaces) {
  double size = 0;
  for (const HalfSpace& half_space : half_spaces) size = std::max(size, half_space.distance);
  constexpr double apart = 1e-6;
  for (const double tolerance : {1e-7, 1e-9, 1e-6, 1e-11}) { // what roundings spoil with one is whole with another
    Cutting cutting(box_size * size, tolerance * size, half_spaces.size());
    bool is_whole = true;
    for (std::size_t i = 0; i < half_spaces.size() && is_whole; ++i) is_whole = cutting.cut(half_spaces[i], i);
    if (!is_whole) continue;
    const auto of_box = std::ranges::find_if(
        cutting.body.faces, [&](const ConvexBody::Face& face) { return face.half_space >= half_spaces.size(); });
    if (of_box != cutting.body.faces.end()) {
      ConvexBody unbounded;
      unbounded.open_towards = box_axes[of_box->half_space - half_spaces.size()];
      return unbounded;
    }
    cutting.join(apart * size);
    cutting.settle(half_spaces);
    if (cutting.is_closed()) return std::move(cutting.body);
  }
  throw bad_input("half-spaces", "what they have in common is too thin for its size");
}

scene::Mesh mesh_of(const ConvexBody& body) {
  scene::Mesh mesh;
  for (const glm::dvec3& p : body.corners) mesh.positions.emplace_back(p);
  for (const ConvexBody::Face& face : body.faces) {
    const Loop& loop = face.corners;
    std::size_t apex = 0;
    for (std::size_t i = 1; i < loop.size(); ++i)
      if (lowest_of_fan(body, loop, i) > lowest_of_fan(body, loop, apex)) apex = i;
    for (std::size_t i = 2; i < loop.size(); ++i)
      mesh.triangles.emplace_back(loop[apex], loop[(apex + i - 1) % loop.size()], loop[(apex + i) % loop.size()]);
  }
  return mesh;
}

} // namespace nephroid::formats
