// SPDX-License-Identifier: Apache-2.0
#include "spectral/sampled_pixels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace nephroid::spectral {
namespace {

/// A place as the camera sees it: x and y in pixels, times z; z along the view.
using Seen = glm::dvec3;

class Marks {
public:
  explicit Marks(const scene::Camera& camera) : camera_(camera), marked_(camera.pixels()) {}

  Seen see(const glm::dvec3& place) const
  {
    const glm::dvec3 way = place - glm::dvec3(camera_.position);
    const double z = glm::dot(way, glm::dvec3(camera_.forward)), x = glm::dot(way, glm::dvec3(camera_.right)) / camera_.tan_x,
                 y = glm::dot(way, glm::dvec3(camera_.up)) / camera_.tan_y;
    return {(x + z) / 2 * camera_.width, (z - y) / 2 * camera_.height, z};
  }

  /// Marks, row by row, what lies between the sides of a triangle, and what its outline touches.
  void mark(const std::array<Seen, 3>& corners)
  {
    // The part before the eye; what is nearer than a ten thousandth of the farthest corner is as good as beside it.
    const double farthest = std::max({corners[0].z, corners[1].z, corners[2].z}), near = 1e-4 * farthest;
    if (!(farthest > 0)) return;
    points_.clear();
    for (std::size_t i = 0; i < 3; ++i) {
      const Seen &a = corners[i], &b = corners[(i + 1) % 3];
      if (a.z >= near) points_.push_back(a);
      if ((a.z >= near) != (b.z >= near)) points_.push_back(a + (near - a.z) / (b.z - a.z) * (b - a));
    }
    for (Seen& p : points_) p = {p.x / p.z, p.y / p.z, 1};
    const auto [top, bottom] = std::minmax_element(points_.begin(), points_.end(), [](const Seen& a, const Seen& b) { return a.y < b.y; });
    for (int row = index(top->y - margin, camera_.height); row <= index(bottom->y + margin, camera_.height); ++row) mark_row(row);
  }

  /// The same of an ellipsoid: of a ball of triangles just outside of it. Facets of 1/32 of a turn each way come within cos^2(pi / 32) =
  /// 0.9904 of their corners' distance to the middle.
  void mark(const scene::Ellipsoid& ellipsoid)
  {
    constexpr int around = 32;
    constexpr double angle = 2 * std::numbers::pi / around, scale = 1.01;
    const auto corner = [&](int ring, int i) {
      const double polar = ring * angle, turn = i * angle;
      glm::dvec3 place = ellipsoid.centre;
      place += scale * std::cos(polar) * glm::dvec3(ellipsoid.half_axes[1]);
      place += scale * std::sin(polar) * std::cos(turn) * glm::dvec3(ellipsoid.half_axes[0]);
      return see(place + scale * std::sin(polar) * std::sin(turn) * glm::dvec3(ellipsoid.half_axes[2]));
    };
    for (int ring = 0; ring < around / 2; ++ring)
      for (int i = 0; i < around; ++i) {
        mark(std::array{corner(ring, i), corner(ring + 1, i), corner(ring + 1, i + 1)});
        mark(std::array{corner(ring, i), corner(ring + 1, i + 1), corner(ring, i + 1)});
      }
  }

  const std::vector<bool>& marked() const { return marked_; }

private:
  /// Single precision decides which pixel a path is of.
  static constexpr double margin = 0.01;

  static int index(double at, int size) { return static_cast<int>(std::clamp(std::floor(at), 0.0, size - 1.0)); }

  /// What of the outline lies within the row's height, from the leftmost to the rightmost.
  void mark_row(int row)
  {
    const double top = row - margin, bottom = row + 1 + margin;
    double left = std::numeric_limits<double>::max(), right = std::numeric_limits<double>::lowest();
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Seen &a = points_[i], &b = points_[(i + 1) % points_.size()];
      if (std::max(a.y, b.y) < top || std::min(a.y, b.y) > bottom) continue;
      for (const double y : {std::clamp(a.y, top, bottom), std::clamp(b.y, top, bottom)}) {
        const double x = a.y == b.y ? (y == a.y ? a.x : b.x) : a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
        left = std::min({left, x, a.y == b.y ? b.x : x});
        right = std::max({right, x, a.y == b.y ? b.x : x});
      }
    }
    if (right + margin < 0 || left - margin > camera_.width) return;
    const auto first = static_cast<std::ptrdiff_t>(row) * camera_.width;
    std::fill(marked_.begin() + first + index(left - margin, camera_.width),
              marked_.begin() + first + index(right + margin, camera_.width) + 1, true);
  }

  const scene::Camera& camera_;
  std::vector<bool> marked_;
  std::vector<Seen> points_;
};

} // namespace

std::vector<std::uint32_t> glass_pixels(const scene::Scene& scene)
{
  Marks marks(scene.camera);
  for (const scene::Object& object : scene.objects) {
    if (material_of(scene, object).type == scene::Material::Type::diffuse) continue;
    for (const glm::uvec3& triangle : scene::triangles_of(scene, object)) {
      std::array<Seen, 3> corners;
      for (int c = 0; c < 3; ++c) corners[static_cast<std::size_t>(c)] = marks.see(scene.geometry.positions[triangle[c]]);
      marks.mark(corners);
    }
    for (const scene::Ellipsoid& ellipsoid : scene::ellipsoids_of(scene, object)) marks.mark(ellipsoid);
  }
  std::vector<std::uint32_t> pixels;
  for (std::size_t i = 0; i < marks.marked().size(); ++i)
    if (marks.marked()[i] || !scene.camera.inside.empty()) pixels.push_back(static_cast<std::uint32_t>(i));
  return pixels;
}

} // namespace nephroid::spectral
