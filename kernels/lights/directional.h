// SPDX-License-Identifier: Apache-2.0
// Parallel light of an irradiance E on a plane that faces it, from a point far away or from a disc.
#include "kernels/lights/light.h"
#include "kernels/tracing/world.h"

// Whether any directional light is a disc, as the sun is.
#ifndef NEPHROID_DISCS
#define NEPHROID_DISCS 1
#endif

static inline bool directional_has_places(__global const DeviceLight* light) {
  return NEPHROID_DISCS && light->as.directional.one_minus_cos > 0.0f;
}

// Directions even over the disc's solid angle.
static inline LightPlace directional_place(const World* world, __global const DeviceLight* light, float2 u) {
  const float3 axis = light->as.directional.direction.xyz;
  if (!directional_has_places(light)) return parallel_light(axis, light->radiometric);
  float3 x, y;
  make_frame(axis, &x, &y);
  const float below = u.x * light->as.directional.one_minus_cos, sine = sqrt(below * (2.0f - below));
  float cosine_phi;
  const float sine_phi = sincos(2.0f * PI_F * u.y, &cosine_phi);
  return parallel_light(normalize(sine * (cosine_phi * x + sine_phi * y) + (1.0f - below) * axis), light->radiometric);
}

static inline float directional_watts(__global const DeviceLight* light, const LightPlace* place, float3 direction,
                                      float steradians) {
  return 0.0f; // sample_towards and emit know light without a place
}
