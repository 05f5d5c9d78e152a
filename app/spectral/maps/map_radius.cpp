// SPDX-License-Identifier: Apache-2.0
#include "spectral/maps/map_radius.h"

#include "spectral/tables/scales.h"

#include <algorithm>
#include <cmath>

namespace nephroid::spectral {

double first_map_radius(const preset::Spectral& settings, const scene::Scene& scene)
{
  if (settings.sppm.radius) return *settings.sppm.radius;
  const scene::Sphere bounds = scene_bounds(scene);
  const double distance = std::max<double>(glm::length(scene.camera.position - bounds.centre), 0.25 * bounds.radius);
  return 2 * (2 * distance * scene.camera.tan_y / scene.camera.height);
}

double map_radius_factor(std::int64_t pass, double alpha)
{
  // The product of (k + alpha) / (k + 1) over k = 1 .. pass is Gamma(pass + 1 + alpha) / Gamma(1 + alpha) / Gamma(pass + 2).
  const auto p = static_cast<double>(pass);
  return std::exp(0.5 * (std::lgamma(p + 1 + alpha) - std::lgamma(1 + alpha) - std::lgamma(p + 2)));
}

} // namespace nephroid::spectral
