// SPDX-License-Identifier: Apache-2.0
// Caustics in the air: light that the object sends out and that a thin medium scatters once, towards the eye (thesis
// 3.2.1). Each path from the eye is walked in steps up to its first surface, within the largest caustic sphere. The
// medium dims a step's light on its way to the eye, but not the light of surfaces and the environment.
#include "kernels/environment/cube.h"
#include "kernels/environment/spheres.h"
#include "kernels/tracing/camera.h"
#include "kernels/tracing/item_kernel.h"
#include "kernels/tracing/world.h"

#define VOLUME_STEPS 128

// The part of scattered light in a steradian, by the cosine between the mean way before and the way after. together:
// the length of the mean of unit ways, 1 where all are the same. For ways that are spread about their mean as Henyey
// and Greenstein's, the first moment of the phase function is smaller by that factor, the second by its square.
static inline float phase_function(float cosine, float together, int rayleigh, float g) {
  if (rayleigh) return 1.0f / (4.0f * PI_F) * (1.0f + together * together * (0.75f * cosine * cosine - 0.25f));
  const float mean = together * g, base = 1.0f + mean * mean - 2.0f * mean * cosine; // Henyey and Greenstein 1941
  return (1.0f - mean * mean) / (4.0f * PI_F * base * sqrt(base));
}

// Adds the light of each block of pixels. distances: the whole cube. sums: [pixel][3].
ITEM_KERNEL(volume, (WORLD_ARGUMENTS, __global const float* air, __global const float* radii,
                     __global const float* distances, __global float* sums, DeviceCamera camera, DeviceMedium medium),
                    (WORLD_NAMES, air, radii, distances, sums, camera, medium)) {
  const World world = WORLD;
  const DeviceBlocks blocks = medium.blocks;
  const int block = blocks.block;
  if (index >= blocks.count) return;
  const uint item = blocks.first + index;
  const int columns = (camera.width + block - 1) / block, column = (int)item % columns * block,
            row = (int)item / columns * block;
  const uint pixel = (uint)(row * camera.width + column);
  const float4 random = random4(blocks.seed, blocks.pass, pixel, 0u, STREAM_SEE);
  const float2 jitter = block > 1 ? (float2)(0.5f * (float)block) : random.xy;
  EYE_OF(camera);
#if NEPHROID_LENS
  stand_on_lens(eye, pixel, jitter, random4(blocks.seed, blocks.pass, pixel, LENS_BLOCK, STREAM_SEE).xy);
#endif
  Path path = path_from_eye(eye, primary_direction(eye, column, row, jitter));
  const Hit hit = next_hit(&world, &path);

  // The part of the path within the largest sphere.
  const float3 from_middle = path.origin - medium.middle.xyz;
  const float largest = radii[medium.spheres.count - 1], foot = -dot(from_middle, path.direction);
  const float3 nearest = from_middle + foot * path.direction;
  const float half2 = largest * largest - dot(nearest, nearest), half_chord = sqrt(fmax(half2, 0.0f));
  const float begin = fmax(foot - half_chord, 0.0f),
              end = fmin(foot + half_chord, hit.primitive == NEPHROID_NO_PRIMITIVE ? INFINITY : hit.t);
  float3 sum = (float3)(0.0f);
  if (end > begin) {
    const float step = (end - begin) / VOLUME_STEPS;
    for (int i = 0; i < VOLUME_STEPS; ++i) {
      const float way = begin + ((float)i + (block > 1 ? 0.5f : random.z)) * step;
      const float3 place = from_middle + way * path.direction;
      const float distance = length(place);
      if (distance < radii[0]) continue;
      const float3 outwards = place / distance;
      if (distance > distances[cube_texel(outwards, medium.size)]) continue; // something stands before it
      const float3 in_object = (float3)(dot(medium.object.x.xyz, outwards), dot(medium.object.y.xyz, outwards),
                                        dot(medium.object.z.xyz, outwards));
      const AirLight light =
          compiled_air(air, &medium.spheres, in_object, shell_at(radii, medium.spheres.count, distance));
      const float all = luminance_of(light.rgb), length_of_way = length(light.way);
      if (!(all > 0.0f && length_of_way > 0.0f)) continue;
      const float cosine = -dot(light.way, path.direction) / length_of_way, together = fmin(length_of_way / all, 1.0f);
      sum += light.rgb *
             (phase_function(cosine, together, medium.rayleigh, medium.anisotropy) * exp(-medium.extinction * way) /
              (distance * distance));
    }
    sum *= medium.extinction * medium.albedo * step;
  }
  for (int y = row; y < min(row + block, camera.height); ++y)
    for (int x = column; x < min(column + block, camera.width); ++x) {
      const size_t place = (size_t)(y * camera.width + x);
      vstore3(medium.anew ? sum : vload3(place, sums) + sum, place, sums);
    }
}
