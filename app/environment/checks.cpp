// SPDX-License-Identifier: Apache-2.0
#include "environment/checks.h"

#include "environment/bake/baker.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::environment {
namespace {

preset::Preset ball_preset(std::uint64_t seed) {
  preset::Preset preset;
  preset.settings = preset::Settings(settings_type());
  preset.seed = seed;
  preset::Material& glass = preset.scene.materials["glass"];
  glass.type = preset::Material::Type::dielectric;
  glass.dispersion.n = 1.5;
  preset::Object ball;
  ball.name = "ball";
  ball.material = "glass";
  ball.shape.emplace().radius = 1;
  preset.scene.objects = {ball};
  Settings& s = settings(preset);
  s.spheres = 3;
  s.resolution = 24;
  s.photons = 1 << 18;
  return preset;
}

/// Checks the bright spot behind the ball, its rim and its reflections: near the ball, where rays cross, and far away.
check::Result ball_in_parallel_light(const compute::Context& context, std::uint64_t seed) {
  const glm::dvec3 light = glm::normalize(glm::dvec3(0.3, -0.8, 0.5));
  BakeTask task = make_task(ball_preset(seed));
  task.directions = {light};
  Baker baker(task, context);
  while (!baker.finished()) baker.advance();
  const Bake& bake = baker.bake();
  double farthest = 0;
  for (std::size_t sphere = 0; sphere < bake.radii.size(); ++sphere) {
    const std::vector<double> expected = ball_map(bake.map, light, bake.radii[sphere], ball_rays(1.5), 400, 360);
    double difference = 0, length = 0;
    for (std::size_t t = 0; t < expected.size(); ++t) {
      difference += std::pow(bake.at(0, sphere, t).x - expected[t], 2);
      length += expected[t] * expected[t];
    }
    farthest = std::max(farthest, std::sqrt(difference / length));
  }
  return check::judged(100 * farthest, 2, "%",
                       "irradiance on spheres about a glass ball against the integral over rays by Snell and Fresnel");
}

} // namespace

RaysOfHeight ball_rays(double n, int inner_most) {
  return [n, inner_most](double h) {
    std::vector<optics::BallRay> rays;
    for (int inner = -1; inner <= inner_most; ++inner) rays.push_back(optics::ball_ray(h, n, inner));
    return rays;
  };
}

glm::dvec2 crossing(const optics::BallRay& ray, double r) {
  const glm::dvec2 from(ray.x, ray.y), way(std::cos(ray.angle), std::sin(ray.angle));
  const double along = glm::dot(from, way);
  return from + (std::sqrt(along * along + r * r - glm::dot(from, from)) - along) * way;
}

std::vector<double> ball_map(const SphereMap& map, const glm::dvec3& light, double r, const RaysOfHeight& rays_of,
                             int rings, int azimuths) {
  constexpr double pi = std::numbers::pi, size2 = 4; // for a ball of radius 1
  const glm::dvec3 x = glm::normalize(
                       glm::cross(light, std::abs(light.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0))),
                   y = glm::cross(light, x);
  std::vector<double> texels(map.texels());
  for (int i = 0; i < rings; ++i) {
    const double h = (i + 0.5) / rings, power = 2 * pi * h / rings / azimuths; // for 1 W/m^2
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

check::Checks closed_forms() { return {{"caustic spheres: a glass ball in parallel light", ball_in_parallel_light}}; }

} // namespace nephroid::environment
