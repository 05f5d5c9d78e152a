// SPDX-License-Identifier: Apache-2.0
// The part of the environment's light that reaches what stands around the caustic object, in texels of the cube of
// receivers. Each of the few lights that it is cut into is seen or hidden. The tree is that of the whole scene, because
// light that the object bends belongs to its caustic.
#include "kernels/environment/cube.h"
#include "kernels/environment/render_types.h"
#include "kernels/tracing/work_item.h"
#include "kernels/tracing/path.h"

// The offset of shadow rays from a receiver, as a part of its distance: beyond the rounding of both.
#define OFF_RECEIVER 1e-4f

// facing: from receivers.cl. sky_lights: each light's unit direction, then its flux. parts_seen: [texel][3].
__kernel void shadows(WORLD_ARGUMENTS, __global const uint* list, DeviceTexels slice,
                      __global const float* distances, __global const float4* facing, __global const float4* sky_lights,
                      __global float* parts_seen) {
  const World world = WORLD;
  const uint index = work_item();
  if (index >= slice.count) return;
  const uint texel = list[slice.first + index];
  const float distance = distances[texel];
  if (!(distance < INFINITY)) return;
  const float3 normal = facing[texel].xyz,
               from = slice.middle.xyz +
                      distance * (cube_texel_direction(texel, slice.size) + OFF_RECEIVER * normal);
  float3 all = (float3)(FLT_MIN), seen = all; // not 0, so that the dark is seen in full
  for (int l = 0; l < slice.light_count; ++l) {
    const float3 direction = sky_lights[2 * l].xyz,
                 irradiance = fmax(dot(normal, direction), 0.0f) * sky_lights[2 * l + 1].xyz;
    all += irradiance;
    if (dot(normal, direction) > 0.0f && !is_blocked(&world, from, direction, INFINITY, NEPHROID_NO_PRIMITIVE))
      seen += irradiance;
  }
  vstore3(seen / all, (size_t)texel, parts_seen);
}
