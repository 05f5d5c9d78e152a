// SPDX-License-Identifier: Apache-2.0
// A path from the eye stands for a part of the spectrum (choose_eye_band). Where glass has split it, each quarter of
// the part ends at a place of its own, to first order (Elek et al. 2014, "Spectral ray differentials").
#include "kernels/transport/stretched_place.h"

// The largest angle, in radians, between the last directions of a part for which D' predicts them. It excludes the
// critical angle, too. Beyond it all wavelengths of a part are taken to end where its leader does. Caustics are narrow:
// of these the leader finds its own light alone.
#define EYE_SWEEP_WIDEST 0.25f

// By how much s at a wavelength is larger than the leader's.
static inline float beyond_leader(const World* world, const Band* band, int wavelength) {
  return world->stretch_place[wavelength].x - world->stretch_place[band->own.wavelengths.x].x;
}

// How the wavelengths of a path's part of the spectrum end: together, each at a place of its own that is known, or
// elsewhere than the leader.
#define ENDS_TOGETHER 0
#define ENDS_SWEPT 1
#define ENDS_APART 2

static inline int ends_of_band(const World* world, const Path* path, const Band* band) {
  if (!NEPHROID_DIFFERENTIALS || band->size == 0.0f || is_unsplit(&path->throughput, band)) return ENDS_TOGETHER;
  const int4 w = band->own.wavelengths;
  const float farthest =
      fmax(fabs(beyond_leader(world, band, w.y)),
           fmax(fabs(beyond_leader(world, band, w.z)), fabs(beyond_leader(world, band, w.w))));
  const float turn = farthest * length(path->differential.direction);
  if (!(turn <= EYE_SWEEP_WIDEST)) return ENDS_APART;
  return turn + farthest * length(path->differential.position) > 0.0f ? ENDS_SWEPT : ENDS_TOGETHER;
}

// The quarter of a band that its wavelength number i stands for: its part of the spectrum, and that one's weight.
static inline Band quarter_of_band(const Band* band, int i) {
  Band quarter = *band;
  quarter.size *= 0.25f;
  quarter.low += quarter.size * (float)(((int)(4.0f * band->within) + i) & 3);
  quarter.own.weights *= (float4)(i == 0, i == 1, i == 2, i == 3);
  return quarter;
}

// Moves *surface, where a path ends, to where light does whose s is larger by x. Where that is no diffuse surface, it
// stays.
static inline void move_end(const World* world, const Path* path, float x, Surface* surface, uint* triangle) {
  if (x == 0.0f) return;
  const float3 origin = path->origin + x * path->differential.position,
               direction = normalize(path->direction + x * path->differential.direction);
  const Hit hit = closest_hit(world->geometry.nodes, world->geometry.blocks, world->geometry.root, origin, direction,
                              0.0f, INFINITY, path->skip);
  if (hit.primitive == NEPHROID_NO_PRIMITIVE) return;
  const Surface there = surface_of(world, hit);
  const DeviceMaterial material = material_of(world, there.object);
  if (there.object != surface->object && !is_only_matt(&material)) return;
  *surface = there;
  *triangle = hit.primitive;
}
