// SPDX-License-Identifier: Apache-2.0
#include "tracing/scales.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::tracing {

double power_of_two_below(double value) { return std::isfinite(value) && value > 0 ? std::exp2(std::floor(std::log2(value))) : 1.0; }

scene::Sphere scene_bounds(const scene::Scene& scene)
{
  glm::vec3 low{0}, high{0};
  const std::vector<glm::vec3> points = extreme_points(scene.geometry);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::vec3& p = points[i];
    low = i == 0 ? p : glm::min(low, p);
    high = i == 0 ? p : glm::max(high, p);
  }
  return {0.5f * (low + high), 0.5f * glm::length(high - low)};
}

double splat_scale(const scene::Scene& scene, unsigned photons, double watts)
{
  const scene::Camera& camera = scene.camera;
  const scene::Sphere bounds = scene_bounds(scene);
  const double distance = std::max<double>(glm::length(camera.position - bounds.centre), 0.25 * bounds.radius) * scene.metres_per_unit;
  const double pixel_area = 4 * camera.tan_x * camera.tan_y / (double(camera.width) * camera.height);
  return power_of_two_below(std::exp2(16) * photons * std::numbers::pi * distance * distance * pixel_area / watts);
}

double energy_scale(double watts) { return power_of_two_below(std::exp2(40) / watts); }

double mean_watts(std::int64_t quanta, double quanta_per_watt, double passes)
{
  return passes > 0 ? static_cast<double>(quanta) / (quanta_per_watt * passes) : 0;
}

} // namespace nephroid::tracing
