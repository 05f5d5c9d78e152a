// SPDX-License-Identifier: Apache-2.0
// A photon's way from a light to its end. In a scene with a meter it adds its light there on the way.
#include "kernels/photons/photon_start.h"
#include "kernels/tracing/meter.h"
#include "kernels/transport/scatter_path.h"

typedef struct {
  Band band;
  uint2 seed;
  uint iteration, photon;
  bool met_caustic_object;
  SET_ASIDE float4 u;
#if NEPHROID_METER
  MeterFilm film;
  Source source;
  float watts; // as if the band had all of the light's power
#endif
} Visitor;

static inline Band visitor_band(const Visitor* photon) { return photon->band; }

static inline WalkNumbers visitor_numbers(Visitor* photon, const Interaction* at, int n) {
  if ((n & 3) == 0)
    photon->u = random4(photon->seed, photon->iteration, photon->photon, 2u + (uint)n / 4u, STREAM_PHOTONS);
  const float4 u = photon->u;
  photon->u = u.yzwx;
  const WalkNumbers numbers = {
      u.x, microfacet_numbers(photon->seed, photon->iteration, photon->photon, (uint)n, STREAM_PHOTONS)};
  return numbers;
}

// What comes straight from the light to a coat is reflected: what reaches the base is direct light.
static inline uint visitor_lobes(const Visitor* photon, const Interaction* at, int n) {
  return photon->met_caustic_object || is_only_matt(&at->material) ? LOBES_ALL : LOBES_ALL & ~LOBE_DIFFUSE;
}

static inline bool visit_scatter(const World* world, Visitor* photon, Path* path, const Interaction* at,
                                 const ScatterSample* sample, int n) {
  if (!photon->met_caustic_object && has_coat(&at->material)) lose_to_base(path, sample);
  photon->met_caustic_object = true;
  return true;
}

#if NEPHROID_METER
static inline void measure(const World* world, Visitor* photon, const Path* path, int cell) {
  if (cell < 0 || !photon->met_caustic_object) return;
  const float3 xyz =
      carried_light(world, &path->throughput, photon->source, &photon->band, white_reflector()).xyz;
  add_to_cell(world, &photon->film, cell, xyz * photon->watts);
}

static inline void visit_segment(const World* world, Visitor* photon, const Path* path, const Hit* hit) {
  measure(world, photon, path, cell_crossed(world, photon->film.meter, path, hit->t));
}

static inline void visit_surface(const World* world, Visitor* photon, const Path* path, const Interaction* at, int n) {
  measure(world, photon, path, cell_met(world, photon->film.meter, &at->surface, path->direction));
}

#define WALK_SEGMENTS
#define WALK_SURFACES
#endif

#define WALK_LOBES
#define WALK_SCATTERS
#include "kernels/transport/walk.h"

static inline Visitor photon_visitor(const Band* band, uint2 seed, uint iteration, uint photon) {
  Visitor visitor;
  visitor.band = *band;
  visitor.seed = seed;
  visitor.iteration = iteration;
  visitor.photon = photon;
  visitor.met_caustic_object = false;
  visitor.u = (float4)(0.0f);
  return visitor;
}

// Follows a photon to the first matt surface, out of the scene, or to its last surface. Leaves `path` on its last way.
// Does not work out what is left of the photon.
static inline PhotonEnd follow_photon(const World* world, Visitor* visitor, Path* path) {
  PhotonEnd end;
  Hit hit;
  Interaction at;
  int surfaces;
  const int how = walk(world, visitor, path, &hit, false, 0, &at, &surfaces);
  const bool met = visitor->met_caustic_object;
  end.outcome = how == WALK_LOST      ? OUTCOME_LOST
                : how == WALK_AT_BASE ? (met ? OUTCOME_DEPOSITED : OUTCOME_MISSED)
                                      : (met ? OUTCOME_ESCAPED : OUTCOME_MISSED);
  end.segments = surfaces + 1;
  end.left = 1.0f;
  if (how == WALK_AT_BASE) {
    end.surface = at.surface;
    end.triangle = at.triangle;
  }
  return end;
}

// The same of a photon in a band.
static inline PhotonEnd trace_way(const World* world, const Band* band, Path* path, uint2 seed, uint iteration,
                                  uint photon) {
  Visitor visitor = photon_visitor(band, seed, iteration, photon);
  return follow_photon(world, &visitor, path);
}

// Like trace_way, but also works out what is left and its colour. share: of the light's power in the photon's band.
COMPILED_ONCE PhotonEnd trace_photon(const World* world, Source source, const Band* band, float share, Path* path,
                                     uint2 seed, uint iteration, uint photon) {
  PhotonEnd end = trace_way(world, band, path, seed, iteration, photon);
  if (end.outcome == OUTCOME_DEPOSITED) {
    const Reflector reflector = reflector_at(world, &end.surface, end.triangle);
    end.xyz = carried_light(world, &path->throughput, source, band, reflector).xyz;
  }
  end.share = share_at_end(world, &path->throughput, source, band, share);
  end.left = power_left(world, &path->throughput, source, band, end.share);
  return end;
}
