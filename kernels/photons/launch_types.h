// SPDX-License-Identifier: Apache-2.0
// What a launch of one of engine 1's kernels says beside the scene, the camera and its buffers.
#ifndef NEPHROID_LAUNCH_TYPES_H
#define NEPHROID_LAUNCH_TYPES_H

#include "kernels/tracing/shared_types.h"

#ifndef __OPENCL_C_VERSION__
namespace nephroid::shared {
#endif

// Of kernels that send photons: offset, offset + stride, ..., `count` of them, of the batch or pass `iteration` and of
// those that follow it. A kernel reads what it needs.
typedef struct {
  uint2 seed;
  uint iteration;
  uint first_iteration; // the first with this allocation of photons to the emitters
  uint offset, stride, count;
  uint photons_per_batch;
  uint map_pass; // the pass of the photon maps
  int emitter_count, object_count;
  float film_scale, energy_scale, stored_scale; // quanta of the film, of the balance of energy, of light that is kept
  float unseen_weight; // with NEPHROID_MOMENTS: weight of a photon that no pixel sees directly
} DevicePhotonLaunch;

// Of kernels that take `count` samples, each of a pixel.
typedef struct {
  uint2 seed;
  uint count;
  uint enough; // as in limit_of_sample
  float film_scale, film_limit;
} DeviceSampleLaunch;

// Of relight_direct.cl: a sample of every pixel of some rows.
typedef struct {
  uint2 seed;
  uint frame;
  int first_row, row_count;
  float film_scale, film_limit;
  int padding;
} DeviceRowLaunch;

// Of view.cl: paths of the pixels first, ..., first + count - 1, all in a cluster.
typedef struct {
  uint2 seed;
  uint pass;
  int cluster;
  int object_count;
  uint first, count;
} DeviceViewLaunch;

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(DevicePhotonLaunch) == 64 && sizeof(DeviceSampleLaunch) == 24);
static_assert(sizeof(DeviceRowLaunch) == 32 && sizeof(DeviceViewLaunch) == 32);
} // namespace nephroid::shared
#endif

#endif
