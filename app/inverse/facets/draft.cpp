// SPDX-License-Identifier: Apache-2.0
// Walls that lean, so that the solid can be milled and leaves a mould.
#include "inverse/facets/solid.h"

namespace nephroid::inverse {
namespace {

/// Where no wall is, the strip is still so wide a part of a facet: readers of meshes refuse triangles of no area.
constexpr double least_given = 1e-3;
/// The widest strip, in parts of a facet.
constexpr double most_given = 0.4;
/// Strips are widened so often until their walls lean enough.
constexpr int most_widenings = 20;

/// A facet's corners as they are seen from +z.
enum Corner : std::size_t { left_top, right_top, right_bottom, left_bottom };

class DraftBuilder {
public:
  DraftBuilder(const Layout& layout, Solid solid)
      : layout_(layout), nx_(layout.facets.x), ny_(layout.facets.y), beside_(index_at(0, ny_, nx_ + 1)),
        below_(index_at(0, ny_ + 1, nx_)), solid_(std::move(solid)) {
    for (int b = 0; b < ny_; ++b)
      for (int a = 1; a < nx_; ++a) beside(a, b) = least_given * layout.facet().x;
    for (int b = 1; b < ny_; ++b)
      for (int a = 0; a < nx_; ++a) below(a, b) = least_given * layout.facet().y;
  }

  Solid build() {
    for (int round = 0; round < most_widenings && widen(); ++round) {
    }
    place_corners();
    for (int b = 0; b < ny_; ++b)
      for (int a = 0; a < nx_; ++a) facet(a, b);
    for_walls([&](const std::array<glm::uint, 3>& t, auto) { solid_.add(t[0], t[1], t[2], Part::wall); });
    close();
    measure();
    return std::move(solid_);
  }

private:
  /// What each side of an edge gives up: of the edge at the left of facet (a, b), and of that above it. 0 on the rim.
  double& beside(int a, int b) { return beside_[index_at(a, b, nx_ + 1)]; }
  double& below(int a, int b) { return below_[index_at(a, b, nx_)]; }

  /// The vertices of all facets' corners, then of the points where four facets meet.
  void place_corners() {
    solid_.mesh.positions.clear();
    places_.clear();
    const glm::dvec2 half = layout_.facet() / 2.0;
    for (int b = 0; b < ny_; ++b)
      for (int a = 0; a < nx_; ++a) {
        const Facet& f = solid_.facets[index_at(a, b, nx_)];
        const double left = beside(a, b) - half.x, right = half.x - beside(a + 1, b), top = half.y - below(a, b),
                     bottom = below(a, b + 1) - half.y;
        for (const glm::dvec2& p :
             {glm::dvec2(left, top), glm::dvec2(right, top), glm::dvec2(right, bottom), glm::dvec2(left, bottom)})
          add(glm::dvec3(layout_.middle(index_at(a, b, nx_)) + p, f.height + glm::dot(f.gradient, p)));
      }
    for (int b = 1; b < ny_; ++b)
      for (int a = 1; a < nx_; ++a) {
        double z = 0;
        for (const glm::uint id : around(a, b)) z += places_[id].z / 4;
        add({layout_.corner(a, b), z});
      }
  }

  glm::uint add(const glm::dvec3& place) {
    places_.push_back(place);
    return solid_.add(place);
  }

  glm::uint corner(int a, int b, Corner k) const { return static_cast<glm::uint>(4 * index_at(a, b, nx_) + k); }

  /// The corners about the point at the left top of facet (a, b), clockwise seen from above.
  std::array<glm::uint, 4> around(int a, int b) const {
    return {corner(a - 1, b - 1, right_bottom), corner(a, b - 1, left_bottom), corner(a, b, left_top),
            corner(a - 1, b, right_top)};
  }

  /// f(a triangle, what the edges give that it stands between) for all triangles of the walls, clockwise from above.
  template <class F>
  void for_walls(const F& f) {
    const auto strip = [&](glm::uint p, glm::uint q, glm::uint r, glm::uint s, double* given) {
      f(std::array{p, q, r}, std::array{given});
      f(std::array{p, r, s}, std::array{given});
    };
    for (int b = 0; b < ny_; ++b)
      for (int a = 1; a < nx_; ++a)
        strip(corner(a - 1, b, right_bottom), corner(a - 1, b, right_top), corner(a, b, left_top),
              corner(a, b, left_bottom), &beside(a, b));
    for (int b = 1; b < ny_; ++b)
      for (int a = 0; a < nx_; ++a)
        strip(corner(a, b - 1, left_bottom), corner(a, b - 1, right_bottom), corner(a, b, right_top),
              corner(a, b, left_top), &below(a, b));
    for (int b = 1; b < ny_; ++b)
      for (int a = 1; a < nx_; ++a) {
        const auto middle = static_cast<glm::uint>(4 * solid_.facets.size() + index_at(a - 1, b - 1, nx_ - 1));
        const std::array<glm::uint, 4> ring = around(a, b);
        for (std::size_t i = 0; i < 4; ++i)
          f(std::array{middle, ring[i], ring[(i + 1) % 4]},
            std::array{&beside(a, b - 1), &beside(a, b), &below(a - 1, b), &below(a, b)});
      }
  }

  glm::dvec3 normal(const std::array<glm::uint, 3>& t) const {
    return glm::normalize(glm::cross(places_[t[1]] - places_[t[0]], places_[t[2]] - places_[t[0]]));
  }

  /// Widens the strips of walls that are too steep. False: none is, or can be widened.
  bool widen() {
    place_corners();
    const double most = 1 / layout_.draft; // the steepest gradient
    std::vector<std::pair<double*, double>> wider;
    for_walls([&](const std::array<glm::uint, 3>& t, const auto& given) {
      const glm::dvec3 n = normal(t);
      const double steep = glm::length(glm::dvec2(n)) / std::abs(n.z);
      if (steep <= most) return;
      for (double* const one : given) wider.emplace_back(one, *one * std::min(steep / most * 1.02, 1000.0));
    });
    bool changed = false;
    for (const auto& [one, to] : wider) {
      const bool is_beside = one >= beside_.data() && one < beside_.data() + beside_.size();
      const double bound = most_given * (is_beside ? layout_.facet().x : layout_.facet().y);
      if (std::min(to, bound) <= *one) continue;
      *one = std::min(to, bound);
      changed = true;
    }
    return changed;
  }

  void facet(int a, int b) {
    solid_.add(corner(a, b, left_top), corner(a, b, right_top), corner(a, b, right_bottom), Part::facet);
    solid_.add(corner(a, b, left_top), corner(a, b, right_bottom), corner(a, b, left_bottom), Part::facet);
  }

  /// Sides up from the rim, and the front, a fan about its middle.
  void close() {
    std::vector<glm::uint> rim; // counter-clockwise seen from above
    const auto pass = [&](int a, int b, Corner from, Corner to) {
      for (const Corner k : {from, to})
        if (rim.empty() || corner(a, b, k) != rim.back()) rim.push_back(corner(a, b, k));
    };
    for (int a = 0; a < nx_; ++a) pass(a, ny_ - 1, left_bottom, right_bottom);
    for (int b = ny_ - 1; b >= 0; --b) pass(nx_ - 1, b, right_bottom, right_top);
    for (int a = nx_ - 1; a >= 0; --a) pass(a, 0, right_top, left_top);
    for (int b = 0; b < ny_; ++b) pass(0, b, left_top, left_bottom);
    rim.pop_back(); // the first one
    const auto first = static_cast<glm::uint>(places_.size());
    for (const glm::uint id : rim) add({glm::dvec2(places_[id]), layout_.thickness});
    const glm::uint middle = add({0, 0, layout_.thickness});
    for (std::size_t i = 0; i < rim.size(); ++i) {
      const std::size_t next = (i + 1) % rim.size();
      const glm::uint up = first + static_cast<glm::uint>(i), next_up = first + static_cast<glm::uint>(next);
      solid_.add(rim[i], rim[next], next_up, Part::side);
      solid_.add(rim[i], next_up, up, Part::side);
      solid_.add(middle, up, next_up, Part::front);
    }
  }

  void measure() {
    for (std::size_t i = 0; i < 4 * solid_.facets.size(); ++i) solid_.reach(places_[i].z);
    solid_.steepest_wall_deg = 0;
    for_walls([&](const std::array<glm::uint, 3>& t, auto) {
      const auto [low, high] = std::minmax({places_[t[0]].z, places_[t[1]].z, places_[t[2]].z});
      solid_.highest_wall = std::max(solid_.highest_wall, high - low);
      solid_.wall_area += glm::length(glm::cross(places_[t[1]] - places_[t[0]], places_[t[2]] - places_[t[0]])) / 2;
      solid_.steepest_wall_deg =
          std::max(solid_.steepest_wall_deg, glm::degrees(std::acos(std::min(1.0, std::abs(normal(t).z)))));
    });
  }

  const Layout& layout_;
  int nx_, ny_;
  std::vector<double> beside_, below_;
  std::vector<glm::dvec3> places_; ///< the vertices in double precision
  Solid solid_;
};

} // namespace

Solid with_leaning_walls(const Layout& layout, Solid solid) { return DraftBuilder(layout, std::move(solid)).build(); }

} // namespace nephroid::inverse
