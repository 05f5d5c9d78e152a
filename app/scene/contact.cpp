// SPDX-License-Identifier: Apache-2.0
// Glass that stands exactly on something else.
#include "scene/place.h"

#include "scene/corners.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace nephroid::scene {
namespace {

/// Of the largest coordinate of the two objects. Rays start 2^-21 of a triangle's coordinates off it (kernels/tracing/surface.h), so this
/// is several times what either side's rays step over.
constexpr double gap_share = 0x1p-18, touching_share = 0x1p-21;

double largest_coordinate(const Bounds& a, const Bounds& b)
{
  double largest = 0;
  for (int k = 0; k < 3; ++k)
    largest = std::max({largest, std::abs(a.low[k]), std::abs(a.high[k]), std::abs(b.low[k]), std::abs(b.high[k])});
  return largest;
}

/// The axis along which a face of `glass` lies in a face of the other's bounds, while they overlap along the other two; -1: none.
int touching_axis(const Bounds& glass, const Bounds& other, double tolerance)
{
  for (int k = 0; k < 3; ++k) {
    bool meets = true;
    for (int j = 0; j < 3; ++j)
      if (j != k) meets = meets && glass.low[j] < other.high[j] + tolerance && other.low[j] < glass.high[j] + tolerance;
    if (!meets) continue;
    for (const double face : {glass.low[k], glass.high[k]})
      for (const double other_face : {other.low[k], other.high[k]})
        if (std::abs(face - other_face) <= tolerance) return k;
  }
  return -1;
}

/// Calls change(coordinate along the axis) for every vertex of the object.
template <class Change>
void change_vertices(Scene& scene, const Object& object, int axis, const Change& change)
{
  std::uint32_t first = ~0u, last = 0;
  for_each_corner_index(scene, object, [&](std::uint32_t vertex) {
    first = std::min(first, vertex);
    last = std::max(last, vertex);
  });
  for (std::uint32_t v = first; v <= last; ++v) {
    float& coordinate = scene.geometry.positions[v][axis];
    coordinate = static_cast<float>(change(coordinate));
  }
}

/// An ellipsoid meets what it touches in one point, where nothing is lost; only two of them can lie in one place.
bool can_coincide(const Object& a, const Bounds& at_a, const Object& b, const Bounds& at_b, double tolerance)
{
  if (a.ellipsoid_count + b.ellipsoid_count == 0) return true;
  bool same = a.ellipsoid_count == b.ellipsoid_count;
  for (int k = 0; k < 3; ++k)
    same = same && std::abs(at_a.low[k] - at_b.low[k]) <= tolerance && std::abs(at_a.high[k] - at_b.high[k]) <= tolerance;
  return same;
}

/// Leaves a gap between the glass and what it touches across the axis: moves every face of it that lies across inwards, or, where it is too
/// thin for that, all of it away from the other's face.
void part(Scene& scene, const Object& glass, const Bounds& bounds, const Bounds& other, int axis, double gap)
{
  const double middle = 0.5 * (bounds.low[axis] + bounds.high[axis]), half = 0.5 * (bounds.high[axis] - bounds.low[axis]);
  const auto distance_of = [&](double face) { return std::min(std::abs(face - other.low[axis]), std::abs(face - other.high[axis])); };
  for (Ellipsoid& ellipsoid : std::span(scene.geometry.ellipsoids).subspan(glass.first_ellipsoid, glass.ellipsoid_count))
    for (glm::vec3& half_axis : ellipsoid.half_axes) half_axis *= static_cast<float>(1 - std::min(gap / half, 0.125));
  if (glass.triangle_count == 0) return;
  if (half >= 8 * gap)
    change_vertices(scene, glass, axis, [&](double at) { return middle + (at - middle) * (1 - gap / half); });
  else {
    const double away = distance_of(bounds.low[axis]) < distance_of(bounds.high[axis]) ? gap : -gap;
    change_vertices(scene, glass, axis, [&](double at) { return at + away; });
  }
}

std::string label(const Scene& scene, std::size_t object)
{
  return scene.objects[object].name.empty() ? fmt::format("object {}", object) : fmt::format("object '{}'", scene.objects[object].name);
}

/// Moved away from one thing onto another: there is no room for it.
void warn_if_between(Scene& scene, const std::vector<Bounds>& bounds, std::size_t i)
{
  for (std::size_t j = 0; j < scene.objects.size(); ++j)
    if (i != j && scene.objects[i].ellipsoid_count + scene.objects[j].ellipsoid_count == 0 &&
        touching_axis(bounds[i], bounds[j], touching_share * largest_coordinate(bounds[i], bounds[j])) >= 0)
      scene.warnings.push_back(fmt::format("{} lies exactly on {} and is too thin to be parted from it: light may be lost between them; "
                                           "move it, make it thicker, or let them overlap",
                                           label(scene, i), label(scene, j)));
}

} // namespace

void part_touching(Scene& scene)
{
  std::vector<Bounds> bounds;
  for (const Object& object : scene.objects) bounds.push_back(bounds_of(scene, object));
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (material_of(scene, scene.objects[i]).type != Material::Type::dielectric) continue;
    for (std::size_t j = 0; j < scene.objects.size(); ++j) {
      if (i == j) continue;
      const double largest = largest_coordinate(bounds[i], bounds[j]), tolerance = touching_share * largest;
      const int axis = touching_axis(bounds[i], bounds[j], tolerance);
      if (axis < 0 || !can_coincide(scene.objects[i], bounds[i], scene.objects[j], bounds[j], tolerance)) continue;
      part(scene, scene.objects[i], bounds[i], bounds[j], axis, gap_share * largest);
      bounds[i] = bounds_of(scene, scene.objects[i]);
      scene.warnings.push_back(
          fmt::format("{} touches {}: a gap of {:.2g} length units is left between them; let them overlap to have none", label(scene, i),
                      label(scene, j), gap_share * largest));
    }
    warn_if_between(scene, bounds, i);
  }
}

} // namespace nephroid::scene
