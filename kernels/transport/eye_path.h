// SPDX-License-Identifier: Apache-2.0
// Where paths from the eye begin, and each lamp's unbent light on a diffuse surface.
#include "kernels/tracing/meter.h"
#include "kernels/lights/direct.h"
#include "kernels/tracing/film.h"
#include "kernels/scatter/scatter.h"
#include "kernels/tracing/low_discrepancy.h"

// Where chance chooses what a path meets, it is noisy: a sample that meets glass or a mirror first has so many paths.
// In the layers `direct` and `background`, whose paths divide, only one that meets a rough surface has.
#define PATHS_THROUGH_GLASS 4u

// Four numbers for sample `sample` of a pixel. They come from a sequence as in light_numbers, with `paths` samples a
// pass, or are plain random numbers where paths is 0. block: which four.
static inline float4 eye_numbers(uint2 seed, uint sample, uint paths, uint pixel, uint block, uint stream) {
#if NEPHROID_LOW_DISCREPANCY
  if (paths > 0u) {
    const uint frame = sample / paths, index = frame / NEPHROID_FILM_HALVES * paths + sample % paths;
    return sobol4(seed, (uint3)(pixel, stream << 8 | block, frame % NEPHROID_FILM_HALVES), 3u, index);
  }
#endif
  return random4(seed, sample, pixel, block, stream);
}

// Moves a camera to where the path of a place in a pixel begins, at a place of its lens by eye_numbers.
static inline void begin_on_lens(DeviceCamera* camera, uint pixel, float2 place, uint2 seed, uint sample, uint paths,
                                 uint stream) {
#if NEPHROID_LENS
  stand_on_lens(camera, pixel, place, eye_numbers(seed, sample, paths, pixel, LENS_BLOCK, stream).xy);
#endif
}

// The place in the pixel of a sample, and two more numbers. All layers of engine 1 look at the same places: where one
// no longer sees a surface at its edge, another one sees what is behind it.
static inline float4 place_numbers(uint2 seed, uint sample, uint pixel) {
  return eye_numbers(seed, sample, 1u, pixel, 0u, STREAM_CAMERA);
}

// What the camera sees first in the direction of a place in a pixel. place: in [0, 1) x [0, 1). The camera moves to
// where that path begins.
static inline Hit first_hit(const World* world, DeviceCamera* camera, uint pixel, float2 place, uint2 seed, uint sample,
                            float3* direction) {
#if NEPHROID_METER
  return hit_of_cell(world, camera, pixel, place, direction);
#endif
  begin_on_lens(camera, pixel, place, seed, sample, 1u, STREAM_CAMERA);
  *direction = primary_direction(camera, (int)pixel % camera->width, (int)pixel / camera->width, place);
  Path path = path_from_eye(camera, *direction);
  return next_hit(world, &path);
}

// Adds a sample to its pixel, and counts it in `energy` where it is too bright for the film. limit: limit_of_sample's.
static inline void add_sample(volatile __global long* film, volatile __global long* energy, const DeviceCamera* camera,
                              uint pixel, uint frame, float3 xyz, float scale, float limit, float dither) {
  if (!film_add_dithered(film_of_iteration(film, frame, camera->width * camera->height), (int)pixel, xyz, scale, limit,
                         dither))
    add_exactly(energy + OUTCOME_REFUSED, 1);
}

static inline DeviceMaterial material_of_hit(const World* world, const Hit* hit) {
  return material_of(world, object_of_primitive(&world->geometry, hit->primitive));
}

// Whether a path from the eye met a matt surface at once, so that all wavelengths went the same way.
static inline bool is_unbent(const World* world, const DeviceCamera* camera, const Hit* first) {
  const DeviceMaterial material = material_of_hit(world, first);
  return is_matt(&material) && is_in_air(&camera->inside);
}
