// SPDX-License-Identifier: Apache-2.0
#include "environment/occlusion/occlusion.h"

#include "environment/to_float4.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace nephroid::environment {
namespace {

double sum(const glm::dvec3& v) { return v.x + v.y + v.z; }

/// The number of one of a light's 2^cuts cells. They are numbered by cuts into halves, mostly across and down in turn, so the bits of a
/// place in a square, taken in turn, say which one lies there. The places are Roberts' sequence R2 (2018), steps of 1/p and 1/p^2 with
/// p^3 = p + 1: as even in the plane as steps of the golden ratio are on a line. Each light begins elsewhere.
std::size_t drawn_cell(std::uint64_t pass, std::size_t light, int cuts)
{
  const auto number = static_cast<double>(light);
  double place[2] = {std::fmod(0.7548776662466927 * static_cast<double>(pass) + 0.5545497 * number, 1.0),
                     std::fmod(0.5698402909980532 * static_cast<double>(pass) + 0.308517 * number, 1.0)};
  std::size_t cell = 0;
  for (int i = 0; i < cuts; ++i) {
    double& next = place[i % 2];
    next *= 2;
    const bool upper = next >= 1;
    if (upper) next -= 1;
    cell = 2 * cell + (upper ? 1 : 0);
  }
  return cell;
}

} // namespace

std::vector<VisibleLight> whole_lights(const Segmentation& segmentation)
{
  std::vector<VisibleLight> lights;
  for (const Region& region : segmentation.lights) lights.push_back({region.flux, region.direction, region.spread_deg});
  return lights;
}

Occlusion::Occlusion(const compute::Context& context, const Segmentation& segmentation, const CubeMap& cube)
    : whole_(whole_lights(segmentation)), samples_(sample_lights(segmentation, cube)), is_seen_(samples_.size(), 1),
      seen_counts_(whole_.size(), samples_per_light(whole_.size()))
{
  std::vector<shared::float4> directions;
  for (const LightSample& sample : samples_) directions.push_back(to_float4(sample.direction));
  directions_ = tracing::upload_vector(context, "directions of the environment's light", directions);
}

std::vector<VisibleLight> Occlusion::visible_lights(tracing::World& surroundings, double rotate_deg, const std::vector<glm::dvec3>& from)
{
  const bool empty = surroundings.buffers.object_of_primitive.size() == 0;
  is_seen_ =
      empty || whole_.empty() ? std::vector<std::uint8_t>(samples_.size(), 1) : sight_.free(surroundings, directions_, rotate_deg, from);
  const std::size_t samples = samples_per_light(whole_.size());
  std::vector<VisibleLight> visible = whole_;
  for (std::size_t light = 0; light < visible.size(); ++light) {
    glm::dvec3 flux(0), all(0), hidden(0);
    seen_counts_[light] = 0;
    for (std::size_t i = samples * light; i < samples * (light + 1); ++i) {
      const LightSample& sample = samples_[i];
      const glm::dvec3 way = sum(sample.flux) * sample.direction;
      all += way;
      if (is_seen_[i]) {
        flux += sample.flux;
        ++seen_counts_[light];
      } else
        hidden += way;
    }
    if (hidden == glm::dvec3(0)) continue;
    VisibleLight& left = visible[light];
    left.flux = glm::min(flux, left.flux);
    // The samples' mean stands for the region's only nearly. So the difference that hiding makes is added to the region's own direction.
    const glm::dvec3 shift =
        all - hidden != glm::dvec3(0) && flux != glm::dvec3(0) ? glm::normalize(all - hidden) - glm::normalize(all) : glm::dvec3(0);
    left.direction = glm::normalize(left.direction + shift);
  }
  return visible;
}

std::vector<VisibleLight> Occlusion::drawn_lights(std::uint32_t pass) const
{
  const std::size_t samples = samples_per_light(whole_.size());
  std::vector<VisibleLight> drawn;
  for (std::size_t light = 0; light < whole_.size(); ++light) {
    if (seen_counts_[light] == 0) {
      drawn.push_back({glm::dvec3(0), whole_[light].direction});
      continue;
    }
    // Others while what is drawn is hidden: the sequence meets every cell. All cells have the same light.
    std::size_t i = 0;
    for (std::uint64_t number = pass;; number += 1U << 20) {
      i = samples * light + drawn_cell(number, light, std::countr_zero(samples));
      if (is_seen_[i] != 0) break;
    }
    drawn.push_back({static_cast<double>(seen_counts_[light]) * samples_[i].flux, samples_[i].direction});
  }
  return drawn;
}

std::vector<std::uint8_t> Sight::free(tracing::World& surroundings, const compute::Buffer<shared::float4>& directions, double rotate_deg,
                                      const std::vector<glm::dvec3>& from)
{
  if (!kernel_.state || defines_ != surroundings.defines) {
    kernel_ = compute::Program(surroundings.context, "environment/visible.cl", surroundings.defines).kernel("visible");
    defines_ = surroundings.defines;
  }
  if (seen_.size() != directions.size())
    seen_ = compute::Buffer<std::uint8_t>(surroundings.context, "what is seen of the environment", directions.size());
  std::vector<shared::float4> points;
  for (const glm::dvec3& point : from) points.push_back(to_float4(point));
  const auto count = static_cast<std::uint32_t>(directions.size());
  surroundings.run(kernel_, count, 64,
                   {{"directions", directions},
                    {"seen", seen_},
                    {"count", count},
                    {"points", tracing::upload_vector(surroundings.context, "points that look at the environment", points)},
                    {"last_point", static_cast<std::uint32_t>(points.size() - 1)},
                    {"turned_x", to_float4(turned({1, 0, 0}, rotate_deg))},
                    {"turned_z", to_float4(turned({0, 0, 1}, rotate_deg))}});
  return seen_.read();
}

} // namespace nephroid::environment
