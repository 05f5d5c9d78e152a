// SPDX-License-Identifier: Apache-2.0
// Where paths from the eye begin: their direction, and the wavelength cluster of one that meets glass.
#include "kernels/tracing/shared_types.h"
#include "kernels/tracing/random.h"

// jitter: the place in the pixel's square, [0, 1) each way.
static inline float3 primary_direction(const DeviceCamera* camera, int column, int row, float2 jitter) {
  const float x = 2.0f * ((float)column + jitter.x) / (float)camera->width - 1.0f;
  const float y = 1.0f - 2.0f * ((float)row + jitter.y) / (float)camera->height;
  return normalize(camera->forward.xyz + (x * camera->tan_x) * camera->right.xyz +
                   (y * camera->tan_y) * camera->up.xyz);
}

// A number in [0, 1) for path `path` of `paths` in a frame: steps of the golden ratio, so that a pixel's numbers spread
// evenly. Even and odd frames have starts and counts of their own, as the film's independent halves must.
static inline float golden_place(uint2 seed, uint frame, uint path, uint paths, uint pixel, uint stream) {
  const uint half_of_frames = frame & 1u, step = (frame >> 1) * paths + path;
  const uint start = philox4x32((uint4)(pixel, half_of_frames, 0u, stream), seed).x;
  return (float)((start + step * 2654435769u) >> 8) * 0x1p-24f;
}

// The cluster of a path. cdf: [cluster + 1], the first 0.
static inline int choose_cluster(__global const float* cdf, int count, uint2 seed, uint frame, uint path, uint paths,
                                 uint pixel, uint stream) {
  return choose(cdf + 1, count, golden_place(seed, frame, path, paths, pixel, stream));
}
