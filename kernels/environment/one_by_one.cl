// SPDX-License-Identifier: Apache-2.0
// Caustics on receivers in the two ways that the thesis compares (3.4, table 3.3), one set of spheres after the other: `cast` looks all sets
// up for each receiver; `compile` adds them up into one set first (Algorithm 3.5), and `cast_compiled` looks that up. All light comes from
// the object's middle.
#include "kernels/environment/cube.h"
#include "kernels/environment/spheres.h"

#define SETS __global const ushort* stored, __global const DeviceEightSets* sets, int set_count

// E r^2 on a sphere, of all sets.
static inline float3 caustic_one_by_one(SETS, const DeviceSpheres* spheres, float3 direction, Shell shell)
{
  float3 sum = (float3)(0.0f);
  for (int i = 0; i < set_count; ++i) {
    __global const DeviceEightSets* eight = sets + i / 8;
    const int k = i % 8;
    const FourTexels four = four_texels(in_set(eight, k, direction), spheres->side);
    sum += flux_of_set(eight, k) * stored_between_spheres(stored + NEPHROID_CHANNELS * eight->first[k], spheres, &four, shell);
  }
  return spheres->scale * sum;
}

// What a caustic that comes from the middle is on a receiver.
static inline float from_middle(__global const float* radii, float distance, float3 direction, float3 normal)
{
  return held(radii, distance) * fmax(-dot(normal, direction), 0.0f);
}

// Arguments are as in cast.cl.
__kernel void cast(SETS, __global const float* radii, DeviceSpheres spheres, __global const uint* list, uint first, uint count, int size,
                   __global const float* distances, __global const float4* normals, __global float* caustics)
{
  const uint index = (uint)get_global_id(0);
  if (index >= count) return;
  const uint texel = list[first + index];
  const float distance = distances[texel];
  float3 caustic = (float3)(0.0f);
  if (distance < INFINITY) {
    const float3 direction = cube_texel_direction(texel, size);
    caustic = from_middle(radii, distance, direction, normals[texel].xyz) *
              caustic_one_by_one(stored, sets, set_count, &spheres, direction, shell_at(radii, spheres.count, distance));
  }
  vstore3(caustic, (size_t)texel, caustics);
}

// Of all texels of all spheres in their stored form, in coordinates of the object, whose axes in the scene are object_x, y, z.
__kernel void compile(SETS, __global const float* radii, DeviceSpheres spheres, float4 object_x, float4 object_y, float4 object_z,
                      uint count, __global float* compiled)
{
  const uint item = (uint)get_global_id(0);
  if (item >= count) return;
  const uint texels = (uint)((spheres.side + 2) * (spheres.side + 2));
  const float3 d = sphere_direction(texel_of_stored((int)(item % texels), spheres.side), spheres.side);
  const float3 direction = d.x * object_x.xyz + d.y * object_y.xyz + d.z * object_z.xyz;
  const float3 caustic = caustic_one_by_one(stored, sets, set_count, &spheres, direction, shell_at(radii, spheres.count, radii[item / texels]));
  vstore3(caustic, (size_t)item, compiled);
}

__kernel void cast_compiled(__global const float* compiled, __global const float* radii, DeviceSpheres spheres, float4 object_x, float4 object_y,
                            float4 object_z, __global const uint* list, uint first, uint count, int size, __global const float* distances,
                            __global const float4* normals, __global float* caustics)
{
  const uint index = (uint)get_global_id(0);
  if (index >= count) return;
  const uint texel = list[first + index];
  const float distance = distances[texel];
  float3 caustic = (float3)(0.0f);
  if (distance < INFINITY) {
    const float3 d = cube_texel_direction(texel, size);
    const Shell shell = shell_at(radii, spheres.count, distance);
    const FourTexels four = four_texels((float3)(dot(object_x.xyz, d), dot(object_y.xyz, d), dot(object_z.xyz, d)), spheres.side);
    const size_t map_texels = (size_t)((spheres.side + 2) * (spheres.side + 2));
    for (int i = 0; i < 4; ++i) {
      const float3 a = vload3((size_t)shell.lower * map_texels + four.texels[i], compiled);
      const float3 b = vload3((size_t)shell.upper * map_texels + four.texels[i], compiled);
      caustic += four.weights[i] * (a + shell.part * (b - a));
    }
    caustic *= from_middle(radii, distance, d, normals[texel].xyz);
  }
  vstore3(caustic, (size_t)texel, caustics);
}
