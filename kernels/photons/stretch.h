// SPDX-License-Identifier: Apache-2.0
// Splats a photon as a streak: its cluster's light is spread along the way on which its place moves with the wavelength
// (Elek et al. 2014, "Spectral ray differentials"), each wavelength with its own colour. The 401 lines of a rainbow
// become one band.
//
// A wavelength's light lies as a tent over +-1 nm. So it is interpolated linearly between the 401 wavelengths, and
// their sum stays the same.
#include "kernels/photons/photon_start.h"
#include "kernels/photons/splat.h"
#include "kernels/transport/stretched_place.h"

// The most splats of a photon, and the length in pixels below which it stays a point of its own wavelength.
#define STRETCH_SPLATS 16
#define STRETCH_SHORTEST 0.1f
// The largest angle, in radians, between the last directions of a streak for which D' predicts them. It excludes the
// critical angle, too. Clusters of the default threshold, 0.05 degrees, stay well below: photons of one that is about
// as wide disagree whether it can be stretched, which puts its light wrong (docs/notebook/differentials.md).
#define STRETCH_WIDEST 0.015f

// How a photon is splatted: `count` splats, of its whole cluster's light or its band's, each at its wavelength's place.
typedef struct {
  int count;
  bool whole;
  bool beside; // an end of the streak lies in another triangle
} Stretch;

// The photon's own s.
static inline float stretch_origin(const World* world, const Band* band) {
  return band->wavelength >= 0 ? world->stretch_place[band->wavelength].x : world->stretch_span[band->cluster].x;
}

// Tries to stretch a photon from `low` to `high`, its own s being 0. False: that leaves the receiver or goes too far.
static inline bool stretch_over(const World* world, const DeviceCamera* camera, const PhotonEnd* end, const Path* path,
                                float low, float high, float shortest, float widest, Stretch* stretch) {
  if (!(fabs(high - low) * length(path->differential.direction) <= widest)) return false;
  float3 first, last;
  if (!stretched_place(path, &end->surface, low, &first) || !stretched_place(path, &end->surface, high, &last))
    return false;
  float depth;
  const float pixels = distance(place_on_film(camera, first, &depth), place_on_film(camera, last, &depth));
  if (pixels < shortest) return true;
  const float side = dot(path->direction, end->surface.geometric) < 0.0f ? 1.0f : -1.0f;
  for (int i = 0; i < 2; ++i) // a loop, for one copy of the code
    if (!is_on_receiver(world, &end->surface, end->triangle, side, i == 0 ? first : last, &stretch->beside))
      return false;
  stretch->count = pixels < STRETCH_SPLATS - 1 ? 1 + (int)ceil(pixels) : STRETCH_SPLATS;
  return true;
}

// Decides how a deposited photon is splatted: as a streak of its cluster; if that is impossible, with jitter, as a
// streak of its own wavelength; else as a point. A coloured photon's streak is its four wavelengths: of no others it is
// known what is left. The first choice depends on where the whole cluster's light goes and not on the photon's
// wavelength, so no light is counted twice or lost where a streak would leave the receiver.
COMPILED_ONCE Stretch stretch_of(const World* world, const DeviceCamera* camera, const PhotonEnd* end, const Path* path,
                                 const Band* band) {
#if NEPHROID_DIFFERENTIALS
  const float origin = stretch_origin(world, band);
  for (int i = 0; i < (band->wavelength >= 0 ? 2 : 1); ++i) {
    const float4 span = i == 0 ? world->stretch_span[band->cluster] : world->stretch_place[band->wavelength];
    Stretch stretch = {1, i == 0, false};
    if (stretch_over(world, camera, end, path, span.y - origin, span.z - origin, STRETCH_SHORTEST, STRETCH_WIDEST,
                     &stretch)) {
      if (stretch.whole && stretch.count > 1 && are_coloured(&path->throughput.own)) stretch.count = 4;
      return stretch;
    }
  }
#endif
  const Stretch point = {1, false, false};
  return point;
}

// The place of a wavelength's light in its tent, as s less `origin`; u inverts (1 + t)^2 / 2 for t in -1..0.
static inline float place_in_tent(const World* world, int wavelength, float u, float origin) {
  const float t = u < 0.5f ? sqrt(2.0f * u) - 1.0f : 1.0f - sqrt(2.0f - 2.0f * u);
  const float4 place = world->stretch_place[wavelength];
  return place.x - origin + (t < 0.0f ? -t * (place.y - place.x) : t * (place.z - place.x));
}

// Picks a wavelength of the cluster by u as choose_band does, and a place in its tent. *x: its s less the photon's.
static inline Band stretched_band(const World* world, int light, const Band* photon, float u, float* x) {
  const int cluster = made_late(photon->cluster), first = world->tables.cluster_first[cluster],
            count = world->tables.cluster_first[cluster + 1] - first;
  const int members = world->tables.cluster_first[world->scene.cluster_count];
  __global const float* cdf = world->tables.wavelength_cdf + light * members + first;
  const int member = choose(cdf, count, u);
  const float before = chance_before(cdf, member);
  const Band band = one_wavelength(photon->cluster, world->tables.cluster_wavelengths[first + member],
                                   1.0f / (cdf[member] - before));
  *x = place_in_tent(world, band.wavelength, clamp((u - before) * band.weight, 0.0f, 1.0f),
                     stretch_origin(world, photon));
  return band;
}

typedef struct {
  Surface surface;
  uint triangle;
  float3 xyz; // as PhotonEnd's
} Strand;

// The splat number i of stretch->count. u in [0, 1) is the same for all: they are spread over the cluster's
// distribution, and with jitter the first has the photon's own wavelength. False where it does not reach the receiver.
COMPILED_ONCE bool strand_of(const World* world, const PhotonEnd* end, const Path* path, Source source,
                             const Band* band, const Stretch* stretch, int i, float u, Strand* strand) {
  strand->surface = end->surface;
  strand->triangle = end->triangle;
  strand->xyz = end->xyz;
#if NEPHROID_DIFFERENTIALS
  if (stretch->count == 1) return true;
  float turned = u + (float)i / (float)stretch->count;
  turned = turned < 1.0f ? turned : turned - 1.0f;
  float x;
  Band wavelength = *band;
  Throughput throughput = path->throughput;
  if (stretch->whole && are_coloured(&throughput.own)) {
    wavelength = one_wavelength(band->cluster, number_of_four_wavelengths(&band->own, i),
                                4.0f * number_of_four(band->own.weights, i));
    throughput.own.four.x = number_of_four(throughput.own.four, i);
    const float place_there = u * 0x1p12f;
    x = place_in_tent(world, wavelength.wavelength, place_there - floor(place_there), stretch_origin(world, band));
  } else if (stretch->whole)
    wavelength = stretched_band(world, source.light, band, turned, &x);
  else
    x = place_in_tent(world, band->wavelength, turned, stretch_origin(world, band));
  float3 place;
  if (!stretched_place(path, &end->surface, x, &place)) return false;
  const float side = dot(path->direction, end->surface.geometric) < 0.0f ? 1.0f : -1.0f;
  if (!move_on_receiver(world, side, place, stretch->beside, &strand->surface, &strand->triangle)) return false;
  if (NEPHROID_TEXTURES || stretch->whole) {
    const Reflector reflector = reflector_at(world, &strand->surface, strand->triangle);
    strand->xyz = carried_light(world, &throughput, source, &wavelength, reflector).xyz;
  }
  strand->xyz /= (float)stretch->count;
  return true;
#else
  return true;
#endif
}
