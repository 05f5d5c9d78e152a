// SPDX-License-Identifier: Apache-2.0
// The exact sums of film.h over arrays. NEPHROID_CHECK_HALVES: as for a device without 64-bit atomics.
#ifdef NEPHROID_CHECK_HALVES
#undef NEPHROID_INT64_ATOMICS
#endif
#include "kernels/tracing/film.h"
#include "kernels/tracing/work_item.h"

kernel void add_all(global const long* values, global const int* places, volatile global long* sums, uint count) {
  const uint i = work_item();
  if (i < count) add_exactly(sums + places[i], values[i]);
}

kernel void add_to_film(global const float4* xyz_scale, volatile global long* film, global int* accepted, uint count) {
  const uint i = work_item();
  if (i < count) accepted[i] = film_add_dithered(film, (int)i, xyz_scale[i].xyz, xyz_scale[i].w, FILM_LIMIT, 0.5f);
}
