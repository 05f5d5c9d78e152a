// SPDX-License-Identifier: Apache-2.0
// Properties of a light that both emission and direct light need.
#include "kernels/tracing/frame.h"
#include "kernels/tracing/shared_types.h"

// Bit 1 << LIGHT_* for each type that the scene has. The code of other types compiles to nothing.
#ifndef NEPHROID_LIGHT_TYPES
#define NEPHROID_LIGHT_TYPES ((1 << LIGHT_TYPE_COUNT) - 1)
#endif

// Whether any directional light is a disc (DeviceLight::one_minus_cos), as the sun is.
#ifndef NEPHROID_DISCS
#define NEPHROID_DISCS 1
#endif

static inline bool is_light(const DeviceLight* light, int type) {
  return (NEPHROID_LIGHT_TYPES >> type & 1) != 0 && (NEPHROID_LIGHT_TYPES == 1 << type || light->type == type);
}

// The light that a path carries from a lamp or from a texel of the environment.
typedef struct {
  int light;  // index into the table
  float3 rgb; // environment: how much of each primary's spectrum a photon's power carries; else unused
} Source;

// Whether a unit direction away from a spot lies in its cone. |d - axis|^2 / 2 = 1 - cos keeps narrow cones exact.
static inline bool in_spot(const DeviceLight* light, float3 direction) {
  const float3 aside = direction - light->direction.xyz;
  return 0.5f * dot(aside, aside) <= light->one_minus_cos;
}

// Whether a light shines on places so small that paths from the eye, which scatter anywhere, rarely end there.
static inline bool is_narrow(const DeviceLight* light) {
  return is_light(light, LIGHT_SPOT) && light->one_minus_cos < NARROW_SPOT;
}

// Whether a lamp's light comes from different places: of a surface, or of a disc far away.
static inline bool has_lamp_places(const DeviceLight* light) {
#if NEPHROID_DISCS
  if (is_light(light, LIGHT_DIRECTIONAL) && light->one_minus_cos > 0.0f) return true;
#endif
  return is_light(light, LIGHT_AREA) || is_light(light, LIGHT_MESH);
}

// Whether photons begin at different places: of such a lamp, or in the environment.
static inline bool has_places(const DeviceLight* light) {
  return has_lamp_places(light) || is_light(light, LIGHT_ENVIRONMENT);
}

// The part of the way to a lamp on which something may stand: a mesh that shines stands there itself, where single
// precision has it.
#if NEPHROID_LIGHT_TYPES >> LIGHT_MESH & 1
#define UP_TO_LAMP (1.0f - 0x1p-18f)
#else
#define UP_TO_LAMP 1.0f
#endif

// Light of a disc becomes, in *light, directional light from one place, even over the disc's solid angle.
static inline void choose_in_disc(DeviceLight* light, float2 place) {
#if NEPHROID_DISCS
  if (!is_light(light, LIGHT_DIRECTIONAL) || !(light->one_minus_cos > 0.0f)) return;
  float3 x, y;
  make_frame(light->direction.xyz, &x, &y);
  const float below = place.x * light->one_minus_cos, sine = sqrt(below * (2.0f - below));
  float cosine_phi;
  const float sine_phi = sincos(2.0f * PI_F * place.y, &cosine_phi);
  light->direction.xyz =
      normalize(sine * (cosine_phi * x + sine_phi * y) + (1.0f - below) * light->direction.xyz);
#endif
}

static inline float3 area_point(const DeviceLight* light, float2 place) {
  return light->position.xyz + (place.x - 0.5f) * light->edge_u.xyz + (place.y - 0.5f) * light->edge_v.xyz;
}
