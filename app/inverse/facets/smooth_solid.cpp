// SPDX-License-Identifier: Apache-2.0
#include "inverse/facets/smooth_solid.h"

#include "base/parallel.h"
#include "inverse/bending.h"
#include "inverse/light.h"

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid::inverse {
namespace {

constexpr int most_parts = 64;

/// The larger of the two values by which a symmetric matrix stretches.
double largest_stretch(const glm::dmat2& m) {
  const double half = (m[0][0] + m[1][1]) / 2, off = std::hypot((m[0][0] - m[1][1]) / 2, m[0][1]);
  return std::abs(half) + off;
}

/// Edges of facets have vertices of their own, as many as the finer of both sides.
class SmoothBuilder {
public:
  SmoothBuilder(const Layout& layout, const Surface& surface, const std::vector<int>& parts)
      : layout_(layout), grid_(mesh_layout(layout)), surface_(surface), parts_(parts), nx_(grid_.facets.x),
        ny_(grid_.facets.y) {}

  std::uint64_t triangles() const {
    std::uint64_t count = 0;
    for (int row = 0; row < ny_; ++row)
      for (int column = 0; column < nx_; ++column) {
        const auto k = static_cast<std::uint64_t>(of(column, row));
        count += 4 * k * (k - 1);
        for (const int side : sides(column, row)) count += static_cast<std::uint64_t>(side);
      }
    for (int x = 0; x < nx_; ++x) count += static_cast<std::uint64_t>(across(x, 0) + across(x, ny_)) + 2;
    for (int y = 0; y < ny_; ++y) count += static_cast<std::uint64_t>(down(0, y) + down(nx_, y)) + 2;
    return count + 2 * static_cast<std::uint64_t>(nx_) + 2 * static_cast<std::uint64_t>(ny_) - 2;
  }

  Solid build() {
    number_edges();
    make_facets();
    if (layout_.round)
      cut_round(layout_, surface_, solid_);
    else
      make_rim();
    solid_.surface = std::make_shared<const Surface>(surface_);
    measure();
    return std::move(solid_);
  }

private:
  int of(int column, int row) const { return parts_[index_at(column, row, nx_)]; }
  bool is_facet(int column, int row) const { return column >= 0 && row >= 0 && column < nx_ && row < ny_; }
  int finer(int c1, int r1, int c2, int r2) const {
    return std::max(is_facet(c1, r1) ? of(c1, r1) : 1, is_facet(c2, r2) ? of(c2, r2) : 1);
  }
  /// Parts of the edge to the right of a corner, and of that below it.
  int across(int a, int b) const { return finer(a, b - 1, a, b); }
  int down(int a, int b) const { return finer(a - 1, b, a, b); }
  std::array<int, 4> sides(int column, int row) const {
    return {across(column, row), down(column + 1, row), across(column, row + 1), down(column, row)};
  }

  /// x and y in facets from the top left corner.
  std::uint32_t add(double x, double y) {
    const glm::dvec2 p = grid_.corner(x, y);
    return solid_.add({p, surface_.at(p).z});
  }

  void number_edges() {
    for (int b = 0; b <= ny_; ++b)
      for (int a = 0; a <= nx_; ++a) corners_.push_back(add(a, b));
    const auto along = [&](int a, int b, const glm::dvec2& step, int count) {
      const auto first = static_cast<std::uint32_t>(solid_.mesh.positions.size());
      for (int i = 1; i < count; ++i) add(a + step.x * i / count, b + step.y * i / count);
      return first;
    };
    for (int b = 0; b <= ny_; ++b)
      for (int a = 0; a < nx_; ++a) across_.push_back(along(a, b, {1, 0}, across(a, b)));
    for (int b = 0; b < ny_; ++b)
      for (int a = 0; a <= nx_; ++a) down_.push_back(along(a, b, {0, 1}, down(a, b)));
  }

  /// Point i of the edge to the right of a corner, or below it.
  std::uint32_t on_across(int a, int b, int i) const {
    if (i == 0 || i == across(a, b)) return corners_[index_at(a + (i > 0), b, nx_ + 1)];
    return across_[index_at(a, b, nx_)] + static_cast<std::uint32_t>(i - 1);
  }
  std::uint32_t on_down(int a, int b, int i) const {
    if (i == 0 || i == down(a, b)) return corners_[index_at(a, b + (i > 0), nx_ + 1)];
    return down_[index_at(a, b, nx_ + 1)] + static_cast<std::uint32_t>(i - 1);
  }

  void make_facets() {
    std::vector<std::uint32_t> inside, ring;
    for (int row = 0; row < ny_; ++row)
      for (int column = 0; column < nx_; ++column) {
        const int k = of(column, row);
        inside.clear();
        for (int v = 1; v < k; ++v)
          for (int u = 1; u < k; ++u)
            inside.push_back(add(column + static_cast<double>(u) / k, row + static_cast<double>(v) / k));
        const auto [top, right, bottom, left] = sides(column, row);
        const auto at = [&, top = top, right = right, bottom = bottom,
                         left = left](int u, int v) { // clang 14 captures no bindings
          if (v == 0) return on_across(column, row, u * (top / k));
          if (v == k) return on_across(column, row + 1, u * (bottom / k));
          if (u == 0) return on_down(column, row, v * (left / k));
          if (u == k) return on_down(column + 1, row, v * (right / k));
          return inside[index_at(u - 1, v - 1, k - 1)];
        };
        for (int v = 0; v < k; ++v)
          for (int u = 0; u < k; ++u) { // clockwise seen from above: it faces down
            ring.assign(1, at(u, v));
            for (int i = 1; v == 0 && i < top / k; ++i) ring.push_back(on_across(column, row, u * (top / k) + i));
            ring.push_back(at(u + 1, v));
            for (int i = 1; u + 1 == k && i < right / k; ++i)
              ring.push_back(on_down(column + 1, row, v * (right / k) + i));
            ring.push_back(at(u + 1, v + 1));
            for (int i = bottom / k - 1; v + 1 == k && i > 0; --i)
              ring.push_back(on_across(column, row + 1, u * (bottom / k) + i));
            ring.push_back(at(u, v + 1));
            for (int i = left / k - 1; u == 0 && i > 0; --i) ring.push_back(on_down(column, row, v * (left / k) + i));
            const std::uint32_t middle = add(column + (u + 0.5) / k, row + (v + 0.5) / k);
            for (std::size_t i = 0; i < ring.size(); ++i)
              solid_.add(middle, ring[i], ring[(i + 1) % ring.size()], Part::facet);
          }
      }
  }

  /// A rectangle's sides and front. The front is strips along y, one a column, so that rays find their triangle soon.
  void make_rim() {
    const auto front = [&](int a, int b) { return solid_.add({grid_.corner(a, b), layout_.thickness}); };
    std::vector<std::uint32_t> upper, lower, left, right; // the front's edges
    for (int a = 0; a <= nx_; ++a) upper.push_back(front(a, 0));
    for (int a = 0; a <= nx_; ++a) lower.push_back(front(a, ny_));
    for (int b = 0; b <= ny_; ++b) left.push_back(b == 0 ? upper.front() : b == ny_ ? lower.front() : front(0, b));
    for (int b = 0; b <= ny_; ++b) right.push_back(b == 0 ? upper.back() : b == ny_ ? lower.back() : front(nx_, b));
    const auto side = [&](std::uint32_t from, std::uint32_t to, int count, const auto& point,
                          bool turned) { // from, to: at the front
      for (int i = 0; i < count; ++i)
        turned ? solid_.add(from, point(i), point(i + 1), Part::side)
               : solid_.add(from, point(i + 1), point(i), Part::side);
      turned ? solid_.add(from, point(count), to, Part::side) : solid_.add(from, to, point(count), Part::side);
    };
    for (int a = 0; a < nx_; ++a) {
      const auto i = static_cast<std::size_t>(a);
      side(
          upper[i], upper[i + 1], across(a, 0), [&](int k) { return on_across(a, 0, k); }, false);
      side(
          lower[i], lower[i + 1], across(a, ny_), [&](int k) { return on_across(a, ny_, k); }, true);
    }
    for (int b = 0; b < ny_; ++b) {
      const auto i = static_cast<std::size_t>(b);
      side(
          left[i], left[i + 1], down(0, b), [&](int k) { return on_down(0, b, k); }, true);
      side(
          right[i], right[i + 1], down(nx_, b), [&](int k) { return on_down(nx_, b, k); }, false);
    }
    for (int a = 0; a < nx_; ++a) {
      const auto i = static_cast<std::size_t>(a);
      if (a == 0)
        for (std::size_t b = 0; b + 1 < left.size(); ++b) solid_.add(left[b], left[b + 1], upper[1], Part::front);
      else
        solid_.add(upper[i], lower[i], upper[i + 1], Part::front);
      if (a + 1 == nx_)
        for (std::size_t b = 0; b + 1 < right.size(); ++b) solid_.add(lower[i], right[b + 1], right[b], Part::front);
      else
        solid_.add(lower[i], lower[i + 1], upper[i + 1], Part::front);
    }
  }

  void measure() {
    const scene::Mesh& mesh = solid_.mesh;
    for (std::size_t t = 0; t < solid_.parts.size() && solid_.parts[t] == Part::facet; ++t) {
      const glm::dvec3 a = mesh.positions[mesh.triangles[t].x], b = mesh.positions[mesh.triangles[t].y],
                       c = mesh.positions[mesh.triangles[t].z], across = glm::cross(b - a, c - a);
      for (const double z : {a.z, b.z, c.z}) solid_.reach(z);
      solid_.steepest_deg =
          std::max(solid_.steepest_deg, glm::degrees(std::atan2(glm::length(glm::dvec2(across)), std::abs(across.z))));
    }
    for (std::size_t i = 0; i < layout_.facet_count(); ++i) {
      const Surface::At at = surface_.at(layout_.middle(i));
      solid_.facets.push_back({facet_slope(at.gradient, layout_.n, layout_.sines_on(i)), at.gradient, at.z});
    }
  }

  const Layout& layout_;
  Layout grid_;
  const Surface& surface_;
  const std::vector<int>& parts_;
  int nx_, ny_;
  std::vector<std::uint32_t> corners_, across_, down_; ///< across, down: the first vertex within the edge
  Solid solid_;
};

} // namespace

Layout mesh_layout(Layout layout) {
  constexpr int most = 4096; // across and down
  const glm::dvec2 facet = layout.facet();
  for (const int axis : {0, 1}) {
    const int times = most / layout.facets[axis];
    layout.facets[axis] *= static_cast<int>(
        std::clamp(std::round(facet[axis] / facet[1 - axis]), 1.0, std::max(1.0, static_cast<double>(times))));
  }
  return layout;
}

std::vector<int> mesh_parts(const Layout& of, const Surface& surface, double mesh_error) {
  const Layout layout = mesh_layout(of);
  std::vector<double> misses(layout.facet_count()); // by how many cells facets in one part miss
  const double side = std::max(layout.facet().x, layout.facet().y) / std::min(layout.cell().x, layout.cell().y);
  for_ranges(misses.size(), 4096, [&](std::size_t, const Range& range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      if (part_within(layout, layout.middle(i), layout.facet()) == 0) continue;
      for (const glm::dvec2& corner : {glm::dvec2(0, 0), {-0.5, -0.5}, {0.5, -0.5}, {-0.5, 0.5}, {0.5, 0.5}}) {
        const Surface::At at = surface.at(layout.middle(i) + corner * layout.facet());
        const double moves =
            std::abs(layout.n - 1) * (1 + glm::dot(at.gradient, at.gradient)) * (layout.distances.front() + at.z);
        misses[i] = std::max(misses[i], moves * largest_stretch(at.curvature) * side / 2);
      }
    }
  });
  std::vector<int> parts(misses.size());
  const double within = static_cast<double>(misses.size()) * (layout.round ? glm::pi<double>() / 4 : 1);
  const auto error_with = [&](double scale) {
    double squares = 0;
    for (std::size_t i = 0; i < misses.size(); ++i) {
      const double exponent = std::round(std::log2(std::max(1.0, scale * std::sqrt(misses[i]))));
      parts[i] = 1 << static_cast<int>(std::min(exponent, std::log2(most_parts)));
      squares += misses[i] * misses[i] / (parts[i] * parts[i]);
    }
    return std::sqrt(squares / within);
  };
  constexpr double finest = 1e9, step = 1.1;
  double scale = 1e-3;
  while (error_with(scale) > mesh_error && scale < finest) scale *= step;
  return parts;
}

std::uint64_t count_triangles(const Layout& layout, const std::vector<int>& parts) {
  return SmoothBuilder(layout, Surface(layout.size, Grid::Zero(2, 2)), parts).triangles();
}

void refuse_mesh(const Location& own, double mesh_error, std::uint64_t triangles) {
  throw bad_input(own / "mesh_error",
                  fmt::format("is {}, for which the lens takes some {} million triangles, an STL of {:.3g} GB",
                              mesh_error, triangles / 1'000'000, static_cast<double>(stl_bytes(triangles)) / 1e9),
                  fmt::format("expected one of at most {:.3g} GB", static_cast<double>(most_stl_bytes) / 1e9),
                  "choose a larger mesh_error or fewer cells");
}

Solid make_smooth_solid(const Layout& layout, const Surface& surface, const std::vector<int>& parts) {
  return SmoothBuilder(layout, surface, parts).build();
}

} // namespace nephroid::inverse
