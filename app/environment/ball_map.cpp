// SPDX-License-Identifier: Apache-2.0
#include "environment/ball_map.h"

#include <cmath>
#include <numbers>

namespace nephroid::environment {

RaysOfHeight ball_rays(double n, int inner_most)
{
  return [n, inner_most](double h) {
    std::vector<optics::BallRay> rays;
    for (int inner = -1; inner <= inner_most; ++inner) rays.push_back(optics::ball_ray(h, n, inner));
    return rays;
  };
}

glm::dvec2 crossing(const optics::BallRay& ray, double r)
{
  const glm::dvec2 from(ray.x, ray.y), way(std::cos(ray.angle), std::sin(ray.angle));
  const double along = glm::dot(from, way);
  return from + (std::sqrt(along * along + r * r - glm::dot(from, from)) - along) * way;
}

std::vector<double> ball_map(const SphereMap& map, const glm::dvec3& light, double r, const RaysOfHeight& rays_of, int rings, int azimuths)
{
  constexpr double pi = std::numbers::pi, size2 = 4; // of a ball of radius 1
  const glm::dvec3 x = glm::normalize(glm::cross(light, std::abs(light.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0))),
                   y = glm::cross(light, x);
  std::vector<double> texels(map.texels());
  for (int i = 0; i < rings; ++i) {
    const double h = (i + 0.5) / rings, power = 2 * pi * h / rings / azimuths; // of 1 W/m^2
    for (const optics::BallRay& ray : rays_of(h)) {
      const glm::dvec2 at = crossing(ray, r);
      for (int k = 0; k < azimuths; ++k) {
        const double azimuth = 2 * pi * (k + 0.5) / azimuths;
        const glm::dvec3 place = at.x * light + at.y * (std::cos(azimuth) * x + std::sin(azimuth) * y);
        texels[map.texel(place)] += power * ray.share / (map.solid_angle() * size2);
      }
    }
  }
  return texels;
}

} // namespace nephroid::environment
