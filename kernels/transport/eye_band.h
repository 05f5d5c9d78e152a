// SPDX-License-Identifier: Apache-2.0
// The wavelengths of a path from the eye. Glass that disperses splits them, and then the path stands for a part of the
// spectrum: it finds what the whole part shows by its own way, and by how that moves with the wavelength (sweep.h).
// That is exact only for small parts. So a pixel's first paths have the whole spectrum, and then parts shrink.
#include "kernels/tracing/camera.h"
#include "kernels/tracing/low_discrepancy.h"
#include "kernels/tracing/world.h"

// 1: all wavelengths of a part end at one place, or its ends are swept.
#ifndef NEPHROID_EYE_PARTS
#define NEPHROID_EYE_PARTS 0
#endif

// How many parts there are for a pixel's path `number` in a half of the film: a power of two near the cube root of
// a quarter of the number, or many.
static inline uint parts_of_spectrum(uint number) {
  if (!NEPHROID_JITTER) return 1u;
  return NEPHROID_EYE_PARTS ? 1u << (31u - clz(max(number / 4u, 1u))) / 3u : 256u;
}

// A place in the spectrum (member_at) for path `path` of `paths` in a frame. One path after the other takes each of the
// parts, all at the same place in them, and then at the next by steps of the golden ratio.
static inline float place_in_spectrum(uint2 seed, uint frame, uint path, uint paths, uint pixel, uint stream,
                                      uint* parts) {
  const uint number = frame / SAMPLE_SEQUENCES * paths + path; // even and odd frames are the film's halves
  *parts = parts_of_spectrum(number);
  const uint2 start = philox4x32((uint4)(pixel, frame % SAMPLE_SEQUENCES, 0u, stream), seed).xy;
  const uint part = (number + start.y) & (*parts - 1u), // scattered: 1/2, 1/4, 3/4, ...
      scattered = *parts > 1u ? reverse_bits(part) >> (clz(*parts) + 1u) : 0u;
  const float within = (float)((start.x + number / *parts * 2654435769u) >> 8) * 0x1p-24f;
  return fmin(((float)scattered + within) / (float)*parts, 0x1.fffffep-1f);
}

// The band of a path from the eye, which stands for one of `parts` equal parts of the spectrum. place: in [0, 1).
// *chance: the part's; or without NEPHROID_JITTER, where it is a cluster, that one's.
static inline Band choose_eye_band(const World* world, float place, uint parts, float* chance) {
  if (!NEPHROID_JITTER) {
    float within;
    const int cluster = cluster_at(world, place, chance, &within);
    return choose_band(world, world->scene.light_count, cluster, within);
  }
  const float size = 1.0f / (float)parts, low = floor(place * (float)parts) * size, within = (place - low) / size;
  const Member leader = member_at(world, place);
  Band band = one_wavelength(leader.cluster, world->tables.cluster_wavelengths[leader.number], size / leader.chance);
  DrawnWavelength drawn[4];
  for (int i = 0; i < 4; ++i) drawn[i] = wavelength_at(world, low + size * quarters_on(within, i), size);
  band.own = carriers_of(drawn[0], drawn[1], drawn[2], drawn[3],
                         wavelength_at(world, low + 0.5f * size, size).wavelength);
  if (NEPHROID_LOSSES) {
    for (int i = 0; i < 4; ++i) drawn[i] = wavelength_at(world, quarters_on(place, i), size);
    band.all = carriers_of(drawn[0], drawn[1], drawn[2], drawn[3], WAVELENGTH_COUNT / 2);
  }
  band.low = low;
  band.within = within;
  band.size = band.chance = *chance = size;
  return band;
}

// The band of path `path` of `paths` in a frame.
static inline Band band_of_eye_path(const World* world, uint2 seed, uint frame, uint path, uint paths, uint pixel,
                                    uint stream, float* chance) {
  uint parts;
  const float place = place_in_spectrum(seed, frame, path, paths, pixel, stream, &parts);
  return choose_eye_band(world, place, parts, chance);
}
