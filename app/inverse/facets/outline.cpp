// SPDX-License-Identifier: Apache-2.0
// A round lens: its relief cut along an ellipse, and the side and the front that close it.
#include "inverse/facets/smooth_solid.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <unordered_map>

namespace nephroid::inverse {
namespace {

enum class Side : std::uint8_t { within, on, beside };

/// A corner is moved onto the ellipse over this part of its shortest edge at most.
constexpr double moves = 0.2;

class Cutter {
public:
  Cutter(const Layout& layout, const Surface& surface, Solid& solid)
      : surface_(surface), half_(layout.size / 2.0), front_(layout.thickness), solid_(solid), mesh_(solid.mesh) {}

  void cut() {
    find_sides();
    std::vector<glm::uvec3> whole;
    whole.swap(mesh_.triangles);
    for (const glm::uvec3& t : whole) cut_triangle(t);
    drop_unused();
    solid_.parts.assign(mesh_.triangles.size(), Part::facet);
    close(rim());
  }

private:
  glm::dvec2 at(std::uint32_t id) const { return glm::dvec2(mesh_.positions[id].x, mesh_.positions[id].y); }

  void find_sides() {
    std::vector<double> shortest(mesh_.positions.size(), std::numeric_limits<double>::infinity());
    for (const glm::uvec3& t : mesh_.triangles)
      for (int i = 0; i < 3; ++i) {
        const std::uint32_t a = t[i], b = t[(i + 1) % 3];
        const double length = glm::distance(at(a), at(b));
        shortest[a] = std::min(shortest[a], length);
        shortest[b] = std::min(shortest[b], length);
      }
    for (std::uint32_t id = 0; id < mesh_.positions.size(); ++id) {
      const glm::dvec2 p = at(id);
      const double r = glm::length(p / half_);
      Side side = r < 1 ? Side::within : Side::beside;
      if (glm::length(p) * std::abs(1 / r - 1) < moves * shortest[id]) {
        const glm::dvec2 moved = p / r;
        mesh_.positions[id] = glm::vec3(glm::dvec3(moved, surface_.at(moved).z));
        side = Side::on;
      }
      sides_.push_back(side);
    }
  }

  std::uint32_t crossing(std::uint32_t within, std::uint32_t beside) {
    const auto [known, is_new] = crossings_.try_emplace(std::uint64_t{within} << 32 | beside, 0);
    if (!is_new) return known->second;
    const glm::dvec2 from = at(within) / half_, way = at(beside) / half_ - from; // |from + t way| = 1
    const double a = glm::dot(way, way), b = glm::dot(from, way), c = glm::dot(from, from) - 1;
    const glm::dvec2 p = (from + way * ((std::sqrt(b * b - a * c) - b) / a)) * half_;
    return known->second = solid_.add({p, surface_.at(p).z});
  }

  void cut_triangle(const glm::uvec3& t) {
    const auto side = [&](int i) { return sides_[t[i % 3]]; };
    if (side(0) != Side::within && side(1) != Side::within && side(2) != Side::within) return;
    std::vector<std::uint32_t> ring;
    for (int i = 0; i < 3; ++i) {
      if (side(i) != Side::beside) ring.push_back(t[i]);
      if (side(i) == Side::within && side(i + 1) == Side::beside) ring.push_back(crossing(t[i], t[(i + 1) % 3]));
      if (side(i) == Side::beside && side(i + 1) == Side::within) ring.push_back(crossing(t[(i + 1) % 3], t[i]));
    }
    for (std::size_t i = 2; i < ring.size(); ++i) mesh_.triangles.emplace_back(ring[0], ring[i - 1], ring[i]);
  }

  void drop_unused() {
    constexpr auto unused = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> now(mesh_.positions.size(), unused);
    std::vector<glm::vec3> kept;
    for (glm::uvec3& t : mesh_.triangles)
      for (int i = 0; i < 3; ++i) {
        if (now[t[i]] == unused) {
          now[t[i]] = static_cast<std::uint32_t>(kept.size());
          kept.push_back(mesh_.positions[t[i]]);
        }
        t[i] = now[t[i]];
      }
    mesh_.positions = std::move(kept);
  }

  /// Vertices of the edges that have one triangle, clockwise seen from above, as the relief's triangles pass them.
  std::vector<std::uint32_t> rim() const {
    std::unordered_map<std::uint64_t, int> passed;
    const auto key = [](std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32 | b; };
    std::unordered_map<std::uint32_t, std::uint32_t> next;
    const auto near_rim = [&](std::uint32_t id) { return std::abs(glm::length(at(id) / half_) - 1) < 1e-5; };
    for (const glm::uvec3& t : mesh_.triangles)
      for (int i = 0; i < 3; ++i)
        if (near_rim(t[i]) && near_rim(t[(i + 1) % 3])) ++passed[key(t[i], t[(i + 1) % 3])];
    for (const auto& [edge, count] : passed) {
      const auto a = static_cast<std::uint32_t>(edge >> 32), b = static_cast<std::uint32_t>(edge);
      if (!passed.contains(key(b, a))) next[a] = b;
    }
    std::vector<std::uint32_t> ring;
    const std::uint32_t first = std::ranges::min_element(next)->first;
    for (std::uint32_t id = first; ring.empty() || id != first; id = next.at(id)) ring.push_back(id);
    return ring;
  }

  void close(const std::vector<std::uint32_t>& ring) {
    std::vector<std::uint32_t> above;
    for (const std::uint32_t id : ring) above.push_back(solid_.add({at(id), front_}));
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const std::size_t k = (i + 1) % ring.size();
      solid_.add(ring[k], ring[i], above[i], Part::side);
      solid_.add(ring[k], above[i], above[k], Part::side);
    }
    make_front(above);
  }

  /// Strips along y between the upper and the lower half, so that rays find their triangle soon.
  void make_front(std::vector<std::uint32_t> ring) {
    const auto x_of = [&](std::uint32_t id) { return mesh_.positions[id].x; };
    // Clockwise from the left: the upper half first.
    std::rotate(ring.begin(), std::ranges::min_element(ring, {}, x_of), ring.end());
    const auto right = std::ranges::max_element(ring, {}, x_of);
    const std::vector<std::uint32_t> upper(ring.begin(), right + 1);
    std::vector<std::uint32_t> lower(ring.rbegin(), std::make_reverse_iterator(right));
    lower.insert(lower.begin(), ring.front());
    std::size_t i = 0, k = 0;
    while (i + 1 < lower.size() || k + 1 < upper.size()) {
      const bool along_lower =
          k + 1 == upper.size() || (i + 1 < lower.size() && x_of(lower[i + 1]) < x_of(upper[k + 1]));
      const std::uint32_t next = along_lower ? lower[i + 1] : upper[k + 1];
      if (lower[i] != upper[k] && next != lower[i] && next != upper[k])
        solid_.add(lower[i], next, upper[k], Part::front);
      ++(along_lower ? i : k);
    }
  }

  const Surface& surface_;
  glm::dvec2 half_;
  double front_;
  Solid& solid_;
  scene::Mesh& mesh_; ///< the solid's
  std::vector<Side> sides_;
  std::unordered_map<std::uint64_t, std::uint32_t> crossings_; ///< between a corner within and one beside
};

} // namespace

void cut_round(const Layout& layout, const Surface& surface, Solid& solid) { Cutter(layout, surface, solid).cut(); }

} // namespace nephroid::inverse
