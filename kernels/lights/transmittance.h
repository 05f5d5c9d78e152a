// SPDX-License-Identifier: Apache-2.0
// The part of the light of all lamps that a path leaves, where it is not known which of their wavelengths there is.
#include "kernels/lights/lights.h"

// The factors of X, Y and Z of light that a reflector sends: the mean over the wavelengths that the path stands for,
// weighted by the lamps as the reflector sends them. It is exact where nothing has coloured their light before.
static inline float3 transmittance(const World* world, const Throughput* throughput, const Band* band,
                                   Reflector reflector) {
  const Throughput full = full_throughput();
  float3 left = (float3)(0.0f), all = (float3)(0.0f);
  for (int l = 0; l < world->scene.light_count; ++l) {
    left += world->lights[l].radiometric * carried_light(world, throughput, mean_source(world, l), band, reflector).xyz;
    all += world->lights[l].radiometric * carried_light(world, &full, mean_source(world, l), band, reflector).xyz;
  }
  return select((float3)(0.0f), left / all, all > 0.0f);
}
