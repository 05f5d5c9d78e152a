// SPDX-License-Identifier: Apache-2.0
// The environment as one of the lights: parallel light from a direction drawn by its flux, or by its peaks (sky.h).
// What is seen of it is in background.h.
#include "kernels/lights/light.h"
#include "kernels/lights/sky.h"
#include "kernels/tracing/world.h"

// 1: paths from the eye find the even light of the environment where glass sends it (sky.h), and photons only its
// peaks.
#ifndef NEPHROID_EVEN_SKY
#define NEPHROID_EVEN_SKY 0
#endif

static inline bool is_of_environment(const World* world, int light) {
  return HAS_LIGHTS(LIGHT_ENVIRONMENT) && world->lights[light].type == LIGHT_ENVIRONMENT;
}

static inline bool environment_has_places(__global const DeviceLight* light) { return true; }

static inline LightPlace environment_place(const World* world, __global const DeviceLight* light, float2 u) {
#if NEPHROID_EVEN_SKY
  const SkyPlace from = sample_sky(&world->sky, cdf_of_peaks(&world->sky), u);
  const float3 rgb = from.rgb * (from.density * (1.0f - even_part(&from)) / from.peak_density);
#else
  const SkyPlace from = sample_sky(&world->sky, world->sky.texel_cdf, u);
  const float3 rgb = from.rgb;
#endif
  LightPlace place = parallel_light(-from.direction, light->radiometric);
  place.rgb = rgb;
  return place;
}

static inline float environment_watts(__global const DeviceLight* light, const LightPlace* place, float3 direction,
                                      float steradians) {
  return 0.0f; // as directional_watts
}

// A source with the light's mean colour.
static inline Source mean_source(const World* world, int index) {
  Source source = source_lamp(index);
  if (is_of_environment(world, index)) source.rgb = world->lights[index].as.environment.mean_colour.xyz;
  return source;
}
