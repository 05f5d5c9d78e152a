// SPDX-License-Identifier: Apache-2.0
#include "environment/occlusion/occlusion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace nephroid::environment {
namespace {

shared::float4 to_float4(const glm::dvec3& v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0}; }

} // namespace

Occlusion::Occlusion(const compute::Context& context, const Segmentation& segmentation, const CubeMap& cube)
{
  std::vector<shared::float4> directions;
  for (const Region& light : segmentation.lights) light_flux_.push_back(light.flux);
  for (const LightSample& sample : sample_lights(segmentation, cube)) {
    directions.push_back(to_float4(sample.direction));
    sample_flux_.push_back(sample.flux);
  }
  directions_ = tracing::upload_vector(context, "directions of the environment's light", directions);
  seen_ = compute::Buffer<std::uint8_t>(context, "what is seen of the environment", directions.size());
}

std::vector<glm::dvec3> Occlusion::visible_flux(tracing::World& surroundings, double rotate_deg, const glm::dvec3& from)
{
  const bool empty = surroundings.buffers.object_of_primitive.size() == 0;
  if (empty || light_flux_.empty()) return light_flux_;
  const std::vector<std::uint8_t> seen = trace(surroundings, rotate_deg, from);
  const std::size_t samples = samples_per_light(light_flux_.size());
  std::vector<glm::dvec3> flux;
  for (std::size_t light = 0; light < light_flux_.size(); ++light) {
    glm::dvec3 sum(0);
    bool whole = true;
    for (std::size_t i = samples * light; i < samples * (light + 1); ++i)
      if (seen[i])
        sum += sample_flux_[i];
      else
        whole = false;
    flux.push_back(whole ? light_flux_[light] : glm::min(sum, light_flux_[light]));
  }
  return flux;
}

std::vector<std::uint8_t> Occlusion::trace(tracing::World& surroundings, double rotate_deg, const glm::dvec3& from)
{
  if (!kernel_.state || defines_ != surroundings.defines) {
    kernel_ = compute::Program(surroundings.context, "environment/visible.cl", surroundings.defines).kernel("visible");
    defines_ = surroundings.defines;
  }
  const auto count = static_cast<std::uint32_t>(directions_.size());
  surroundings.run(kernel_, count, 64,
                   {{"directions", directions_},
                    {"seen", seen_},
                    {"count", count},
                    {"from", to_float4(from)},
                    {"turned_x", to_float4(turned({1, 0, 0}, rotate_deg))},
                    {"turned_z", to_float4(turned({0, 0, 1}, rotate_deg))}});
  return seen_.read();
}

} // namespace nephroid::environment
