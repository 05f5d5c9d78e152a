// SPDX-License-Identifier: Apache-2.0
// Where a photon begins: its emitter and its random numbers there; and how its end is counted.
#include "kernels/lights/lights.h"
#include "kernels/lights/spectrum.h"
#include "kernels/tracing/low_discrepancy.h"
#include "kernels/tracing/outcomes.h"
#include "kernels/tracing/world.h"

// The number of photons that one work item follows.
#ifndef NEPHROID_PHOTONS_PER_ITEM
#define NEPHROID_PHOTONS_PER_ITEM 1
#endif

// Counts the outcome, OUTCOME_*, of a photon of `power` quanta, of which the part `left` came to its end, and its
// segments.
static inline void count_photon(Outcomes outcomes, int outcome, int segments, float power, float left) {
  const long quanta = convert_long_rte(power), rest = left == 1.0f ? quanta : convert_long_rte((float)quanta * left);
  add_outcome(outcomes, OUTCOME_EMITTED, quanta);
  add_outcome(outcomes, outcome, rest);
  add_outcome(outcomes, OUTCOME_ABSORBED, quanta - rest);
  add_outcome(outcomes, OUTCOME_SEGMENTS, segments);
}

// The last item of a list that begins at this photon or before it, by bisection. first: first_photon of item 0, which
// is repeated every `stride` words.
static inline int last_from(__global const uint* first, int stride, int count, uint photon) {
  int low = 0, high = count - 1;
  while (low < high) {
    const int middle = (low + high + 1) >> 1;
    if (first[middle * stride] <= photon)
      low = middle;
    else
      high = middle - 1;
  }
  return low;
}

static inline int emitter_of(__global const DeviceEmitter* emitters, int count, uint photon) {
  return last_from(&emitters->first_photon, sizeof(DeviceEmitter) / sizeof(uint), count, photon);
}

// The order in which the photons 0 .. count - 1 of a launch are followed: in each 4096, by the number with its bits
// reversed. Points of a Sobol sequence whose numbers agree in their lowest bits are close together, so successive
// photons mostly meet the same nodes and triangles. Sums of whole numbers do not depend on the order.
static inline uint neighbours_follow(uint number, uint count) {
  const uint first = number & ~0xfffu;
  return first + 0x1000u <= count ? first | reverse_bits(number) >> 20 : number;
}

// A photon's emitter and its random numbers at the start.
typedef struct {
  int emitter;
  float4 emission;  // in [0, 1): target, direction (2); w: the film's dither
  float2 place;     // in [0, 1): on an area light, or in the environment
  float wavelength; // in [0, 1): chooses a wavelength of its cluster
  float number;     // in [0, 1): chooses a cluster and a wavelength of all that the light has
} PhotonStart;

// The start of photon `photon` of the batch or pass with the number `iteration`. first_iteration: the first with this
// allocation of photons to the emitters (DeviceEmitter::sequence_start is for it). Low discrepancy: the photons of a
// light for one half of the film follow one sequence, pass after pass, so that those of all clusters together are
// spread evenly. Its fourth number chooses the cluster and the wavelength in it. It has 32 bits, of which the choice of
// the cluster takes up to 24; plain random bits below them make the wavelength as fine as any. The halves must be
// independent, so they have sequences of their own.
COMPILED_ONCE PhotonStart photon_start(__global const DeviceEmitter* emitters, int emitter_count,
                                       __global const DeviceLight* lights, uint2 seed, uint iteration,
                                       uint first_iteration, uint photon) {
  PhotonStart start;
  start.emitter = emitter_of(emitters, emitter_count, photon);
  start.emission = random4(seed, iteration, photon, 0u, STREAM_PHOTONS);
  start.wavelength = 0.0f;
  start.place = (float2)(0.0f);
  const DeviceEmitter emitter = emitters[start.emitter];
  __global const DeviceLight* light = lights + emitter.light;
  const bool placed = has_places(light);
#if NEPHROID_LOW_DISCREPANCY
  const ulong start_of_allocation = (ulong)emitter.sequence_start_high << 32 | emitter.sequence_start;
  const ulong number = start_of_allocation +
                       (ulong)((iteration - first_iteration) / NEPHROID_FILM_HALVES) * emitter.light_photon_count +
                       (photon - emitter.light_first_photon);
  const uint index = (uint)number; // a sequence has 2^32 points; then another begins
  const uint3 sequence =
      (uint3)(emitter.sequence, (uint)light->number, (uint)(number >> 32) << 3 | iteration % NEPHROID_FILM_HALVES);
  const uint4 bits = sobol4_bits(seed, sequence, 0u, index);
  const uint below = (uint)(start.emission.x * 0x1p24f);         // 24 more bits of the fourth number
  start.emission.xyz = convert_float3(bits.zxy >> 8) * 0x1p-24f; // the first two dimensions are the best pair
  if (placed) start.place = sobol4(seed, sequence, 1u, index).xy;
  // The fourth number times the light's photons: a whole photon above, a fraction of 32 bits below. Fits 2^32 photons.
  const ulong count = emitter.light_photon_count, place = bits.w * count + (below * count >> 24);
  const uint chosen_photon = emitter.light_first_photon + (uint)(place >> 32);
  start.emitter = emitter_of(emitters, emitter_count, chosen_photon);
  __global const DeviceEmitter* const chosen = emitters + start.emitter;
  const float within = (float)(chosen_photon - chosen->first_photon) + (float)(uint)place * 0x1p-32f;
  start.wavelength = clamp(within / (float)chosen->photon_count, 0.0f, 0x1.fffffep-1f);
  start.number = (float)bits.w * 0x1p-32f;
#else
  if (NEPHROID_JITTER || NEPHROID_DIFFERENTIALS || NEPHROID_LOSSES || placed) {
    const float4 more = random4(seed, iteration, photon, 1u, STREAM_PHOTONS);
    start.place = more.xy;
    start.wavelength = more.z;
  }
  start.number = ((float)(photon - emitter.light_first_photon) + start.wavelength) / (float)emitter.light_photon_count;
#endif
  return start;
}

#if NEPHROID_JITTER && NEPHROID_UNSPLIT
// Gives a photon's band the light of all clusters, until the path is split.
static inline void carry_all_of_light(const World* world, __global const DeviceEmitter* emitters, int emitter_count,
                                      const PhotonStart* start, Band* band) {
  const DeviceEmitter emitter = emitters[start->emitter];
  const uint all = emitter.light_photon_count;
  DrawnWavelength others[3];
  float chances[3];
  for (int i = 0; i < 3; ++i) {
    const float place = quarters_on(start->number, i + 1) * (float)all;
    const DeviceEmitter other = emitters[emitter_of(emitters, emitter_count,
                                                    emitter.light_first_photon + min((uint)place, all - 1u))];
    const float before = (float)(other.first_photon - emitter.light_first_photon),
                within = (place - before) / (float)other.photon_count;
    chances[i] = (float)other.photon_count / (float)all;
    others[i] = draw_wavelength(world, emitter.light, other.cluster, clamp(within, 0.0f, 0x1.fffffep-1f));
  }
  carry_all(band, others[0], others[1], others[2],
            (float4)((float)emitter.photon_count / (float)all, chances[0], chances[1], chances[2]));
}
#endif

// A photon's end: where it ended, and how much of its power was left.
typedef struct {
  int outcome;     // OUTCOME_*
  int segments;    // rays of its path
  float share;     // of the light's power that it began with
  float left;      // part of that, 0..1 in the mean
  Surface surface; // the surface of a deposit
  uint triangle;
  float3 xyz; // for a deposit: reflected light, as if the photon carried the light's whole power
} PhotonEnd;
