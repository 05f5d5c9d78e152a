// SPDX-License-Identifier: Apache-2.0
// Caustics on what stands around the object (thesis 3.2): E r^2 of all lights in texels of the cube of receivers, from
// the spheres of every light. And light in the air, by one set of spheres that adds them up (Algorithm 3.5).
#include "kernels/environment/cube.h"
#include "kernels/environment/spheres.h"
#include "kernels/tracing/work_item.h"

// caustics: [texel][3], linear sRGB: E r^2 on the receivers. normals: [texel], unit, on the object's side.
__kernel void cast(__global const uchar* texels, __global const ushort* blocks, __global const float4* way_of,
                   __global const float* radii, __global const DeviceEightSets* sets, int eights, DeviceSpheres spheres,
                   __global const uint* list, DeviceTexels slice, __global const float* distances,
                   __global const float4* normals, __global float* caustics) {
  const uint index = work_item();
  if (index >= slice.count) return;
  const uint texel = list[slice.first + index];
  const float distance = distances[texel];
  float3 caustic = (float3)(0.0f);
  if (distance < INFINITY) {
    const Maps maps = {texels, blocks, way_of};
    const float beyond = fmax(1.0f - radii[spheres.count - 1] / distance, 0.0f);
    const float3 direction = cube_texel_direction(texel, slice.size);
    caustic = held(radii, distance) * caustic_of_sets(&maps, &spheres, sets, eights, direction,
                                                      shell_at(radii, spheres.count, distance), beyond,
                                                      normals[texel].xyz);
  }
  vstore3(caustic, (size_t)texel, caustics);
}

// Adds up the light in the air of all sets (Algorithm 3.5), for compiled_air in spheres.h, in all stored texels of all
// spheres. side: texels across the maps.
__kernel void compile_air(__global const uchar* texels, __global const ushort* blocks, __global const float4* way_of,
                          __global const float* radii, __global const DeviceEightSets* sets, int eights,
                          DeviceSpheres spheres, DeviceAxes object, int side, uint count, __global float* air) {
  const uint item = work_item();
  if (item >= count) return;
  const uint map_texels = (uint)((side + 2) * (side + 2));
  const Maps maps = {texels, blocks, way_of};
  const Shell shell = shell_at(radii, spheres.count, radii[item / map_texels]);
  const float3 d = sphere_direction(texel_of_stored((int)(item % map_texels), side), side);
  const float3 direction = d.x * object.x.xyz + d.y * object.y.xyz + d.z * object.z.xyz;
  AirLight light = {(float3)(0.0f), (float3)(0.0f)};
  for (int i = 0; i < eights; ++i)
    for (int k = 0; k < 8; ++k) add_air(&light, &maps, &spheres, sets + i, k, direction, shell);
  vstore3(light.rgb, 2 * (size_t)item, air);
  vstore3(light.way, 2 * (size_t)item + 1, air);
}
