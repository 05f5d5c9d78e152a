// SPDX-License-Identifier: Apache-2.0
#include "meters/in_picture.h"

#include "base/parallel.h"
#include "scene/ray.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid::meters {
namespace {

int cell_at(const scene::MeterSurface& meter, const scene::MeterChart& chart, const glm::dvec3& place) {
  const double x = (glm::dot(place, chart.right) - chart.left) / chart.cell_width,
               y = (chart.top - glm::dot(place, chart.up)) / chart.cell_height;
  if (!(x >= 0 && y >= 0 && x < chart.columns && y < chart.rows)) return -1;
  return meter.cells[chart.first + chart.place(static_cast<int>(y), static_cast<int>(x))];
}

glm::dvec3 normal_of(const scene::Scene& scene, std::uint32_t primitive, const glm::dvec3& place) {
  const scene::Mesh& mesh = scene.geometry;
  if (primitive < mesh.triangles.size()) {
    const glm::uvec3 corner = mesh.triangles[primitive];
    const glm::dvec3 a(mesh.positions[corner.x]), b(mesh.positions[corner.y]), c(mesh.positions[corner.z]);
    return glm::normalize(glm::cross(b - a, c - a));
  }
  const scene::Ellipsoid& ellipsoid = mesh.ellipsoids[primitive - mesh.triangles.size()];
  glm::dvec3 normal(0);
  for (const glm::vec3& axis : ellipsoid.half_axes) {
    const glm::dvec3 half(axis);
    normal += glm::dot(place - glm::dvec3(ellipsoid.centre), half) / std::pow(glm::dot(half, half), 2) * half;
  }
  return glm::normalize(normal);
}

/// As kernels/tracing/meter.h has it for photons.
int cell_met(const scene::MeterSurface& meter, const glm::dvec3& place, const glm::dvec3& normal,
             const glm::dvec3& way) {
  if (glm::any(glm::lessThan(place, meter.low)) || glm::any(glm::greaterThan(place, meter.high)) ||
      glm::dot(normal, meter.facing) < meter.least_cosine)
    return -1;
  const glm::dvec3 sizes = glm::abs(normal);
  for (const scene::MeterChart& chart : meter.charts) {
    const double faces = glm::dot(normal, chart.normal());
    if (meter.is_flat ? std::abs(faces) < 0.5 : faces < std::max({sizes.x, sizes.y, sizes.z})) continue;
    return glm::dot(way, meter.is_flat ? chart.normal() : normal) < 0 ? cell_at(meter, chart, place) : -1;
  }
  return -1;
}

int cell_crossed(const scene::MeterSurface& meter, const glm::dvec3& eye, const glm::dvec3& way, double most) {
  for (const scene::MeterChart& chart : meter.charts) {
    const double at = (chart.height - glm::dot(eye, chart.normal())) / glm::dot(way, chart.normal());
    if (!(at > 0 && at <= most)) continue;
    if (const int cell = cell_at(meter, chart, eye + at * way); cell >= 0) return cell;
  }
  return -1;
}

} // namespace

std::vector<int> cells_in_picture(const scene::Scene& scene, const scene::Bvh& bvh, const scene::MeterSurface& meter) {
  const scene::Camera& camera = scene.camera;
  if (camera.receiver >= 0 || meter.is_goniometer()) return {};
  std::vector<int> cells(camera.pixels(), -1);
  for_ranges(cells.size(), static_cast<std::size_t>(camera.width), [&](std::size_t row, Range pixels) {
    for (std::size_t i = pixels.begin; i < pixels.end; ++i) {
      const double x = 2 * (static_cast<double>(i - pixels.begin) + 0.5) / camera.width - 1,
                   y = 1 - 2 * (static_cast<double>(row) + 0.5) / camera.height;
      const auto [eye, way] = camera.ray(x, y);
      const std::optional<scene::RayHit> hit = scene::closest_hit(bvh, eye, way);
      if (meter.object < 0)
        cells[i] = cell_crossed(meter, eye, way, hit ? hit->t * (1 + 1e-6) : std::numeric_limits<double>::infinity());
      else if (hit && static_cast<int>(scene.object_of_primitive[hit->primitive]) == meter.object) {
        const glm::dvec3 place = eye + hit->t * way;
        cells[i] = cell_met(meter, place, normal_of(scene, hit->primitive, place), way);
      }
    }
  });
  return cells;
}

} // namespace nephroid::meters
