// SPDX-License-Identifier: Apache-2.0
// The layer "background": paths from the eye that meet no diffuse surface, straight or through glass and mirrors, end
// at the environment. A path has all wavelengths until glass sends them different ways, then one.
// 1: the environment is a light. Where it is none, its peaks are not known.
#ifndef NEPHROID_SKY_IS_LIGHT
#define NEPHROID_SKY_IS_LIGHT 1
#endif
#define NEPHROID_PLACE_DIFFERENTIALS NEPHROID_SKY_IS_LIGHT
#include "kernels/photons/launch_types.h"
#include "kernels/tracing/work_item.h"
#include "kernels/transport/eye_walk.h"
#include "kernels/transport/piece.h"

// XYZ of what a path leaves of a colour: in the wavelength that leads, or in all of them, as coloured_light does.
static inline float3 shown_after(const Background* background, float3 rgb, const Throughput* throughput,
                                 const Band* band) {
  if (!is_unsplit(throughput, band))
    return part_left(throughput) * band->weight * background_xyz(background, rgb, band->wavelength);
  const Parts* parts = &throughput->all;
  float3 xyz = parts->middle * background_xyz(background, rgb, WAVELENGTH_COUNT);
  if (!are_coloured(parts)) return xyz;
  const float4 weights = band->all.weights * (parts->four - parts->middle);
  const int4 w = band->all.wavelengths;
  return xyz + weights.x * background_xyz(background, rgb, w.x) + weights.y * background_xyz(background, rgb, w.y) +
         weights.z * background_xyz(background, rgb, w.z) + weights.w * background_xyz(background, rgb, w.w);
}

// What glass that a path leaves at once reflects of a colour, in all wavelengths. All go the same way. The share of
// bare glass at the mean index counts for all of them, and what this wavelength's differs from it for itself: little
// where there is no coating.
static inline float3 reflected_after(const World* world, const Background* background, float3 rgb, const Band* band,
                                     float scale, const ScatterSample* first) {
  __global const float* n_of = world->tables.index_of_cluster;
  const float n_i = first->near_material < 0 ? 1.0f : n_of[first->near_material],
              n_t = first->far_material < 0 ? 1.0f : n_of[first->far_material];
  const float cos_i = dot(first->direction, first->normal), cos_t = refracted_cosine(cos_i, n_i / n_t);
  const float share = cos_t < 0.0f ? 1.0f : fresnel_reflectance(cos_i, cos_t, n_i, n_t);
  return scale * share * background_xyz(background, rgb, WAVELENGTH_COUNT) +
         scale * (first->reflectance - share) * band->weight * background_xyz(background, rgb, band->wavelength);
}

// The XYZ radiance of the environment that the paths of a pixel's sample see which have met `first`, one of them by
// reflection there. The part that is seen by path i of PATHS_THROUGH_GLASS; 0 where it ends elsewhere.
IN_PLACE float3 seen_through(const World* world, const Background* background, Path path, Hit first, const Band* band,
                             float2 place, uint2 seed, uint frame, uint i, uint pixel) {
  const bool reflected = i == 0u;
  const uint sample = frame * PATHS_THROUGH_GLASS + i;
  Visitor eye = eye_visitor(band, seed, sample, PATHS_THROUGH_GLASS, pixel, STREAM_BACKGROUND);
  eye.first_lobes = reflected ? LOBE_REFLECTION : LOBE_TRANSMISSION;
  Hit hit = first;
  Interaction at;
  int last;
  const float left = follow_eye_path(world, &eye, &path, &hit, &at, &last);
  if (left == 0.0f || hit.primitive != NEPHROID_NO_PRIMITIVE) return (float3)(0.0f);
  const bool one_way = leaves_one_way(&eye.first), leaves = last == 0;
  const float part = 1.0f / (one_way ? PATHS_THROUGH_GLASS : reflected ? 1.0f : PATHS_THROUGH_GLASS - 1.0f);
  const float radiance_scale = part * eye.share * eye.radiance_scale;
#if NEPHROID_PLACE_DIFFERENTIALS
  const Piece piece = piece_of(&path, place, piece_edges(frame / NEPHROID_FILM_HALVES));
  const float3 rgb = rgb_of_piece(&world->sky, background, &piece, random4(seed, sample, pixel, 0u, STREAM_PEAKS).xy);
#else
  const float3 rgb = background_rgb(background, path.direction);
#endif
  if (leaves && reflected && !one_way && path.throughput.is_split && is_full(&path.throughput))
    return reflected_after(world, background, rgb, band, part, &eye.first);
  return radiance_scale * shown_after(background, rgb, &path.throughput, band);
}

// u: in [0, 1), chooses wavelengths by the chances of a path through glass.
static inline Band band_of_spectrum(__global const float* cdf, float u) {
  DrawnWavelength drawn[4];
  for (int i = 0; i < 4; ++i) {
    drawn[i].wavelength = choose(cdf, WAVELENGTH_COUNT, quarters_on(u, i));
    drawn[i].weight = 1.0f / (cdf[drawn[i].wavelength] - chance_before(cdf, drawn[i].wavelength));
  }
  Band band = one_wavelength(0, drawn[0].wavelength, drawn[0].weight);
  carry_all(&band, drawn[1], drawn[2], drawn[3], (float4)(1.0f));
  return band;
}

// samples: [count], each a pixel and the sample's number there.
__kernel void background(WORLD_ARGUMENTS, __global const float* texels, __global const float4* primary_xyz,
                         DeviceBackground size,
                         __global const float* spectrum_cdf, // [401]: chances of a path through glass
                         volatile __global long* film,
                         volatile __global long* energy, // [OUTCOME_COUNT]: only refused ones are counted
                         DeviceCamera camera, __global const uint2* samples, DeviceSampleLaunch launch) {
  const World world = WORLD;
  const Background background = {texels, primary_xyz, size};
  const uint index = work_item();
  if (index >= launch.count) return;
  const uint pixel = samples[index].x;
  SET_ASIDE uint frame = samples[index].y;
  SET_ASIDE float4 jitter = eye_numbers(launch.seed, frame, 1u, pixel, 0u, STREAM_BACKGROUND);
  float3 direction;
  EYE_OF(camera);
  const Hit hit = first_hit(&world, eye, pixel, jitter.xy, launch.seed, frame, STREAM_BACKGROUND, &direction);

  SET_ASIDE float3 xyz = (float3)(0.0f), outwards = direction;
  SET_ASIDE Hit first = hit;
  if (hit.primitive != NEPHROID_NO_PRIMITIVE) {
    const DeviceMaterial met = material_of_hit(&world, &hit);
    if (is_only_matt(&met)) return;
  }
  if (hit.primitive == NEPHROID_NO_PRIMITIVE)
    xyz = background_xyz(&background, background_rgb(&background, direction), WAVELENGTH_COUNT);
  else
    for (uint i = 0; i < PATHS_THROUGH_GLASS; ++i) {
      const float place = golden_place_of_four(launch.seed, frame, i, pixel, STREAM_BACKGROUND_WAVELENGTH);
      const Band band = band_of_spectrum(spectrum_cdf, place);
      xyz += seen_through(&world, &background, path_from_eye(eye, outwards), first, &band, jitter.xy, launch.seed,
                          frame, i, pixel);
    }
  add_sample(film, energy, &camera, pixel, frame, xyz, launch.film_scale,
             limit_of_sample(frame, launch.enough, launch.film_limit), jitter.z);
}
