// SPDX-License-Identifier: Apache-2.0
#include "environment/occlusion/samples.h"

#include "base/parallel.h"
#include "scene/ray.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>

namespace nephroid::environment {
namespace {

constexpr std::size_t most_samples = std::size_t{1} << 18, most_samples_of_light = 1024;

/// A rectangle of a face, in texels; its borders need not be whole.
struct Cell {
  glm::dvec2 low{0}, high{0};
  double length(int axis) const { return high[axis] - low[axis]; }
};

/// How often a cell was cut across and down, and its number from the left and the top among cells cut alike.
struct CellPlace {
  unsigned number[2] = {0, 0};
  int cuts[2] = {0, 0};
};

/// The lowest bits of a number in reverse order.
unsigned mirrored(unsigned number, int bits) {
  unsigned result = 0;
  for (int i = 0; i < bits; ++i) result |= (number >> i & 1) << (bits - 1 - i);
  return result;
}

class Sampler {
public:
  /// to: room for 2^halvings samples.
  Sampler(const CubeMap& cube, const Region& light, int halvings, LightSample* to)
      : cube_(cube), light_(light), halvings_(halvings), to_(to) {
    const Rect& r = light.rect;
    const glm::dvec3 own = flux_of({{r.x0, r.y0}, {r.x1, r.y1}});
    dropped_flux_ = glm::max(light.flux - own, glm::dvec3(0)) / std::exp2(halvings);
    for (int c = 0; c < 3; ++c)
      if (own[c] > 0) parts_[c] = 1 / own[c];
    halve({{r.x0, r.y0}, {r.x1, r.y1}}, {});
  }

private:
  double weight(int x, int y) const { return glm::dot(parts_, cube_.flux_of(cube_.texel(light_.face, x, y))); }

  /// Calls visit(x, y, the part of the texel in the cell) for each texel of the cell.
  template <class Visit>
  static void for_each_texel(const Cell& cell, const Visit& visit) {
    const auto overlap = [&](int i, int axis) {
      return std::min(cell.high[axis], i + 1.0) - std::max(cell.low[axis], double(i));
    };
    const glm::ivec2 first(cell.low), end(glm::ceil(cell.high));
    for (int y = first.y; y < end.y; ++y) {
      const double height = overlap(y, 1);
      for (int x = first.x; x < end.x; ++x) visit(x, y, height * overlap(x, 0));
    }
  }

  glm::dvec3 flux_of(const Cell& cell) const {
    glm::dvec3 sum(0);
    for_each_texel(cell,
                   [&](int x, int y, double part) { sum += part * cube_.flux_of(cube_.texel(light_.face, x, y)); });
    return sum;
  }

  /// The place along an axis (0: x) before which the given part of the cell's weight lies.
  double quantile(const Cell& cell, int axis, double part) const {
    const int first = static_cast<int>(cell.low[axis]);
    std::vector<double> sums(static_cast<std::size_t>(std::ceil(cell.high[axis])) - static_cast<std::size_t>(first),
                             0.0);
    double rest = 0;
    for_each_texel(cell, [&](int x, int y, double area) {
      const double added = area * weight(x, y);
      sums[static_cast<std::size_t>((axis == 0 ? x : y) - first)] += added;
      rest += added;
    });
    rest *= part;
    std::size_t i = 0;
    for (; i + 1 < sums.size() && sums[i] < rest; ++i) rest -= sums[i];
    const double from = std::max(cell.low[axis], first + static_cast<double>(i)),
                 to = std::min(cell.high[axis], first + static_cast<double>(i) + 1);
    return sums[i] > 0 ? from + (to - from) * std::min(rest / sums[i], 1.0) : from;
  }

  /// Cuts the cell across its longer side into two of equal weight, and cuts those again.
  void halve(const Cell& cell, const CellPlace& place) {
    if (place.cuts[0] + place.cuts[1] == halvings_) {
      *to_++ = sample(cell, place);
      return;
    }
    const int axis = cell.length(0) >= cell.length(1) ? 0 : 1;
    Cell before = cell, behind = cell;
    before.high[axis] = behind.low[axis] = quantile(cell, axis, 0.5);
    CellPlace next = place;
    ++next.cuts[axis];
    next.number[axis] *= 2;
    halve(before, next);
    ++next.number[axis];
    halve(behind, next);
  }

  /// Counted by weight, the samples of a rectangle are Hammersley's points: each cell has one, and no two have the same
  /// place across or the same place down. So an edge that moves over the rectangle meets them one by one. (With a cuts
  /// across and b down, the highest a bits of the point's place across and the highest b bits of its place down say
  /// which cell it is in. The lower bits of one place are the higher bits of the other, mirrored.)
  LightSample sample(const Cell& cell, const CellPlace& place) const {
    const auto part = [&](int axis) {
      return (mirrored(place.number[1 - axis], place.cuts[1 - axis]) + 0.5) / std::exp2(place.cuts[1 - axis]);
    };
    const double x = quantile(cell, 0, part(0));
    Cell column = cell; // a column of texels, so that the sample is not in the dark between two lights
    column.low.x = std::max(cell.low.x, std::floor(x));
    column.high.x = std::min(cell.high.x, std::floor(x) + 1);
    const double y = quantile(column, 1, part(1));
    return {glm::normalize(position({light_.face, 2 * x / cube_.size - 1, 2 * y / cube_.size - 1})),
            flux_of(cell) + dropped_flux_};
  }

  const CubeMap& cube_;
  const Region& light_;
  int halvings_;
  LightSample* to_;
  glm::dvec3 dropped_flux_{0};
  glm::dvec3 parts_{0}; ///< the weight of flux in each channel
};

double part(double x) { return x - std::floor(x); }

using Corners = std::array<glm::dvec3, 3>;

double area(const Corners& t) { return glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) / 2; }

/// The area by Thomsen's approximation, within 1.1 %.
double area(const scene::Ellipsoid& ellipsoid) {
  constexpr double p = 1.6075;
  const auto& axes = ellipsoid.half_axes;
  const double a = glm::length(axes[0]), b = glm::length(axes[1]), c = glm::length(axes[2]);
  return 4 * std::numbers::pi * std::pow((std::pow(a * b, p) + std::pow(b * c, p) + std::pow(c * a, p)) / 3, 1 / p);
}

/// The i-th point of an additive recurrence over the square, whose upper half is folded onto the lower.
glm::dvec3 point(const Corners& t, std::size_t i) {
  const double u = part(0.5 + 0.7548776662 * static_cast<double>(i)),
               v = part(0.5 + 0.5698402910 * static_cast<double>(i));
  return u + v > 1 ? t[0] + (1 - u) * (t[1] - t[0]) + (1 - v) * (t[2] - t[0])
                   : t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
}

glm::dvec3 point(const scene::Ellipsoid& ellipsoid, std::size_t i, std::size_t count) {
  const glm::dvec3 unit = scene::even_direction(static_cast<int>(i), static_cast<int>(count));
  glm::dvec3 result = ellipsoid.centre;
  for (int k = 0; k < 3; ++k) result += unit[k] * glm::dvec3(ellipsoid.half_axes[static_cast<std::size_t>(k)]);
  return result;
}

/// Calls triangle(Corners) and ellipsoid(Ellipsoid) for all pieces of the objects.
template <class Triangle, class Ellipsoid>
void for_each_piece(const scene::Scene& scene, const std::vector<std::size_t>& objects, const Triangle& triangle,
                    const Ellipsoid& ellipsoid) {
  const auto place = [&](std::uint32_t vertex) { return glm::dvec3(scene.geometry.positions[vertex]); };
  for (const std::size_t object : objects) {
    for (const glm::uvec3& t : triangles_of(scene, scene.objects[object]))
      triangle(Corners{place(t.x), place(t.y), place(t.z)});
    for (const scene::Ellipsoid& e : ellipsoids_of(scene, scene.objects[object])) ellipsoid(e);
  }
}

} // namespace

std::size_t samples_per_light(std::size_t lights) {
  return std::min(most_samples_of_light, std::bit_floor(most_samples / std::max<std::size_t>(lights, 1)));
}

std::vector<LightSample> sample_lights(const Segmentation& segmentation, const CubeMap& cube) {
  const std::size_t lights = segmentation.lights.size(), count = samples_per_light(lights);
  std::vector<LightSample> samples(count * lights);
  for_blocks(lights, [&](std::size_t i) {
    Sampler(cube, segmentation.lights[i], std::countr_zero(count), samples.data() + count * i);
  });
  return samples;
}

std::vector<glm::dvec3> surface_points(const scene::Scene& scene, const std::vector<std::size_t>& objects,
                                       std::size_t count) {
  double total = 0, before = 0;
  const auto add = [&](const auto& piece) { total += area(piece); };
  for_each_piece(scene, objects, add, add);

  std::vector<glm::dvec3> points;
  // Each count-th part of the area has a point, so small triangles share one.
  const auto points_until = [&](double of_area) {
    before += of_area;
    return static_cast<std::size_t>(std::llround(before / total * static_cast<double>(count)));
  };
  for_each_piece(
      scene, objects,
      [&](const Corners& t) {
        for (const std::size_t end = points_until(area(t)); points.size() < end;)
          points.push_back(point(t, points.size()));
      },
      [&](const scene::Ellipsoid& e) {
        const std::size_t first = points.size(), end = points_until(area(e));
        for (std::size_t i = first; i < end; ++i) points.push_back(point(e, i - first, end - first));
      });
  return points;
}

} // namespace nephroid::environment
