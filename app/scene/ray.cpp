// SPDX-License-Identifier: Apache-2.0
#include "scene/ray.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <vector>

namespace nephroid::scene {
namespace {

// The layout of kernels/tracing/bvh.h.
constexpr std::size_t children_per_node = 8, triangles_per_block = 4, floats_per_node = 64, floats_per_block = 40;

/// What waits on the stack: a node or leaf, and how far it is.
struct Waiting {
  double entry = 0;
  int child = 0;
};

class Ray {
public:
  Ray(const glm::dvec3& origin, const glm::dvec3& direction) : origin_(origin)
  {
    const glm::dvec3 a = glm::abs(direction);
    kz_ = a.x > a.y ? (a.x > a.z ? 0 : 2) : (a.y > a.z ? 1 : 2);
    kx_ = (kz_ + 1) % 3;
    ky_ = (kx_ + 1) % 3;
    scale_ = 1 / direction[kz_];
    shear_x_ = direction[kx_] * scale_;
    shear_y_ = direction[ky_] * scale_;
    // Not infinite, so that a ray along a box's side gives no 0 times infinity.
    for (int axis = 0; axis < 3; ++axis) inverse_[axis] = 1 / std::copysign(std::max(a[axis], 1e-300), direction[axis]);
  }

  /// Where the ray enters child i of a node, if it does before t_max; boxes are grown by more than rounding (bvh.cpp).
  bool enters(const float* node, std::size_t i, double t_max, double& entry) const
  {
    double first = 0, last = t_max;
    for (int axis = 0; axis < 3; ++axis) {
      const float* bounds = node + 16 * static_cast<std::size_t>(axis) + i;
      const double low = (bounds[0] - origin_[axis]) * inverse_[axis], high = (bounds[8] - origin_[axis]) * inverse_[axis];
      first = std::max(first, inverse_[axis] < 0 ? high : low);
      last = std::min(last, inverse_[axis] < 0 ? low : high);
    }
    entry = first;
    return first <= last;
  }

  /// Distance of triangle i of a block, not above 0 where the ray does not hit it. The triangle is sheared so that the ray becomes the z
  /// axis; it is hit where the three edge functions have one sign (Woop, Benthin and Wald 2013). Two triangles compute their common edge
  /// from the same numbers.
  double distance(const float* block, std::size_t i) const
  {
    const glm::dvec3 a = sheared(block, 0, i), b = sheared(block, 1, i), c = sheared(block, 2, i);
    const double ea = c.x * b.y - c.y * b.x, eb = a.x * c.y - a.y * c.x, ec = b.x * a.y - b.y * a.x;
    const double det = ea + eb + ec;
    const bool inside = (ea >= 0 && eb >= 0 && ec >= 0) || (ea <= 0 && eb <= 0 && ec <= 0);
    if (!inside || det == 0) return 0;
    return (ea * a.z + eb * b.z + ec * c.z) * scale_ / det;
  }

private:
  glm::dvec3 sheared(const float* block, std::size_t corner, std::size_t i) const
  {
    const auto along = [&](int axis) {
      return block[(3 * corner + static_cast<std::size_t>(axis)) * triangles_per_block + i] - origin_[axis];
    };
    const double z = along(kz_);
    return {along(kx_) - shear_x_ * z, along(ky_) - shear_y_ * z, z};
  }

  glm::dvec3 origin_, inverse_{0};
  int kx_ = 0, ky_ = 1, kz_ = 2; ///< kz: where the direction is largest
  double shear_x_ = 0, shear_y_ = 0, scale_ = 1;
};

void test_leaf(const Bvh& bvh, int leaf, const Ray& ray, const CountsTriangle& counts, double t_max, std::optional<RayHit>& hit)
{
  const int blocks = ~leaf & 15;
  const float* block = bvh.blocks.data() + static_cast<std::size_t>(~leaf >> 4) * floats_per_block;
  for (const float* const end = block + static_cast<std::size_t>(blocks) * floats_per_block; block != end; block += floats_per_block)
    for (std::size_t i = 0; i < triangles_per_block; ++i) {
      const double t = ray.distance(block, i);
      if (!(t > 0 && t <= (hit ? hit->t : t_max))) continue;
      std::uint32_t triangle = 0;
      std::memcpy(&triangle, block + 9 * triangles_per_block + i, sizeof triangle);
      if (hit && t == hit->t && triangle >= hit->triangle) continue;
      if (!counts || counts(triangle)) hit = {t, triangle};
    }
}

/// The children that the ray enters, the nearest on top.
void push_children(const float* node, const Ray& ray, double t_max, std::vector<Waiting>& waiting)
{
  const std::size_t bottom = waiting.size();
  for (std::size_t i = 0; i < children_per_node; ++i) {
    Waiting next;
    if (!ray.enters(node, i, t_max, next.entry)) continue;
    std::memcpy(&next.child, node + 48 + i, sizeof next.child);
    waiting.push_back(next);
  }
  std::sort(waiting.begin() + static_cast<std::ptrdiff_t>(bottom), waiting.end(),
            [](const Waiting& a, const Waiting& b) { return a.entry > b.entry; });
}

} // namespace

std::optional<RayHit> closest_hit(const Bvh& bvh, const glm::dvec3& origin, const glm::dvec3& direction, const CountsTriangle& counts,
                                  double t_max)
{
  const Ray ray(origin, direction);
  std::optional<RayHit> hit;
  std::vector<Waiting> waiting{{0, bvh.root}};
  while (!waiting.empty()) {
    const Waiting next = waiting.back();
    waiting.pop_back();
    const double farthest = hit ? hit->t : t_max;
    if (next.entry > farthest) continue;
    if (next.child < 0)
      test_leaf(bvh, next.child, ray, counts, t_max, hit);
    else
      push_children(bvh.nodes.data() + static_cast<std::size_t>(next.child) * floats_per_node, ray, farthest, waiting);
  }
  return hit;
}

glm::dvec3 even_direction(int i, int count, double turns)
{
  constexpr double pi = std::numbers::pi, golden_angle = pi * 0.7639320225002103; // pi (3 - sqrt 5)
  const double z = 1 - (2 * i + 1.0) / count, phi = i * golden_angle + 2 * pi * turns, r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

} // namespace nephroid::scene
