// SPDX-License-Identifier: Apache-2.0
// A pane without thickness: what goes through goes straight on, and all reflections between its two faces are summed,
// R + T R T + T R^3 T + ... = 2 R / (1 + R) with T = 1 - R, so (1 - R) / (1 + R) passes. Light keeps its polarisation
// between them: the mean is taken of both sums.
#include "kernels/tracing/surface.h"

// 0: no object is a pane.
#ifndef NEPHROID_PANES
#define NEPHROID_PANES 1
#endif

#if NEPHROID_PANES
// n: index of the medium around, n_pane: of the pane. choice: as in bend_at.
static inline Bend bend_at_pane(float3 direction, const Surface* surface, float n, float n_pane, float choice) {
  Bend bend = bend_at_surface(direction, surface, n, n_pane, no_layer(), -1.0f);
  if (bend.reflectance == 1.0f) return bend;
  const float cos_i = clamp(-dot(direction, bend.normal), 0.0f, 1.0f), cos_t = refracted_cosine(cos_i, n / n_pane);
  const float2 amplitudes = fresnel_amplitudes(cos_i, cos_t, n, n_pane), face = amplitudes * amplitudes,
               both = 2.0f * face / (1.0f + face);
  bend.reflectance = 0.5f * (both.x + both.y);
  if (!(choice < bend.reflectance)) {
    bend.direction = direction;
    bend.transmitted = bend.straight = true;
  }
  return bend;
}
#endif
