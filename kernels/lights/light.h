// SPDX-License-Identifier: Apache-2.0
// What the files of lights share: which light it is, a place of one, a photon that begins there.
#include "kernels/lights/light_types.h"
#include "kernels/tracing/frame.h"

// Bit 1 << LIGHT_* for each type that the scene has. The code of other types compiles to nothing.
#ifndef NEPHROID_LIGHT_TYPES
#define NEPHROID_LIGHT_TYPES ((1 << LIGHT_TYPE_COUNT) - 1)
#endif
#define HAS_LIGHTS(type) ((NEPHROID_LIGHT_TYPES >> (type) & 1) != 0)

static inline bool is_light(__global const DeviceLight* light, int type) {
  return HAS_LIGHTS(type) && (NEPHROID_LIGHT_TYPES == 1 << type || light->type == type);
}

// The light that a path carries from a lamp or from a texel of the environment.
typedef struct {
  int light;  // index into the table
  float3 rgb; // environment: how much of each primary's spectrum a photon's power carries; lamps: 1
} Source;

static inline Source source_lamp(int light) {
  const Source lamp = {light, (float3)(1.0f)};
  return lamp;
}

// A light at one of its places, as a photon or a shadow ray sees it.
typedef struct {
  bool is_parallel;  // directional light, whose place is a direction
  float3 position;
  float3 direction;  // unit: the way of parallel light, the axis of a spot, the normal of a surface
  float radiometric; // the light's, if all of it came from there
  float3 rgb;        // of its Source
  int object;        // that it is on, or -1
} LightPlace;

static inline LightPlace place_at(float3 position, float3 direction, float radiometric) {
  const LightPlace place = {false, position, direction, radiometric, (float3)(1.0f), -1};
  return place;
}

static inline LightPlace parallel_light(float3 direction, float radiometric) {
  const LightPlace place = {true, (float3)(0.0f), direction, radiometric, (float3)(1.0f), -1};
  return place;
}

// The power that a surface sends into a small solid angle about a direction, by the cosine law: radiance is power /
// (area pi), and the place uniform, so it is power cos(theta) / pi per steradian.
static inline float watts_of_surface(const LightPlace* place, float3 direction, float steradians) {
  const float cosine = dot(direction, place->direction);
  return cosine > 0.0f ? place->radiometric * cosine / PI_F * steradians : 0.0f;
}

// The part of the way to a lamp on which something may stand: a mesh that shines stands there itself, where single
// precision has it.
#define UP_TO_LAMP (HAS_LIGHTS(LIGHT_MESH) ? 1.0f - 0x1p-18f : 1.0f)
