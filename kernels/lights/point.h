// SPDX-License-Identifier: Apache-2.0
// A point, which shines evenly: its intensity is P / (4 pi). With photometry it is so in the mean over directions.
#include "kernels/lights/light.h"
#include "kernels/tracing/world.h"

// 1: some point has photometry.
#ifndef NEPHROID_PHOTOMETRY
#define NEPHROID_PHOTOMETRY 0
#endif

static inline bool point_has_places(__global const DeviceLight* light) { return false; }

static inline LightPlace point_place(const World* world, __global const DeviceLight* light, float2 u) {
  return place_at(light->as.point.position.xyz, (float3)(0.0f), light->radiometric);
}

static inline float point_watts(__global const DeviceLight* light, const LightPlace* place, float3 direction,
                                float steradians) {
  return light->radiometric * steradians / (4.0f * PI_F);
}

// A point's intensity in a unit direction away from it, over the mean of all directions; 1 of other lights.
static inline float photometric(const World* world, __global const DeviceLight* light, float3 direction) {
  if (!NEPHROID_PHOTOMETRY || !is_light(light, LIGHT_POINT) || light->table < 0) return 1.0f;
  const float along = dot(direction, light->as.point.direction.xyz), x = dot(direction, light->as.point.c_0.xyz),
              y = dot(direction, light->as.point.c_90.xyz), turns = atan2(y, x) / (2.0f * PI_F);
  const float gamma = atan2(sqrt(x * x + y * y), along) / PI_F * (float)(PHOTOMETRY_GAMMAS - 1),
              c = (turns - floor(turns)) * (float)(PHOTOMETRY_PLANES - 1);
  const int step = clamp((int)gamma, 0, PHOTOMETRY_GAMMAS - 2), plane = clamp((int)c, 0, PHOTOMETRY_PLANES - 2);
  __global const float* near = world->lamp_tables + light->table + plane * PHOTOMETRY_GAMMAS + step;
  const float2 low = vload2(0, near), high = vload2(0, near + PHOTOMETRY_GAMMAS);
  const float2 mixed = mix(low, high, c - (float)plane);
  return mix(mixed.x, mixed.y, gamma - (float)step);
}
