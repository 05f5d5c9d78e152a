// SPDX-License-Identifier: Apache-2.0
// Visibility of the environment's directions from points of the object (Algorithm 3.4 of the thesis).
#include "kernels/tracing/work_item.h"
#include "kernels/tracing/path.h"

// directions: unit, in the map before it is turned. points: their number is a power of 2. Neighbouring cells of a light
// are tested from points that are far apart: an odd step near the golden ratio of 1024 meets each point once. turned_x,
// turned_z: where the turn takes +x and +z; +y stays.
__kernel void visible(WORLD_ARGUMENTS, __global const float4* directions, __global uchar* seen, uint count,
                      __global const float4* points, uint last_point, float4 turned_x, float4 turned_z) {
  const uint i = work_item();
  if (i >= count) return;
  const World world = WORLD;
  const float3 d = directions[i].xyz, direction = d.x * turned_x.xyz + (float3)(0.0f, d.y, 0.0f) + d.z * turned_z.xyz;
  seen[i] = !is_blocked(&world, points[i * 633u & last_point].xyz, direction, INFINITY, NEPHROID_NO_PRIMITIVE);
}
