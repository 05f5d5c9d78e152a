// SPDX-License-Identifier: Apache-2.0
#include "tracing/scales.h"

#include "scene/meter.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace nephroid::tracing {

double power_of_two_below(double value) {
  return std::isfinite(value) && value > 0 ? std::exp2(std::floor(std::log2(value))) : 1.0;
}

scene::Sphere scene_bounds(const scene::Scene& scene) {
  const auto [low, high] = box_about(extreme_points(scene.geometry));
  return {0.5f * (low + high), 0.5f * glm::length(high - low)};
}

std::array<glm::vec3, 2> box_about(const std::vector<glm::vec3>& points) {
  glm::vec3 low{0}, high{0};
  for (std::size_t i = 0; i < points.size(); ++i) {
    low = i == 0 ? points[i] : glm::min(low, points[i]);
    high = i == 0 ? points[i] : glm::max(high, points[i]);
  }
  return {low, high};
}

double splat_scale(const scene::Scene& scene, unsigned photons, double watts) {
  const scene::Camera& camera = scene.camera;
  const scene::Sphere bounds = scene_bounds(scene);
  const double distance =
      (camera.orthographic ? 1 : std::max<double>(glm::length(camera.position - bounds.centre), 0.25 * bounds.radius)) *
      scene.metres_per_unit;
  double pixel_area = 4 * camera.tan_x * camera.tan_y / (double(camera.width) * camera.height);
  if (camera.meter)
    pixel_area = std::accumulate(camera.meter->areas.begin(), camera.meter->areas.end(), 0.0) /
                 static_cast<double>(camera.meter->count()) * std::pow(scene.metres_per_unit / distance, 2);
  return power_of_two_below(std::exp2(16) * photons * std::numbers::pi * distance * distance * pixel_area / watts);
}

double energy_scale(double watts) { return power_of_two_below(std::exp2(40) / watts); }

double mean_watts(std::int64_t quanta, double quanta_per_watt, double passes) {
  return passes > 0 ? static_cast<double>(quanta) / (quanta_per_watt * passes) : 0;
}

} // namespace nephroid::tracing
