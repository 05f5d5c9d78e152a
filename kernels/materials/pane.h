// SPDX-License-Identifier: Apache-2.0
// A pane without thickness: what goes through goes straight on, and all reflections between its two faces are summed,
// R + T R T + T R^3 T + ... = 2 R / (1 + R) with T = 1 - R, so (1 - R) / (1 + R) passes.
#include "kernels/tracing/surface.h"

// 0: no object is a pane.
#ifndef NEPHROID_PANES
#define NEPHROID_PANES 1
#endif

#if NEPHROID_PANES
// n: index of the medium around, n_pane: of the pane. choice: as in bend_at.
static inline Bend bend_at_pane(float3 direction, const Surface* surface, float n, float n_pane, float choice) {
  Bend bend = bend_at_surface(direction, surface, n, n_pane, no_layer(), -1.0f);
  bend.reflectance = 2.0f * bend.reflectance / (1.0f + bend.reflectance);
  if (bend.reflectance < 1.0f && !(choice < bend.reflectance)) {
    bend.direction = direction;
    bend.transmitted = bend.straight = true;
  }
  return bend;
}
#endif
