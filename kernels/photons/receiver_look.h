// SPDX-License-Identifier: Apache-2.0
// What a path from the eye finds of light on receivers (receiver.h) at its end: the mean over its footprint, of each
// layer at a place of its own where glass has split its wavelengths.
#include "kernels/lights/transmittance.h"
#include "kernels/photons/receiver.h"
#include "kernels/transport/differential.h"
#include "kernels/transport/piece.h"
#include "kernels/transport/sweep.h"

// Through curved glass a footprint may be far larger than a pixel's width without glass. It is no wider than so many of
// these: what is beyond is bent, and would be seen from here as if it were not.
#define FOOTPRINT_WIDEST 4.0f

// The footprint of a path on the diffuse surface where it ends: that of the sample's piece of its pixel.
typedef struct {
  float3 a, b;
  float2 place; // in the piece
} EyeFootprint;

// place, edges: of the sample in its pixel and of its piece. eye: where the path has begun. spread: of EyeBranch; where
// chance has chosen one way of many, that one's place is in the middle of the footprint.
static inline EyeFootprint eye_footprint(const DeviceCamera* eye, const Path* path, const Surface* surface,
                                         float spread, float2 place, float2 edges) {
  const float way = dot(surface->position - path->origin, path->direction),
              pixel = 2.0f * eye->tan_x / (float)eye->width *
                      (eye->orthographic ? 1.0f : distance(surface->position, eye->position.xyz)),
              widest = FOOTPRINT_WIDEST * pixel;
  const float3 a = transferred(&path->by_place[0], path->direction, way, surface->geometric),
               b = transferred(&path->by_place[1], path->direction, way, surface->geometric);
  EyeFootprint footprint = {edges.x * fmin(1.0f, widest / length(a)) * a,
                            edges.y * fmin(1.0f, widest / length(b)) * b, place / edges - floor(place / edges)};
  const float least = edges.x * spread * way;
  if (least > fmax(length(footprint.a), length(footprint.b))) {
    make_frame(surface->geometric, &footprint.a, &footprint.b);
    footprint.a *= least;
    footprint.b *= least;
    footprint.place = (float2)(0.5f);
  }
  return footprint;
}

static inline float side_of_arrival(const Path* path, const Surface* surface) {
  return dot(path->direction, surface->geometric) < 0.0f ? 1.0f : -1.0f;
}

// Where a layer's wavelengths lie in the spectrum, from the first place on and before the last (member_at).
static inline float2 places_of_layer(const Receivers* on, int layer) {
  return (float2)(on->layer_places[layer], on->layer_places[layer + 1]);
}

// How much of a layer's light belongs to the places low ... high.
static inline float part_of_layer(float2 places, float low, float high) {
  return fmax(fmin(places.y, high) - fmax(places.x, low), 0.0f) / (places.y - places.x);
}

// The light of some layers on a surface that the path arrives at. totals: of the half.
static inline LightOfKinds look_of_path(const World* world, const Receivers* on, __global const float* totals,
                                  const Path* path, const EyeFootprint* footprint, const Surface* surface,
                                  int first_layer, int layers, const float* weights) {
  return look_at_receiver(on, surface, side_of_arrival(path, surface), footprint->a, footprint->b, footprint->place,
                          totals + 3 * PAGE_TEXELS * (size_t)first_layer, layers, weights);
}

// The part of the spectrum that a path stands for at its end, and what is left of its light.
static inline Band band_shown(const Path* path, const Band* band, const Parts** parts) {
  Band shown = *band;
  *parts = &path->throughput.own;
  if (!is_unsplit(&path->throughput, band)) return shown;
  *parts = &path->throughput.all;
  shown.within = band->low + band->size * band->within;
  shown.low = 0.0f;
  shown.size = 1.0f;
  return shown;
}

// The layer of the wavelength that carries the colour of a band's quarter.
static inline int layer_of_carrier(const World* world, const Receivers* on, const Band* shown, int quarter) {
  const Member carrier = member_at(world, shown->low + shown->size * quarters_on(shown->within, quarter));
  return layer_of(on, world->tables.cluster_wavelengths[carrier.number]);
}

// What a path shows of the light where it ends, if all its wavelengths end there, or with `alone` its leader. It counts
// for the whole spectrum, so it is not to be divided by the chance of its band.
static inline LightOfKinds light_of_end(const World* world, const Receivers* on, __global const float* totals,
                                  const EyeFootprint* footprint, const Path* path, const Surface* surface,
                                  uint triangle, const Band* band, bool alone) {
  const Throughput* throughput = &path->throughput;
  const bool is_whole = !throughput->is_split && is_full(throughput);
  float weights[MOST_LAYERS];
  for (int layer = 0; layer < on->layers; ++layer) weights[layer] = 1.0f;
  if (!is_whole && on->layers > 1) {
    if (!NEPHROID_JITTER || alone) {
      const int own = layer_of_band(on, &world->tables, band);
      const float2 places = places_of_layer(on, own);
      for (int layer = 0; layer < on->layers; ++layer)
        weights[layer] = layer == own ? part_left(throughput) / (places.y - places.x) : 0.0f;
    } else {
      const Parts* parts;
      const Band shown = band_shown(path, band, &parts);
      for (int layer = 0; layer < on->layers; ++layer)
        weights[layer] = parts->middle / shown.size *
                         part_of_layer(places_of_layer(on, layer), shown.low, shown.low + shown.size);
      for (int i = 0; i < (are_coloured(parts) ? 4 : 0); ++i) {
        const int layer = layer_of_carrier(world, on, &shown, i);
        const float2 places = places_of_layer(on, layer);
        weights[layer] += 0.25f * (number_of_four(parts->four, i) - parts->middle) / (places.y - places.x);
      }
    }
  }
  LightOfKinds light = look_of_path(world, on, totals, path, footprint, surface, 0, on->layers, weights);
  if (is_whole || on->layers > 1) return light;
  const float3 left = transmittance(world, throughput, band, reflector_at(world, surface, triangle));
  light.caustic *= left;
  light.indirect *= left;
  return light;
}

// The same of a quarter of the band, whose light ends on `surface`, each layer at a place of its own.
static inline LightOfKinds light_of_quarter(const World* world, const Receivers* on, __global const float* totals,
                                      const EyeFootprint* footprint, const Path* path, const Surface* surface,
                                      const Band* band, int i) {
  const Parts* parts = &path->throughput.own;
  const Band quarter = quarter_of_band(band, i);
  const float last_place = quarter.low + quarter.size;
  const int carrier = are_coloured(parts) ? layer_of_carrier(world, on, band, i) : -1;
  LightOfKinds light = {(float3)(0.0f), (float3)(0.0f)};
  for (int layer = 0; layer < on->layers; ++layer) {
    const float2 places = places_of_layer(on, layer);
    const float low = fmax(places.x, quarter.low), high = fmin(places.y, last_place);
    if (!(high > low)) continue;
    Surface of_layer = *surface;
    const int wavelength = wavelength_at(world, low + band->within * (high - low), 1.0f).wavelength;
    float3 place;
    if (stretched_place(path, surface, beyond_leader(world, band, wavelength), &place)) of_layer.position = place;
    const float weight = parts->middle / band->size * part_of_layer(places, quarter.low, last_place);
    add_light(&light, 1.0f, look_of_path(world, on, totals, path, footprint, &of_layer, layer, 1, &weight));
  }
  if (carrier < 0) return light;
  const float2 places = places_of_layer(on, carrier);
  const float weight = 0.25f * (number_of_four(parts->four, i) - parts->middle) / (places.y - places.x);
  add_light(&light, 1.0f, look_of_path(world, on, totals, path, footprint, surface, carrier, 1, &weight));
  return light;
}
