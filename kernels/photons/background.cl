// SPDX-License-Identifier: Apache-2.0
// The layer "background": paths from the eye that meet no diffuse surface, straight or through glass and mirrors, end
// at the environment. A path through glass has one wavelength, unless all go the same way: then it has all of them.
#include "kernels/tracing/background.h"
#include "kernels/tracing/camera.h"
#include "kernels/tracing/eye_path.h"
#include "kernels/tracing/work_item.h"

// 1: no glass disperses light.
#ifndef NEPHROID_ONE_WAY
#define NEPHROID_ONE_WAY 0
#endif

// XYZ of a colour after a path's losses, in single wavelengths or in all of them.
static inline float3 shown_after(const World* world, const Background* background, float3 rgb, const Losses* losses,
                                 const Band* band) {
#if NEPHROID_ONE_WAY
  if (!losses->any) return background_xyz(background, rgb, WAVELENGTH_COUNT);
  float3 xyz = (float3)(0.0f);
  for (int w = 0; w < WAVELENGTH_COUNT; ++w)
    xyz += wavelength_left(&world->tables, losses, w) * background_xyz(background, rgb, w);
  return xyz;
#else
  return wavelength_left(&world->tables, losses, band->wavelength)
         * band->weight * background_xyz(background, rgb, band->wavelength);
#endif
}

// The XYZ radiance of the environment where a path that has met `hit` ends; 0 where it ends elsewhere.
static inline float3 seen_through(const World* world, const Background* background, Path path, Hit hit,
                                  const Band* band, uint2 seed, uint sample, uint pixel) {
  Surface surface;
  const float radiance_scale = trace_to_diffuse(world, &path, &hit, true, band, seed, sample, PATHS_THROUGH_GLASS,
                                                pixel, STREAM_BACKGROUND, false, &surface);
  if (radiance_scale == 0.0f || hit.primitive != NEPHROID_NO_PRIMITIVE) return (float3)(0.0f);
  return radiance_scale * shown_after(world, background, background_rgb(background, path.direction), &path.losses,
                                      band);
}

// samples: [count], each a pixel and the sample's number there. enough: as in limit_of_sample.
__kernel void background(WORLD_ARGUMENTS, __global const float* texels, __global const float4* primary_xyz,
                         DeviceBackground size,
                         __global const int* wavelengths,    // 0, 1, ..., 400
                         __global const float* spectrum_cdf, // [401]: chances of a path through glass
                         volatile __global long* film,
                         volatile __global long* energy, // [OUTCOME_COUNT]: only refused ones are counted
                         DeviceCamera camera, uint2 seed, __global const uint2* samples, uint count, uint enough,
                         float film_scale, float film_limit) {
  const World world = WORLD;
  const Background background = {texels, primary_xyz, size};
  const uint index = work_item();
  if (index >= count) return;
  const uint pixel = samples[index].x, frame = samples[index].y;
  const int column = (int)pixel % camera.width, row = (int)pixel / camera.width;
  const float4 jitter = eye_numbers(seed, frame, 1u, pixel, 0u, STREAM_BACKGROUND);
  Path path = path_from_eye(&camera, primary_direction(&camera, column, row, jitter.xy));
  const Hit hit = next_hit(&world, &path);

  float3 xyz = (float3)(0.0f);
  if (hit.primitive == NEPHROID_NO_PRIMITIVE)
    xyz = background_xyz(&background, background_rgb(&background, path.direction), WAVELENGTH_COUNT);
  else if (material_of(&world, object_of_primitive(&world.geometry, hit.primitive)).type == MATERIAL_DIFFUSE)
    return;
  else
    for (uint i = 0; i < PATHS_THROUGH_GLASS; ++i) {
      const float place = golden_place(seed, frame, i, PATHS_THROUGH_GLASS, pixel, STREAM_BACKGROUND_WAVELENGTH);
      const Band band = wavelength_of_cluster(0, wavelengths, spectrum_cdf, WAVELENGTH_COUNT, place);
      xyz += seen_through(&world, &background, path, hit, &band, seed, frame * PATHS_THROUGH_GLASS + i, pixel) /
             (float)PATHS_THROUGH_GLASS;
    }
  const float limit = limit_of_sample(frame, enough, film_limit);
  if (!film_add_dithered(film_of_iteration(film, frame, camera.width * camera.height), (int)pixel, xyz, film_scale,
                         limit, jitter.z))
    add_exactly(energy + OUTCOME_REFUSED, 1);
}
