// SPDX-License-Identifier: Apache-2.0
// Where the light of one facet falls on a receiver: app/inverse/assign/footprint.h, which has the reasons, in single precision.
#ifndef NEPHROID_FOOTPRINT_H
#define NEPHROID_FOOTPRINT_H

// 0: parallel light falls straight on every facet.
#ifndef NEPHROID_INCOMING
#define NEPHROID_INCOMING 1
#endif

// 0: light is of one direction and one wavelength.
#ifndef NEPHROID_SPREAD
#define NEPHROID_SPREAD 1
#endif

#include "kernels/inverse/bending.h"
#include "kernels/inverse/facet_types.h"

// Along one axis, in cells: a box that another box smears, a trapezoid.
typedef struct {
  float middle, reach; // reach: half of its whole width
  float even;          // half of the width over which it is even
  float one_over_width, tail; // tail: 1 / (2 width blur)
} Beam;

static inline Beam beam_of(float middle, float width, float blur)
{
  const float a = fmax(fmax(width, blur), 1e-6f), b = fmin(width, blur);
  const Beam beam = {middle, 0.5f * (a + b), 0.5f * (a - b), 1.0f / a, 0.5f / (a * fmax(b, 1e-12f))};
  return beam;
}

// The part of a beam before t.
static inline float part_before(Beam beam, float t)
{
  const float at = t - beam.middle, rest = fmax(0.0f, beam.reach - fabs(at));
  if (fabs(at) <= beam.even) return 0.5f + at * beam.one_over_width;
  const float tail = fmin(0.5f, rest * rest * beam.tail);
  return at < 0.0f ? tail : 1.0f - tail;
}

// Part of the beam on a cell.
static inline float part_on(Beam beam, int cell) { return part_before(beam, (float)(cell + 1)) - part_before(beam, (float)cell); }

// The cells that a beam touches, of those that there are.
static inline int first_cell(Beam beam, int cells) { return (int)clamp(floor(beam.middle - beam.reach), 0.0f, (float)cells); }
static inline int end_of_cells(Beam beam, int cells) { return (int)clamp(ceil(beam.middle + beam.reach), 0.0f, (float)cells); }

typedef struct {
  Beam x, y;
} Footprint;

static inline float2 middle_of_facet(const DeviceLayout* layout, uint facet)
{
  const float column = (float)(facet % (uint)layout->columns), row = (float)(facet / (uint)layout->columns);
  return (float2)((column + 0.5f) * layout->facet_x - 0.5f * layout->size_x, 0.5f * layout->size_y - (row + 0.5f) * layout->facet_y);
}

static inline float2 in_cells(const DeviceLayout* layout, float2 p)
{
  return (float2)((p.x + 0.5f * layout->receiver_x) / layout->cell_x, (0.5f * layout->receiver_y - p.y) / layout->cell_y);
}

// A facet, and what does not depend on its slope.
typedef struct {
  float2 middle, sines, around;
  float4 spread; // columns
  float power, height;
} Facet;

static inline Facet facet_at(const DeviceLayout* layout, global const DeviceIncoming* incoming, global const float* heights, uint index)
{
  Facet facet = {middle_of_facet(layout, index), (float2)(0.0f), (float2)(0.0f), (float4)(0.0f), 1.0f, heights[index]};
#if NEPHROID_INCOMING
  const DeviceIncoming in = incoming[index];
  facet.sines = (float2)(in.sines[0], in.sines[1]);
  facet.around = (float2)(in.around[0], in.around[1]);
  facet.spread = (float4)(in.spread[0], in.spread[1], in.spread[2], in.spread[3]);
  facet.power = in.power;
#endif
  return facet;
}

// The part of a facet whose light reaches the receivers: its middle and size in parts of the facet.
typedef struct {
  float2 middle, size;
} LitPart;

static inline LitPart lit_part(const Facet* facet, float2 inside, float2 slope, float2 g)
{
  const float2 step = 0.5f * (g + facet->around);
  const float2 shadow = fmax(inside * step, (float2)(0.0f)) / fmax(0.1f, 1.0f + dot(inside, g));
  const float2 stopped = fmax(slope * step, (float2)(0.0f)) / fmax(0.1f, 1.0f + dot(slope, g));
  const LitPart lit = {0.5f * (sign(inside) * shadow - sign(slope) * stopped), fmax((float2)(1.0f) - shadow - stopped, (float2)(0.0f))};
  return lit;
}

// A slope of a facet, and what is the same for all receivers.
typedef struct {
  float2 slope;
  float4 map; // of places on the facet to places on a receiver at distance 0: columns
  float4 map_by_distance;
  LitPart lit;
  float2 variance; // of the slope
  float power;     // in facets that send all of their light
} Beams;

static inline float disc_variance(float2 by, float2 sines, float radius)
{
  const float along = dot(by, sines);
  return 0.25f * radius * radius * (dot(by, by) - along * along);
}

static inline Beams beams_of(const DeviceLayout* layout, const Facet* facet, float2 slope)
{
  const float n = layout->n;
  const float2 g = facet_gradient(slope, n, facet->sines);
  Beams beams = {slope,
                 (float4)(1.0f + slope.x * g.x, slope.y * g.x, slope.x * g.y, 1.0f + slope.y * g.y),
                 (float4)(0.0f),
                 {(float2)(0.0f), (float2)(1.0f)},
                 (float2)(layout->scatter * layout->scatter),
                 transmitted(slope, n, facet->sines) / transmitted((float2)(0.0f), n, facet->sines)};
#if NEPHROID_INCOMING
  const float2 inside = slope_inside(facet->sines, n);
  if (!layout->free_heights) beams.lit = lit_part(facet, inside, slope, g);
  beams.power *= facet->power * (1.0f + dot(inside, g)) * beams.lit.size.x * beams.lit.size.y;
#endif
#if NEPHROID_SPREAD || NEPHROID_INCOMING
  const SlopeChange change = slope_change(slope, n, facet->sines);
#endif
#if NEPHROID_SPREAD
  beams.variance += (float2)(disc_variance((float2)(change.by_sine_x.x, change.by_sine_y.x), facet->sines, layout->sun_radius),
                             disc_variance((float2)(change.by_sine_x.y, change.by_sine_y.y), facet->sines, layout->sun_radius)) +
                    layout->index_variance * change.by_index * change.by_index;
#endif
#if NEPHROID_INCOMING
  if (layout->spreads > 0.0f) { // by_sines * spread * (1 + inside g^T)
    const float4 s = facet->spread, m = (float4)(1.0f + inside.x * g.x, inside.y * g.x, inside.x * g.y, 1.0f + inside.y * g.y);
    const float4 around = (float4)(s.x * m.x + s.z * m.y, s.y * m.x + s.w * m.y, s.x * m.z + s.z * m.w, s.y * m.z + s.w * m.w);
    beams.map_by_distance = (float4)(change.by_sine_x * around.x + change.by_sine_y * around.y, change.by_sine_x * around.z + change.by_sine_y * around.w);
  }
#endif
  return beams;
}

static inline Footprint footprint(const DeviceLayout* layout, const Facet* facet, const Beams* beams, float distance)
{
  const float way = distance + facet->height;
  const float4 map = beams->map + way * beams->map_by_distance;
  const float2 size = (float2)(layout->facet_x, layout->facet_y), from = beams->lit.middle * size, lit = beams->lit.size * size;
  const float2 at = in_cells(layout, facet->middle + (float2)(map.x * from.x + map.z * from.y, map.y * from.x + map.w * from.y) + beams->slope * way);
  const float2 blur = 12.0f * way * way * beams->variance;
  const float across = map.z * lit.y, down = map.y * lit.x;
  const Footprint print = {beam_of(at.x, fabs(map.x) * lit.x / layout->cell_x, sqrt(across * across + blur.x) / layout->cell_x),
                           beam_of(at.y, fabs(map.w) * lit.y / layout->cell_y, sqrt(down * down + blur.y) / layout->cell_y)};
  return print;
}

#endif
