// SPDX-License-Identifier: Apache-2.0
// Engine 2's closed forms, for `nephroid check`.
#include "environment/bake/baker.h"
#include "environment/ball_map.h"
#include "environment/engine.h"

#include <algorithm>
#include <cmath>

namespace nephroid::environment {
namespace {

preset::Preset ball_preset(std::uint64_t seed)
{
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

/// The bright spot behind the ball, its rim, what it reflects: near the ball, where rays cross, and far away.
check::Result ball_in_parallel_light(const compute::Context& context, std::uint64_t seed)
{
  const glm::dvec3 light = glm::normalize(glm::dvec3(0.3, -0.8, 0.5));
  BakeTask task = make_task(ball_preset(seed));
  task.directions = {light};
  Baker baker(task, context);
  while (!baker.finished()) baker.step();
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
  return judged(100 * farthest, 2, "%", "irradiance on spheres about a glass ball against the integral over rays by Snell and Fresnel");
}

} // namespace

std::vector<check::Check> closed_forms() { return {{"caustic spheres: a glass ball in parallel light", ball_in_parallel_light}}; }

} // namespace nephroid::environment
