// SPDX-License-Identifier: Apache-2.0
// Where paths from the eye begin: their direction, and the wavelength cluster of one that meets glass.
#include "kernels/tracing/film.h"
#include "kernels/tracing/frame.h"
#include "kernels/tracing/path.h"
#include "kernels/tracing/random.h"

// 1: the camera has a lens, a shift or parallel rays. 0: it is a pinhole with its axis in the middle of the picture.
#ifndef NEPHROID_LENS
#define NEPHROID_LENS 0
#endif

// 1: a meter is in the camera's place (meter.h).
#ifndef NEPHROID_METER
#define NEPHROID_METER 0
#endif

#if NEPHROID_LENS
// The pinhole that a camera is at a place of its lens: it sees the same in the plane of focus. The lens's picture is
// the mean of theirs. lens: uniform in [0, 1) x [0, 1).
static inline DeviceCamera through_lens(const DeviceCamera* camera, float2 lens) {
  DeviceCamera pinhole = *camera;
  const float radius = camera->lens_radius * sqrt(lens.x);
  float cosine;
  const float sine = sincos(2.0f * PI_F * lens.y, &cosine), aside = radius * cosine, upwards = radius * sine;
  pinhole.position.xyz += aside * camera->right.xyz + upwards * camera->up.xyz;
  pinhole.shift_x -= aside / camera->focus;
  pinhole.shift_y -= upwards / camera->focus;
  return pinhole;
}
#endif

// direction: unit, along forward + x right + y up, so its derivative by x is (right - (right.D) D) (forward.D).
static inline Path path_from_eye(const DeviceCamera* camera, float3 direction) {
  const Differential none = {(float3)(0.0f), (float3)(0.0f)};
  Path path = {camera->position.xyz, direction, NEPHROID_NO_PRIMITIVE, camera->inside, full_throughput(), 0.0f, none};
#if NEPHROID_PLACE_DIFFERENTIALS
  const float along = dot(direction, camera->forward.xyz);
  const float3 right = camera->right.xyz, up = camera->up.xyz;
  path.by_place[0].position = path.by_place[1].position = (float3)(0.0f);
  path.by_place[0].direction =
      2.0f * camera->tan_x / (float)camera->width * along * (right - dot(right, direction) * direction);
  path.by_place[1].direction =
      -2.0f * camera->tan_y / (float)camera->height * along * (up - dot(up, direction) * direction);
#if NEPHROID_LENS
  if (camera->orthographic) {
    path.by_place[0].position = 2.0f * camera->tan_x / (float)camera->width * right;
    path.by_place[1].position = -2.0f * camera->tan_y / (float)camera->height * up;
    path.by_place[0].direction = path.by_place[1].direction = (float3)(0.0f);
  }
#endif
#endif
  return path;
}

// jitter: the place in the pixel's square, [0, 1) each way. The camera stands on its lens (stand_on_lens).
static inline float3 primary_direction(const DeviceCamera* camera, int column, int row, float2 jitter) {
  const float x = 2.0f * ((float)column + jitter.x) / (float)camera->width - 1.0f;
  const float y = 1.0f - 2.0f * ((float)row + jitter.y) / (float)camera->height;
#if NEPHROID_LENS
  const float2 aside = camera->orthographic ? (float2)(0.0f) : (float2)(x * camera->tan_x, y * camera->tan_y);
  return normalize(camera->forward.xyz + (aside.x + camera->shift_x) * camera->right.xyz +
                   (aside.y + camera->shift_y) * camera->up.xyz);
#endif
  return normalize(camera->forward.xyz + (x * camera->tan_x) * camera->right.xyz +
                   (y * camera->tan_y) * camera->up.xyz);
}

#define LENS_BLOCK 0xffu // of the numbers of a path, for its place on the lens

// Declares `eye`, a kernel's camera, that the work item may move. Work items share an argument (PoCL): a copy is moved.
#if NEPHROID_LENS || NEPHROID_METER
#define EYE_OF(camera) DeviceCamera own_camera = (camera), *eye = &own_camera
#else
#define EYE_OF(camera) DeviceCamera* eye = &(camera)
#endif

#if NEPHROID_LENS
// Moves a camera to where the ray of a place in a pixel begins. lens: uniform in [0, 1) x [0, 1).
static inline void stand_on_lens(DeviceCamera* camera, uint pixel, float2 place, float2 lens) {
  *camera = through_lens(camera, lens);
  if (!camera->orthographic) return;
  const float x = 2.0f * ((float)((int)pixel % camera->width) + place.x) / (float)camera->width - 1.0f;
  const float y = 1.0f - 2.0f * ((float)((int)pixel / camera->width) + place.y) / (float)camera->height;
  camera->position.xyz += x * camera->tan_x * camera->right.xyz + y * camera->tan_y * camera->up.xyz;
}
#endif

// A number in [0, 1) for path `path` of `paths` in a frame: steps of the golden ratio, so that a pixel's numbers spread
// evenly. Even and odd frames have starts and counts of their own, as the film's independent halves must.
static inline float golden_place(uint2 seed, uint frame, uint path, uint paths, uint pixel, uint stream) {
  const uint half_of_frames = frame % SAMPLE_SEQUENCES, step = frame / SAMPLE_SEQUENCES * paths + path;
  const uint start = philox4x32((uint4)(pixel, half_of_frames, 0u, stream), seed).x;
  return (float)((start + step * 2654435769u) >> 8) * 0x1p-24f;
}

// The same for paths that carry four wavelengths, a quarter apart each: the sixteen of a sample's four paths are even.
static inline float golden_place_of_four(uint2 seed, uint frame, uint path, uint pixel, uint stream) {
  const float place = golden_place(seed, frame, 0u, 1u, pixel, stream) + (float)(5u * path % 16u) * 0.0625f;
  return place < 1.0f ? place : place - 1.0f;
}

// The cluster of a path. cdf: [cluster + 1], the first 0.
static inline int choose_cluster(__global const float* cdf, int count, uint2 seed, uint frame, uint path, uint paths,
                                 uint pixel, uint stream) {
  return choose(cdf + 1, count, golden_place(seed, frame, path, paths, pixel, stream));
}
