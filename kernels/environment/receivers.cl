// SPDX-License-Identifier: Apache-2.0
// What stands around the caustic object: the distance from the object's middle to the first surface, in texels of a
// cube that some path needs, and its unit normal on the middle's side. The tree is without the object.
#include "kernels/environment/cube.h"
#include "kernels/environment/render_types.h"
#include "kernels/tracing/work_item.h"
#include "kernels/tracing/world.h"

// list: texels. distances: [texel]: INFINITY where there is nothing.
__kernel void receivers(WORLD_ARGUMENTS, __global const uint* list, DeviceTexels slice,
                        __global float* distances, __global float4* facing) {
  const World world = WORLD;
  const uint index = work_item();
  if (index >= slice.count) return;
  const uint texel = list[slice.first + index];
  const float3 direction = cube_texel_direction(texel, slice.size);
  const Hit hit = closest_hit(world.geometry.nodes, world.geometry.blocks, world.geometry.root, slice.middle.xyz,
                              direction, 0.0f, INFINITY, NEPHROID_NO_PRIMITIVE);
  distances[texel] = hit.primitive == NEPHROID_NO_PRIMITIVE ? INFINITY : hit.t;
  if (hit.primitive == NEPHROID_NO_PRIMITIVE) return;
  const float3 normal = surface_at(&world.geometry, hit).geometric;
  facing[texel] = (float4)(dot(normal, direction) > 0.0f ? -normal : normal, 0.0f);
}
