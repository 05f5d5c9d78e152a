// SPDX-License-Identifier: Apache-2.0
// One ray at a time through the tree of bvh.h. Pictures are traced by kernels/tracing/bvh.h.
#include "scene/ray.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace nephroid::scene {
namespace {

/// What waits on the stack: a node or leaf, and how far it is.
struct StackEntry {
  double entry = 0;
  int child = 0;
};

class Ray {
public:
  Ray(const glm::dvec3& origin, const glm::dvec3& direction) : origin_(origin), direction_(direction) {
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
  bool enters(const float* node, std::size_t i, double t_max, double& entry) const {
    double first = 0, last = t_max;
    for (int axis = 0; axis < 3; ++axis) {
      const float* bounds = node + 16 * static_cast<std::size_t>(axis) + i;
      const double low = (bounds[0] - origin_[axis]) * inverse_[axis],
                   high = (bounds[8] - origin_[axis]) * inverse_[axis];
      first = std::max(first, inverse_[axis] < 0 ? high : low);
      last = std::min(last, inverse_[axis] < 0 ? low : high);
    }
    entry = first;
    return first <= last;
  }

  /// Distance of triangle i of a block, not above 0 where the ray does not hit it. The triangle is sheared so that the
  /// ray becomes the z axis; it is hit where the three edge functions have one sign (Woop, Benthin and Wald 2013). Two
  /// triangles compute their common edge from the same numbers.
  double distance(const float* block, std::size_t i) const {
    const glm::dvec3 a = sheared(block, 0, i), b = sheared(block, 1, i), c = sheared(block, 2, i);
    const double ea = c.x * b.y - c.y * b.x, eb = a.x * c.y - a.y * c.x, ec = b.x * a.y - b.y * a.x;
    const double det = ea + eb + ec;
    const bool inside = (ea >= 0 && eb >= 0 && ec >= 0) || (ea <= 0 && eb <= 0 && ec <= 0);
    if (!inside || det == 0) return 0;
    return (ea * a.z + eb * b.z + ec * c.z) * scale_ / det;
  }

  /// Distance of an ellipsoid, not above 0 where the ray does not hit it; see bvh_ellipsoid in kernels/tracing/bvh.h.
  double distance_of_ellipsoid(const float* data, bool leaves) const {
    const glm::dvec3 to = origin_ - vector(data);
    const double way = -glm::dot(to, direction_) / glm::dot(direction_, direction_);
    const glm::dvec3 nearest = on_unit_sphere(data, to + way * direction_), along = on_unit_sphere(data, direction_);
    const double squared = glm::dot(along, along), rest = -glm::dot(nearest, along) / squared;
    const glm::dvec3 off_centre = nearest + rest * along;
    const double left = 1 - glm::dot(off_centre, off_centre);
    if (!(left > 0)) return 0;
    const double half = std::sqrt(left / squared), middle = way + rest;
    if (leaves) return middle > 0 ? middle + half : 0;
    return middle - half > 0 ? middle - half : middle + half;
  }

private:
  static glm::dvec3 vector(const float* data) { return {data[0], data[1], data[2]}; }
  static glm::dvec3 on_unit_sphere(const float* data, const glm::dvec3& p) {
    return {glm::dot(vector(data + 3), p), glm::dot(vector(data + 6), p), glm::dot(vector(data + 9), p)};
  }

  glm::dvec3 sheared(const float* block, std::size_t corner, std::size_t i) const {
    const auto along = [&](int axis) {
      return block[(3 * corner + static_cast<std::size_t>(axis)) * triangles_per_block + i] - origin_[axis];
    };
    const double z = along(kz_);
    return {along(kx_) - shear_x_ * z, along(ky_) - shear_y_ * z, z};
  }

  glm::dvec3 origin_, direction_, inverse_{0};
  int kx_ = 0, ky_ = 1, kz_ = 2; ///< kz: where the direction is largest
  double shear_x_ = 0, shear_y_ = 0, scale_ = 1;
};

/// What a ray looks for, and what it has found.
struct Search {
  const CountsPrimitive& counts;
  double t_max;
  std::uint32_t leaves;
  std::optional<RayHit> hit;

  double farthest() const { return hit ? hit->t : t_max; }
  void offer(double t, std::uint32_t primitive) {
    if (!(t > 0 && t <= farthest())) return;
    if (hit && t == hit->t && primitive >= hit->primitive) return;
    if (!counts || counts(primitive)) hit = {t, primitive};
  }
};

void test_leaf(const Bvh& bvh, int leaf, const Ray& ray, Search& search) {
  const float* block = bvh.blocks.data() + static_cast<std::size_t>(~leaf >> 4) * floats_per_block;
  const auto number_of = [](const float* at) { return std::bit_cast<std::uint32_t>(*at); };
  for (int blocks = ~leaf & 3; blocks > 0; --blocks, block += floats_per_block)
    for (std::size_t i = 0; i < triangles_per_block; ++i) {
      const float* const number = block + 9 * triangles_per_block + i;
      if (number_of(number) != search.leaves) search.offer(ray.distance(block, i), number_of(number));
    }
  for (int blocks = ~leaf >> 2 & 3; blocks > 0; --blocks, block += floats_per_block)
    for (std::size_t i = 0; i < ellipsoids_per_block; ++i) {
      const float* const data = block + i * floats_per_ellipsoid;
      const std::uint32_t number = number_of(data + 12);
      if (number != no_primitive) search.offer(ray.distance_of_ellipsoid(data, number == search.leaves), number);
    }
}

/// The children that the ray enters, the nearest on top.
void push_children(const float* node, const Ray& ray, double t_max, std::vector<StackEntry>& waiting) {
  const std::size_t bottom = waiting.size();
  for (std::size_t i = 0; i < children_per_node; ++i) {
    StackEntry next;
    if (!ray.enters(node, i, t_max, next.entry)) continue;
    next.child = std::bit_cast<int>(node[48 + i]);
    waiting.push_back(next);
  }
  std::sort(waiting.begin() + static_cast<std::ptrdiff_t>(bottom), waiting.end(),
            [](const StackEntry& a, const StackEntry& b) { return a.entry > b.entry; });
}

} // namespace

std::optional<RayHit> closest_hit(const Bvh& bvh, const glm::dvec3& origin, const glm::dvec3& direction,
                                  const CountsPrimitive& counts, double t_max, std::uint32_t leaves) {
  const Ray ray(origin, direction);
  Search search{counts, t_max, leaves, std::nullopt};
  std::vector<StackEntry> waiting{{0, bvh.root}};
  while (!waiting.empty()) {
    const StackEntry next = waiting.back();
    waiting.pop_back();
    if (next.entry > search.farthest()) continue;
    if (next.child < 0)
      test_leaf(bvh, next.child, ray, search);
    else
      push_children(bvh.nodes.data() + static_cast<std::size_t>(next.child) * floats_per_node, ray, search.farthest(),
                    waiting);
  }
  return search.hit;
}

glm::dvec3 even_direction(int i, int count, double turns) {
  constexpr double pi = std::numbers::pi, golden_angle = pi * 0.7639320225002103; // pi (3 - sqrt 5)
  const double z = 1 - (2 * i + 1.0) / count, phi = i * golden_angle + 2 * pi * turns, r = std::sqrt(1 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

} // namespace nephroid::scene
