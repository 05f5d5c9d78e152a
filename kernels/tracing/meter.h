// SPDX-License-Identifier: Apache-2.0
// A meter in the place of the camera (app/scene/meter.h): its pixels are cells of a surface. Their pieces are
// primitives that no ray meets. Paths begin on them; photons add to the cell that they cross.
#include "kernels/tracing/camera.h"
#include "kernels/tracing/film.h"

#if NEPHROID_METER
// The cell of a place, or -1.
static inline int cell_at(const World* world, __global const DeviceMeterChart* chart, float3 place) {
  const float x = (dot(place, chart->right.xyz) - chart->right.w) * chart->columns_per_unit;
  const float y = (chart->up.w - dot(place, chart->up.xyz)) * chart->rows_per_unit;
  if (!(x >= 0.0f && x < (float)chart->columns && y >= 0.0f && y < (float)chart->rows)) return -1;
  return world->meter_cells[chart->first + (int)y * chart->columns + (int)x];
}

// The cell of a meter in the air that a path crosses from its front, up to its next hit; -1: none. Of several charts,
// which are a box about the path, it crosses one.
static inline int cell_crossed(const World* world, const DeviceCamera* meter, const Path* path, float t) {
  if (meter->receiver >= 0) return -1;
  for (int i = 0; i < meter->meter_charts; ++i) {
    __global const DeviceMeterChart* chart = world->meter_charts + i;
    const float falls = -dot(path->direction, chart->normal.xyz);
    if (!(falls > 0.0f)) continue;
    const float at = (dot(path->origin, chart->normal.xyz) - chart->normal.w) / falls;
    if (!(at > 0.0f && at <= t)) continue;
    const int cell = cell_at(world, chart, path->origin + at * path->direction);
    if (cell >= 0) return cell;
  }
  return -1;
}

// The cell of a meter on an object's surface that light meets from the front; -1: none. A surface that is not flat has
// a chart for each side that it faces, in the order of the axes.
static inline int cell_met(const World* world, const DeviceCamera* meter, const Surface* surface, float3 arriving) {
  if (surface->object != meter->receiver) return -1;
  const float3 place = surface->position;
  const float4 low = world->meter_limits[0], high = world->meter_limits[1], facing = world->meter_limits[2];
  if (any(place < low.xyz) || any(place > high.xyz) || dot(surface->geometric, facing.xyz) < facing.w) return -1;
  for (int i = 0; i < meter->meter_charts; ++i) {
    __global const DeviceMeterChart* chart = world->meter_charts + i;
    const float faces = dot(surface->geometric, chart->normal.xyz);
    const float3 sizes = fabs(surface->geometric);
    const bool is_flat = chart->is_flat != 0;
    if (is_flat ? fabs(faces) < 0.5f : faces < max(sizes.x, max(sizes.y, sizes.z))) continue;
    const float3 outwards = is_flat ? chart->normal.xyz : surface->geometric;
    return dot(arriving, outwards) < 0.0f ? cell_at(world, chart, place) : -1;
  }
  return -1;
}

// What a photon adds to the cells that it crosses.
typedef struct {
  const DeviceCamera* meter;
  volatile __global long* film; // of its replicate
  float scale;                  // quanta per unit of radiance
  SET_ASIDE float dither;
  SET_ASIDE int refused; // contributions, by the film
  SET_ASIDE long moment; // of the others: squared(), times the cell's worth
  __global const float* worth; // [cell]: how much its noise matters, 0..1
} MeterFilm;

// worth: null where nobody asks for the moment.
static inline MeterFilm meter_film(const DeviceCamera* meter, volatile __global long* film, float scale, float dither,
                                   __global const float* worth) {
  const MeterFilm result = {meter, film, scale, dither, 0, 0, worth};
  return result;
}

// xyz: of the photon's power.
static inline void add_to_cell(const World* world, MeterFilm* to, int cell, float3 xyz) {
  const float3 radiance = xyz * (world->meter_density[cell] / PI_F);
  if (!film_add_dithered(to->film, cell, radiance, to->scale, FILM_LIMIT, to->dither))
    ++to->refused;
  else if (to->worth)
    to->moment += convert_long_rte(to->worth[cell] * (float)squared(radiance, to->scale));
  to->dither += 0.61803399f; // each has its own
  to->dither -= floor(to->dither);
}

// A place of a cell, as what a ray against its normal meets at once. place: in [0, 1) x [0, 1). The camera moves there.
static inline Hit hit_of_cell(const World* world, DeviceCamera* meter, uint cell, float2 place, float3* direction) {
  const int first = world->meter_pieces[cell], count = world->meter_pieces[cell + 1] - first;
  __global const float* chances = world->meter_chances + first;
  const int piece = choose(chances, count, place.x);
  const float before = chance_before(chances, piece);
  const float root = sqrt(clamp((place.x - before) / (chances[piece] - before), 0.0f, 1.0f));
  Hit hit;
  hit.t = 0.0f;
  hit.u = root * (1.0f - place.y);
  hit.v = root * place.y;
  hit.primitive = (uint)(meter->first_piece + first + piece);
#if NEPHROID_ELLIPSOIDS
  hit.w = 0.0f;
#endif
  const Surface surface = surface_at(&world->geometry, hit);
  *direction = -surface.geometric;
  meter->position.xyz = start_on_side(&surface, 1.0f);
  return hit;
}
#endif
