// SPDX-License-Identifier: Apache-2.0
#include "inverse/facets/smooth_solid.h"

#include "base/parallel.h"
#include "inverse/bending.h"
#include "inverse/light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nephroid::inverse {
namespace {

constexpr double most_exponent = 6; // 64 parts

/// The largest factor by which a matrix stretches.
double largest_stretch(const glm::dmat2& m) {
  return (std::hypot(m[0][0] + m[1][1], m[0][1] - m[1][0]) + std::hypot(m[0][0] - m[1][1], m[0][1] + m[1][0])) / 2;
}

/// What a facet's light does on the receiver: how bright it is there, over what it is where no facet bends it, and by
/// how many cells flat triangles of the whole facet would miss, as far as that is seen. Triangles cast patches of their
/// own size. Where light is gathered, so many patches lie over each other that the unevenness of each counts less: a
/// lattice of patches t wide and s t apart is uneven by s^2 t / pi^2 over a cell, of which s^2 is 1 / density.
struct Patch {
  double miss = 0, density = 0;
};

Patch patch_of(const Layout& light, const Layout& mesh, const Surface& surface, std::size_t i) {
  constexpr double little = 1e-6, brightest = 1e3;
  Patch patch;
  double area = 0;
  const std::array<glm::dvec2, 5> samples{glm::dvec2(0), {-0.5, -0.5}, {0.5, -0.5}, {-0.5, 0.5}, {0.5, 0.5}};
  for (const glm::dvec2& sample : samples) {
    const glm::dvec2 p = mesh.middle(i) + sample * mesh.facet();
    const Surface::At at = surface.at(p);
    const Incoming in = incoming_on(light, p, at.z);
    const double way = light.distances.front() + at.z;
    const glm::dvec2 slope = facet_slope(at.gradient, light.n, in.sines);
    glm::dmat2 bent, moved; // how light moves over the surface, by its curvature alone and by all
    for (int axis = 0; axis < 2; ++axis) {
      const glm::dvec2 gradient = at.gradient + little * at.curvature[axis];
      bent[axis] = way / little * (facet_slope(gradient, light.n, in.sines) - slope);
      moved[axis] = way / little * (facet_slope(gradient, light.n, in.sines + little * in.spread[axis]) - slope);
    }
    const double side = std::max(mesh.facet().x, mesh.facet().y) / std::min(light.cell().x, light.cell().y);
    patch.miss = std::max(patch.miss, largest_stretch(bent) * side / 2);
    area += std::abs(glm::determinant(glm::dmat2(1) + moved)) / static_cast<double>(samples.size());
  }
  patch.density = 1 / std::max(area, 1 / brightest);
  patch.miss *= std::min(1.0, 1 / patch.density);
  return patch;
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
  std::vector<Patch> patches(layout.facet_count());
  for_ranges(patches.size(), 4096, [&](std::size_t, const Range& range) {
    for (std::size_t i = range.begin; i < range.end; ++i)
      if (part_within(layout, layout.middle(i), layout.facet()) > 0) patches[i] = patch_of(of, layout, surface, i);
  });
  double weights = 0;
  std::vector<double> exponents; // of 2, up to a number for all
  for (const auto& [miss, density] : patches) {
    weights += density;
    exponents.push_back(std::log2(std::sqrt(std::sqrt(density) * miss)));
  }
  std::vector<int> parts(patches.size());
  const auto error_with = [&](double more) {
    double squares = 0;
    for (std::size_t i = 0; i < patches.size(); ++i) {
      parts[i] = 1 << static_cast<int>(std::clamp(std::round(exponents[i] + more), 0.0, most_exponent));
      squares += patches[i].density * patches[i].miss * patches[i].miss / (parts[i] * parts[i]);
    }
    return std::sqrt(squares / weights);
  };
  error_with(last_good(30.0, -10.0, 16, [&](double more) { return error_with(more) <= mesh_error; }));
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
