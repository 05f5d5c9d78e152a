// SPDX-License-Identifier: Apache-2.0
// A point that shines into a cone: its intensity there is P / (the cone's solid angle).
#include "kernels/lights/light.h"
#include "kernels/lights/targets.h"
#include "kernels/tracing/world.h"

static inline bool spot_has_places(__global const DeviceLight* light) { return false; }

static inline LightPlace spot_place(const World* world, __global const DeviceLight* light, float2 u) {
  return place_at(light->as.spot.position.xyz, light->as.spot.direction.xyz, light->radiometric);
}

// Whether a unit direction away from a spot lies in its cone. |d - axis|^2 / 2 = 1 - cos keeps narrow cones exact.
static inline bool in_spot(__global const DeviceLight* light, float3 direction) {
  const float3 aside = direction - light->as.spot.direction.xyz;
  return 0.5f * dot(aside, aside) <= light->as.spot.one_minus_cos;
}

static inline float spot_watts(__global const DeviceLight* light, const LightPlace* place, float3 direction,
                               float steradians) {
  return in_spot(light, direction) ? light->radiometric * steradians / light->as.spot.solid_angle : 0.0f;
}

// Whether a light shines on places so small that paths from the eye, which scatter anywhere, rarely end there.
static inline bool is_narrow(__global const DeviceLight* light) {
  return is_light(light, LIGHT_SPOT) && light->as.spot.one_minus_cos < NARROW_SPOT;
}

// Whether the targets fill more than a spot's cone, so that photons are better sent all over that.
static inline bool is_tighter(__global const DeviceLight* light, __global const DeviceTarget* targets) {
  float towards_targets = 0.0f;
  for (int i = 0; i < light->target_count; ++i)
    towards_targets += 2.0f * PI_F * one_minus_cos_of(targets[i].centre_radius, light->as.spot.position.xyz);
  return light->as.spot.solid_angle <= towards_targets;
}

// A photon anywhere in the cone of a spot: every one carries the same.
static inline Emission emit_in_cone(__global const DeviceLight* light, int index, float4 random) {
  Emission emission = {light->as.spot.position.xyz, light->as.spot.direction.xyz, 0.0f, light->radiometric,
                       source_lamp(index)};
  float below;
  float3 aside;
  emission.direction = sample_cone(light->as.spot.direction.xyz, light->as.spot.one_minus_cos, random.y, random.z,
                                   &below, &aside);
  return emission;
}
