// SPDX-License-Identifier: Apache-2.0
// The map of a caustic sphere: a square whose texels all have the same solid angle, by the octahedral map of Clarberg
// (2008, "Fast equal-area mapping of the (hemi)sphere using SIMD"). app/environment/bake/bake.h has the same in double.
#include "kernels/tracing/frame.h"

// The texel of a direction, row after row, in a map of side x side texels. direction: any length but 0.
static inline int sphere_texel(float3 direction, int side) {
  const float3 d = fabs(direction) / length(direction);
  // sqrt(1 - |z|) without its cancellation near the poles.
  const float r = sqrt((d.x * d.x + d.y * d.y) / (1.0f + d.z));
  const float v = r * atan2(d.y, d.x) * (2.0f / PI_F), u = r - v;
  const float2 folded = direction.z < 0.0f ? (float2)(1.0f - v, 1.0f - u) : (float2)(u, v);
  const float2 place = (0.5f + 0.5f * copysign(folded, direction.xy)) * (float)side;
  const int column = clamp((int)place.x, 0, side - 1), row = clamp((int)place.y, 0, side - 1);
  return row * side + column;
}

// The unit direction of a texel's middle.
static inline float3 sphere_direction(int texel, int side) {
  const float2 place = ((float2)((float)(texel % side), (float)(texel / side)) + 0.5f) * (2.0f / (float)side) - 1.0f,
               size = fabs(place);
  const float height = 1.0f - size.x - size.y, r = 1.0f - fabs(height); // above 0: the upper half
  const float azimuth = r > 0.0f ? ((size.y - size.x) / r + 1.0f) * (0.25f * PI_F) : 0.0f;
  const float sine = r * sqrt(2.0f - r * r);
  return (float3)(copysign((float2)(cos(azimuth) * sine, sin(azimuth) * sine), place), copysign(1.0f - r * r, height));
}
