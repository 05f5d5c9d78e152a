// SPDX-License-Identifier: Apache-2.0
// The layer "background": paths from the eye that meet no diffuse surface, straight or through glass and mirrors, end
// at the environment.
// 1: the environment is a light. Where it is none, its peaks are not known.
#ifndef NEPHROID_SKY_IS_LIGHT
#define NEPHROID_SKY_IS_LIGHT 1
#endif
#define NEPHROID_PLACE_DIFFERENTIALS NEPHROID_SKY_IS_LIGHT
#include "kernels/photons/launch_types.h"
#include "kernels/tracing/item_kernel.h"
#include "kernels/transport/branches.h"
#include "kernels/transport/eye_band.h"
#include "kernels/transport/piece.h"
#include "kernels/transport/sweep.h"

// The wavelengths of paths: here they lie one after the other, by the chances of a path through glass.
typedef struct {
  __global const float* cdf;    // [401]
  __global const int* clusters; // [401]: of each wavelength
} SpectrumChoice;

// The part of a wavelength that lies before a place.
static inline float part_before(const SpectrumChoice* choice, int wavelength, float place) {
  const float before = chance_before(choice->cdf, wavelength);
  return clamp((place - before) / (choice->cdf[wavelength] - before), 0.0f, 1.0f);
}

// XYZ of a colour in the part of the spectrum from one place to another.
static inline float3 xyz_of_part(const Background* background, const SpectrumChoice* choice, float3 rgb, float low,
                                 float high) {
  const int first = choose(choice->cdf, WAVELENGTH_COUNT, low),
            last = choose(choice->cdf, WAVELENGTH_COUNT, fmin(high, 0x1.fffffep-1f));
  const float in_last = high < 1.0f ? part_before(choice, last, high) : 1.0f;
  return background_xyz(background, rgb, first, last) -
         part_before(choice, first, low) * background_xyz(background, rgb, first, first + 1) +
         in_last * background_xyz(background, rgb, last, last + 1);
}

static inline DrawnWavelength drawn_at(const SpectrumChoice* choice, float place, float size) {
  const int wavelength = choose(choice->cdf, WAVELENGTH_COUNT, fmin(place, 0x1.fffffep-1f));
  const DrawnWavelength drawn = {wavelength,
                                 size / (choice->cdf[wavelength] - chance_before(choice->cdf, wavelength))};
  return drawn;
}

// As choose_eye_band.
static inline Band choose_background_band(const SpectrumChoice* choice, float place, uint parts) {
  const float size = 1.0f / (float)parts, low = floor(place * (float)parts) * size, within = (place - low) / size;
  DrawnWavelength own[4], all[4];
  for (int i = 0; i < 4; ++i) {
    own[i] = drawn_at(choice, low + size * quarters_on(within, i), size);
    all[i] = drawn_at(choice, quarters_on(place, i), size);
  }
  Band band = one_wavelength(choice->clusters[own[0].wavelength], own[0].wavelength, own[0].weight);
  band.own = carriers_of(own[0], own[1], own[2], own[3], drawn_at(choice, low + 0.5f * size, size).wavelength);
  band.all = carriers_of(all[0], all[1], all[2], all[3], WAVELENGTH_COUNT / 2);
  band.low = low;
  band.within = within;
  band.size = band.chance = size;
  return band;
}

// XYZ of what a path leaves of a colour: in its part of the spectrum, or in all of it, as coloured_light does.
static inline float3 shown_after(const Background* background, const SpectrumChoice* choice, float3 rgb,
                                 const Throughput* throughput, const Band* band) {
  const bool unsplit = is_unsplit(throughput, band);
  const Parts* parts = unsplit ? &throughput->all : &throughput->own;
  const Carriers* carriers = unsplit ? &band->all : &band->own;
  float3 xyz = parts->middle * (unsplit ? band->chance * background_xyz(background, rgb, 0, WAVELENGTH_COUNT)
                                        : xyz_of_part(background, choice, rgb, band->low, band->low + band->size));
  if (!are_coloured(parts)) return xyz;
  for (int i = 0; i < 4; ++i) {
    const int w = number_of_four_wavelengths(carriers, i);
    xyz += number_of_four(carriers->weights, i) * (number_of_four(parts->four, i) - parts->middle) *
           background_xyz(background, rgb, w, w + 1);
  }
  return xyz;
}

// The XYZ radiance of the environment at a path's end, in its part of the spectrum. Where the path's wavelengths go
// different ways, each quarter of the part has a direction of its own. place: of the sample in its pixel.
IN_PLACE float3 shown_at_end(const World* world, const Background* background, const SpectrumChoice* choice,
                             const Path* path, const Band* band, float2 place, uint2 seed, uint frame, uint number,
                             uint pixel) {
  const bool swept = ends_of_band(world, path, band) == ENDS_SWEPT;
  float3 xyz = (float3)(0.0f);
  for (int i = 0; i < (swept ? 4 : 1); ++i) {
    Path way = *path;
    Band shown = *band;
    if (swept) {
      shown = quarter_of_band(band, i);
      const float x = beyond_leader(world, band, number_of_four_wavelengths(&band->own, i));
      way.direction = normalize(way.direction + x * way.differential.direction);
    }
#if NEPHROID_PLACE_DIFFERENTIALS
    const Piece piece = piece_of(&way, place, piece_edges(frame / NEPHROID_FILM_HALVES));
    const float3 rgb = rgb_of_piece(&world->sky, background, &piece, random4(seed, number, pixel, 0u, STREAM_PEAKS).xy);
#else
    const float3 rgb = background_rgb(background, way.direction);
#endif
    xyz += shown_after(background, choice, rgb, &path->throughput, &shown);
  }
  return xyz;
}

// samples: [count], each a pixel and the sample's number there.
ITEM_KERNEL(background, (WORLD_ARGUMENTS, __global const float* texels, __global const float4* primary_before,
                         DeviceBackground size, __global const float* spectrum_cdf,
                         __global const int* spectrum_clusters,
                         volatile __global long* film,
                         volatile __global long* energy, // [OUTCOME_COUNT]: only refused ones are counted
                         DeviceCamera camera, __global const uint2* samples, DeviceSampleLaunch launch),
                        (WORLD_NAMES, texels, primary_before, size, spectrum_cdf, spectrum_clusters, film, energy,
                         camera, samples, launch)) {
  const World world = WORLD;
  const Background background = {texels, primary_before, size};
  const SpectrumChoice choice = {spectrum_cdf, spectrum_clusters};
  if (index >= launch.count) return;
  const uint pixel = samples[index].x;
  SET_ASIDE uint frame = samples[index].y;
  SET_ASIDE float4 jitter = place_numbers(launch.seed, frame, pixel);
  float3 direction;
  EYE_OF(camera);
  const Hit hit = first_hit(&world, eye, pixel, jitter.xy, launch.seed, frame, &direction);

  SET_ASIDE float3 xyz = (float3)(0.0f);
  if (hit.primitive == NEPHROID_NO_PRIMITIVE) {
    xyz = background_xyz(&background, background_rgb(&background, direction), 0, WAVELENGTH_COUNT);
  } else {
    const DeviceMaterial met = material_of_hit(&world, &hit);
    if (is_only_matt(&met)) return;
    const uint paths = paths_through(&world, hit);
    for (uint i = 0; i < paths; ++i) {
      uint parts;
      const float place =
          place_in_spectrum(launch.seed, frame, i, paths, pixel, STREAM_BACKGROUND_WAVELENGTH, &parts);
      const Band band = choose_background_band(&choice, place, parts);
      const Path path = path_from_eye(eye, direction);
      Hit first = hit;
      Visitor branches;
      begin_branches(&branches, &path, &band, launch.seed, frame, i, paths, pixel, STREAM_BACKGROUND);
      do {
        Interaction at;
        int last;
        if (follow_branch(&world, &branches, &first, &at, &last) == WALK_LEFT)
          xyz += branches.branch.share * branches.branch.scale / (band.chance * (float)paths) *
                 shown_at_end(&world, &background, &choice, &branches.branch.path, &band, jitter.xy, launch.seed, frame,
                              branches.number, pixel + 0x9e3779b9u * branches.met);
      } while (next_branch(&branches));
    }
  }
  add_sample(film, energy, &camera, pixel, frame, xyz, launch.film_scale,
             limit_of_sample(frame, launch.enough, launch.film_limit), jitter.z);
}
