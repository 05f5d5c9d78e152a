// SPDX-License-Identifier: Apache-2.0
// Where the light of one facet falls on a receiver: app/inverse/assign/footprint.h in single precision.
#ifndef NEPHROID_FOOTPRINT_H
#define NEPHROID_FOOTPRINT_H

// 0: parallel light falls straight on every facet.
#ifndef NEPHROID_INCOMING
#define NEPHROID_INCOMING 1
#endif

// 1: receivers have lights of their own.
#ifndef NEPHROID_LIGHTS
#define NEPHROID_LIGHTS 1
#endif

// 0: light has one direction and one wavelength.
#ifndef NEPHROID_SPREAD
#define NEPHROID_SPREAD 1
#endif

// Makes a function of its own: its registers are free again after it, and all callers get the same bits.
#define SEPARATE __attribute__((noinline))

#include "kernels/inverse/bending.h"
#include "kernels/inverse/facet_types.h"

// A beam along one axis, in cells: a box that another box smears, a trapezoid.
typedef struct {
  float middle, reach; // reach: half of its whole width
  float even;          // half of the width over which it is even
  float one_over_width, tail; // tail: 1 / (2 width blur)
} Beam;

static inline Beam beam_of(float middle, float width, float blur) {
  const float a = fmax(fmax(width, blur), 1e-6f), b = fmin(width, blur);
  const Beam beam = {middle, 0.5f * (a + b), 0.5f * (a - b), 1.0f / a, 0.5f / (a * fmax(b, 1e-12f))};
  return beam;
}

// The part of a beam before t.
static inline float part_before(Beam beam, float t) {
  const float at = t - beam.middle, rest = fmax(0.0f, beam.reach - fabs(at));
  if (fabs(at) <= beam.even) return 0.5f + at * beam.one_over_width;
  const float tail = fmin(0.5f, rest * rest * beam.tail);
  return at < 0.0f ? tail : 1.0f - tail;
}

static inline float part_on(Beam beam, int cell) {
  return part_before(beam, (float)(cell + 1)) - part_before(beam, (float)cell);
}

// An edge between cells as a number in 0..cells, however far off it is.
static inline int edge_cell(float edge, int cells) { return (int)clamp(edge, 0.0f, (float)cells); }

// Beams that are alike, each with its shift from the middle and its part of the light.
typedef struct {
  Beam x, y;
#if NEPHROID_SPREAD
  int groups, points; // groups of indices, and points of the light of each
  int light;          // whose points
  float2 by_index;    // what follows is in cells
  float2 by_x, by_y, by_z; // the shift of a point by its place
  float2 low, high;   // bounds of all shifts
#endif
} Footprint;

static inline float2 middle_of_facet(global const DeviceLayout* layout, uint facet) {
  const float column = (float)(facet % (uint)layout->columns), row = (float)(facet / (uint)layout->columns);
  return (float2)((column + 0.5f) * layout->facet_x - 0.5f * layout->size_x,
                  0.5f * layout->size_y - (row + 0.5f) * layout->facet_y);
}

static inline float2 in_cells(global const DeviceLayout* layout, DeviceReceiver receiver, float2 p) {
  return (float2)((p.x - receiver.x + 0.5f * layout->receiver_x) / layout->cell_x,
                  (0.5f * layout->receiver_y - (p.y - receiver.y)) / layout->cell_y);
}

// A facet, with what does not depend on its slope.
typedef struct {
  int column, row;
  float2 middle, sines;
  float4 spread; // column by column
  float3 lamp;   // DeviceIncoming
  float power, height, sun; // sun: radius of the light's disc
  global const DeviceIncoming* all; // light on all facets
} Facet;

#if NEPHROID_INCOMING
static inline void put_light(Facet* facet, DeviceIncoming in) {
  facet->sines = (float2)(in.sines[0], in.sines[1]);
  facet->spread = (float4)(in.spread[0], in.spread[1], in.spread[2], in.spread[3]);
  facet->lamp = (float3)(in.lamp[0], in.lamp[1], in.lamp[2]);
  facet->power = in.power;
}
#endif

static inline Facet facet_at(global const DeviceLayout* layout, global const DeviceIncoming* incoming,
                             global const float* heights, uint index) {
  Facet facet = {(int)(index % (uint)layout->columns),
                 (int)(index / (uint)layout->columns),
                 middle_of_facet(layout, index),
                 (float2)(0.0f),
                 (float4)(0.0f),
                 (float3)(0.0f),
                 1.0f,
                 heights[index],
                 layout->sun_radius[0],
                 incoming};
#if NEPHROID_INCOMING
  put_light(&facet, incoming[index]);
#endif
  return facet;
}

// The part of a facet whose light reaches the receivers: its middle and size in parts of the facet.
typedef struct {
  float2 middle, size;
} LitPart;

#if NEPHROID_INCOMING
// The mean over v = -1/2 .. 1/2 of a + b v where that is above 0.
static inline float mean_above_0(float a, float b) {
  b = fabs(b);
  return fabs(a) >= 0.5f * b ? fmax(a, 0.0f) : (a + 0.5f * b) * (a + 0.5f * b) / (2.0f * b);
}

// What the neighbour at a side of x hides of light with this slope, in parts of the facet. x and y: any two axes.
static inline float hidden_by(global const DeviceLayout* layout, const Facet* facet, int2 to, float along, float g,
                              float g_other, int axis, float ratio, float meets) {
  if (to.x < 0 || to.y < 0 || to.x >= layout->columns || to.y >= layout->rows) return 0.0f;
  global const float* around = facet->all[to.y * layout->columns + to.x].around;
  const float h = around[axis], h_other = around[1 - axis];
  return mean_above_0(along * 0.5f * (g + h), along * (g_other - h_other) * ratio) / fmax(0.1f, meets);
}

static inline LitPart lit_part(global const DeviceLayout* layout, const Facet* facet, float2 inside, float2 slope,
                               float2 g) {
  const float ratio = layout->facet_y / layout->facet_x, in = 1.0f + dot(inside, g), out = 1.0f + dot(slope, g);
  const int2 at = (int2)(facet->column, facet->row); // rows count downwards
  const float2 way = layout->n * inside; // light before a mirror comes from the other side
  const int2 from = (int2)(way.x > 0.0f ? -1 : 1, way.y > 0.0f ? -1 : 1),
             to = (int2)(slope.x > 0.0f ? 1 : -1, slope.y > 0.0f ? 1 : -1);
  const float2 shadow =
      (float2)(hidden_by(layout, facet, at + (int2)(from.x, 0), inside.x, g.x, g.y, 0, ratio, in),
               hidden_by(layout, facet, at - (int2)(0, from.y), inside.y, g.y, g.x, 1, 1.0f / ratio, in));
  const float2 stopped =
      (float2)(hidden_by(layout, facet, at + (int2)(to.x, 0), slope.x, g.x, g.y, 0, ratio, out),
               hidden_by(layout, facet, at - (int2)(0, to.y), slope.y, g.y, g.x, 1, 1.0f / ratio, out));
  const LitPart lit = {-0.5f * (convert_float2(from) * shadow + convert_float2(to) * stopped),
                       fmax((float2)(1.0f) - shadow - stopped, (float2)(0.0f))};
  return lit;
}
#endif

// What is the same for all receivers, for a slope of a facet.
typedef struct {
  float2 slope;
  float4 map; // maps the facet to a receiver at distance 0, column by column
  float4 map_by_distance;
  LitPart lit;
  float power; // in facets that send all of their light
#if NEPHROID_SPREAD
  float2 by_index;   // change of the slope
  float2 variance;   // of the slope, by the light's width and roughness
  float2 by_x, by_y, by_z; // change of the slope by the place of a point of the light
  float beside;            // variance by what is no part of a lamp: roughness
  float2 wave;             // and by diffraction
#endif
} Beams;

// The slope that a wave's direction cosines over a facet's own add: beams leave a facet as wide as it looks along them.
static inline float2 wave_slope(float2 cosines, float2 slope, float2 g) {
  const float2 over = cosines - dot(slope, cosines) / (1.0f + dot(slope, g)) * g;
  return sqrt(1.0f + dot(slope, slope)) * (over + dot(slope, over) * slope);
}

static SEPARATE Beams beams_of(global const DeviceLayout* layout, const Facet* facet, float2 slope) {
  const float n = layout->n;
  const float2 g = facet_gradient(slope, n, facet->sines);
  Beams beams = {slope,
                 (float4)(1.0f + slope.x * g.x, slope.y * g.x, slope.x * g.y, 1.0f + slope.y * g.y),
                 (float4)(0.0f),
                 {(float2)(0.0f), (float2)(1.0f)},
                 transmitted(slope, n, facet->sines) * layout->one_over_straight};
#if NEPHROID_INCOMING
  const float2 inside = slope_inside(facet->sines, n);
  if (!layout->free_heights) beams.lit = lit_part(layout, facet, inside, slope, g);
  beams.power *= facet->power * fmax(0.0f, 1.0f + dot(inside, g)) * beams.lit.size.x * beams.lit.size.y;
#endif
#if NEPHROID_SPREAD || NEPHROID_INCOMING
  const SlopeChange change = slope_change(slope, n, facet->sines);
#endif
#if NEPHROID_SPREAD
  // The disc is across the light. With its radius r, sines have the covariance r^2 / 4 (1 - sines sines^T).
  const float2 s = facet->sines;
  const float sun = 0.5f * facet->sun, shrinks = 1.0f / (1.0f + sqrt(1.0f - dot(s, s))),
              rough = layout->scatter * layout->scatter;
  const float2 x = sun * (change.by_sine_x * (1.0f - s.x * s.x * shrinks) - change.by_sine_y * s.x * s.y * shrinks),
               y = sun * (change.by_sine_y * (1.0f - s.y * s.y * shrinks) - change.by_sine_x * s.x * s.y * shrinks);
  beams.variance = x * x + y * y + rough;
  beams.by_index = change.by_index;
  const float xx = sqrt(beams.variance.x), xy = xx > 0.0f ? (x.x * x.y + y.x * y.y) / xx : 0.0f;
  beams.by_x = (float2)(xx, xy); // the covariance's root
  beams.by_y = (float2)(0.0f, sqrt(fmax(0.0f, beams.variance.y - xy * xy)));
  beams.by_z = (float2)(0.0f);
  beams.beside = 0.0f;
  const float2 wave_x = wave_slope((float2)(layout->wave_x, 0.0f), slope, g),
               wave_y = wave_slope((float2)(0.0f, layout->wave_y), slope, g);
  beams.wave = wave_x * wave_x + wave_y * wave_y;
#endif
#if NEPHROID_INCOMING
  if (layout->spreads > 0.0f) { // by_sines * spread * (1 + inside g^T)
    const float4 s = facet->spread,
                 m = (float4)(1.0f + inside.x * g.x, inside.y * g.x, inside.x * g.y, 1.0f + inside.y * g.y);
    const float4 around =
        (float4)(s.x * m.x + s.z * m.y, s.y * m.x + s.w * m.y, s.x * m.z + s.z * m.w, s.y * m.z + s.w * m.w);
    beams.map_by_distance = (float4)(change.by_sine_x * around.x + change.by_sine_y * around.y,
                                     change.by_sine_x * around.z + change.by_sine_y * around.w);
#if NEPHROID_SPREAD
    if (facet->lamp.x + facet->lamp.z > 0.0f) {
      beams.beside = rough; // lamps have a size of their own instead of the sun's
      beams.by_x = change.by_sine_x * s.x + change.by_sine_y * s.y;
      beams.by_y = change.by_sine_x * s.z + change.by_sine_y * s.w;
      const float2 way = facet->sines * rsqrt(1.0f - dot(facet->sines, facet->sines));
      beams.by_z = way.x * beams.by_x + way.y * beams.by_y;
      const float2 a = facet->lamp.x * beams.by_x + facet->lamp.y * beams.by_y, b = facet->lamp.z * beams.by_y;
      beams.variance = a * a + b * b + rough;
    }
#endif
  }
#endif
  return beams;
}

#if NEPHROID_LIGHTS
// The slope of light with these sines behind a facet of this gradient, and 0 where it is reflected totally.
static inline float3 slope_behind(float2 g, float n, float2 sines) {
  const float3 in = light_inside(sines, n), normal = (float3)(g, -1.0f) * rsqrt(1.0f + dot(g, g));
  const float along = dot(in, normal), square = 1.0f - n * n + along * along;
  const float3 out = in - (along - sqrt(fmax(0.0f, square))) * normal;
  return (float3)(out.xy / fmax(-out.z, 1e-3f), along * n > 0.0f && square > 0.0f && out.z < 0.0f);
}

static inline Facet in_light(global const DeviceLayout* layout, const Facet* facet, int light) {
  Facet lit = *facet;
  put_light(&lit, facet->all[(light * layout->rows + facet->row) * layout->columns + facet->column]);
  lit.sun = layout->sun_radius[light];
  return lit;
}

// The slope in the light of all that gives that of a receiver this one.
static inline float2 slope_in_light_of_all(global const DeviceLayout* layout, const Facet* facet, int light,
                                           float2 slope) {
  if (light == 0) return slope;
  const Facet lit = in_light(layout, facet, light);
  return slope_behind(facet_gradient(slope, layout->n, lit.sines), layout->n, facet->sines).xy;
}
#endif

// A facet's beams in the light of a receiver: `beams`, which are those in the light of all, or made in `room`.
static inline const Beams* beams_to(global const DeviceLayout* layout, const Facet* facet, const Beams* beams,
                                    DeviceReceiver receiver, Beams* room) {
#if NEPHROID_LIGHTS
  if (receiver.light == 0) return beams;
  const Facet lit = in_light(layout, facet, receiver.light);
  const float3 slope = slope_behind(facet_gradient(beams->slope, layout->n, facet->sines), layout->n, lit.sines);
  *room = beams_of(layout, &lit, slope.xy);
  room->power *= slope.z;
  return room;
#else
  return beams;
#endif
}

#if NEPHROID_SPREAD
static inline float part_of(global const DeviceLayout* layout, const Footprint* print, int i) {
  return layout->index_part[print->groups - 1 + i / print->points] / (float)print->points;
}

// How far beam i is from the middle, in cells.
static inline float2 shift_of(global const DeviceLayout* layout, const Footprint* print, int i) {
  const float2 shift = layout->index_over[print->groups - 1 + i / print->points] * print->by_index;
  if (print->points == 1) return shift;
  global const DeviceLightPoints* of = layout->points + print->light;
  global const float* at = (print->points == FEW_POINTS ? of->few_at : of->at) + 3 * (i % print->points);
  return shift + at[0] * print->by_x + at[1] * print->by_y + at[2] * print->by_z;
}
#endif

static SEPARATE Footprint footprint(global const DeviceLayout* layout, const Facet* facet, const Beams* beams,
                                    DeviceReceiver receiver) {
  Footprint print;
  const float way = receiver.distance + facet->height;
  const float2 cell = (float2)(layout->cell_x, layout->cell_y);
  float2 variance = (float2)(0.0f); // variance of the slope that is left in each beam
#if NEPHROID_SPREAD
  const float fine = fmin(cell.x, cell.y) / way; // a cell as a slope
  const bool is_wide = sqrt(6.0f * (beams->variance.x + beams->variance.y)) > layout->wide_in_cells * fine;
  const float line = length(beams->by_index) * layout->index_spread;
  int level = 0;
  while (level + 1 < (is_wide ? INDEX_LEVELS - 2 : INDEX_LEVELS) && level + 1 < layout->index_levels &&
         line > layout->piece_in_cells * fine * (float)(1 << level))
    ++level;
  variance += layout->index_within[level] * beams->by_index * beams->by_index;
  print.groups = 1 << level;
  print.points = !is_wide ? 1 : level == 0 ? LIGHT_POINTS : FEW_POINTS;
  print.light = receiver.light;
  const float2 per_slope = way / (float2)(cell.x, -cell.y);
  print.by_index = beams->by_index * per_slope;
  if (is_wide) {
    const float2 x = beams->by_x, y = beams->by_y, z = beams->by_z;
    print.by_x = x * per_slope;
    print.by_y = y * per_slope;
    print.by_z = z * per_slope;
    global const DeviceLightPoints* of = layout->points + print.light;
    global const float* left = print.points == FEW_POINTS ? of->few_left : of->left;
    variance += beams->beside + left[0] * x * x + left[1] * y * y + left[2] * z * z +
                2.0f * (left[3] * y * z + left[4] * x * z + left[5] * x * y);
  } else
    variance += beams->variance;
  variance += beams->wave;
  print.low = print.high = shift_of(layout, &print, 0);
  for (int i = 1; i < print.groups * print.points; ++i) {
    print.low = fmin(print.low, shift_of(layout, &print, i));
    print.high = fmax(print.high, shift_of(layout, &print, i));
  }
#endif
  const float4 map = beams->map + way * beams->map_by_distance;
  const float2 size = (float2)(layout->facet_x, layout->facet_y), from = beams->lit.middle * size,
               lit = beams->lit.size * size;
  const float2 at = in_cells(
      layout, receiver,
      facet->middle + (float2)(map.x * from.x + map.z * from.y, map.y * from.x + map.w * from.y) + beams->slope * way);
  const float2 blur = 12.0f * way * way * variance;
  const float across = map.z * lit.y, down = map.y * lit.x;
  print.x = beam_of(at.x, fabs(map.x) * lit.x / cell.x, sqrt(across * across + blur.x) / cell.x);
  print.y = beam_of(at.y, fabs(map.w) * lit.y / cell.y, sqrt(down * down + blur.y) / cell.y);
  return print;
}

// How far a footprint reaches from its middle, in cells.
static inline float2 reach_of(const Footprint* print) {
  const float2 reach = (float2)(print->x.reach, print->y.reach);
#if NEPHROID_SPREAD
  return reach + fmax(fabs(print->low), fabs(print->high));
#else
  return reach;
#endif
}

// The cells that a footprint touches: x and y of the first, and of the one behind the last.
static inline int4 cells_of(global const DeviceLayout* layout, const Footprint* print) {
#if NEPHROID_SPREAD
  const float2 low = print->low, high = print->high;
#else
  const float2 low = (float2)(0.0f), high = low;
#endif
  return (int4)(edge_cell(floor(print->x.middle + low.x - print->x.reach), layout->cells_x),
                edge_cell(floor(print->y.middle + low.y - print->y.reach), layout->cells_y),
                edge_cell(ceil(print->x.middle + high.x + print->x.reach), layout->cells_x),
                edge_cell(ceil(print->y.middle + high.y + print->y.reach), layout->cells_y));
}

// How much of a footprint's light is on each cell of a tile. A single beam needs no tile; many are summed.
#if NEPHROID_SPREAD
#define TILE 8
#define TILE_ROWS TILE
typedef float Tile[TILE * TILE];

static SEPARATE int fill_tile(global const DeviceLayout* layout, const Footprint* print, int2 corner, float* tile) {
  for (int i = 0; i < TILE * TILE; ++i) tile[i] = 0.0f;
  const int count = print->groups * print->points;
  for (int i = 0; i < count; ++i) {
    const float2 shift = shift_of(layout, print, i) - convert_float2(corner);
    Beam bx = print->x, by = print->y;
    bx.middle += shift.x;
    by.middle += shift.y;
    for (int y = edge_cell(floor(by.middle - by.reach), TILE), y_end = edge_cell(ceil(by.middle + by.reach), TILE);
         y < y_end; ++y) {
      const float part = part_on(by, y) * part_of(layout, print, i);
      for (int x = edge_cell(floor(bx.middle - bx.reach), TILE), x_end = edge_cell(ceil(bx.middle + bx.reach), TILE);
           x < x_end; ++x)
        tile[TILE * y + x] += part * part_on(bx, x);
    }
  }
  return 1;
}
#define PART_ON(print, tile, x, y) ((tile)[TILE * ((y) - at.y) + (x) - at.x])
#else
#define TILE (1 << 20)
#define TILE_ROWS 1
typedef float Tile[1];
static inline int fill_tile(global const DeviceLayout* layout, const Footprint* print, int2 corner, float* tile) {
  tile[0] = part_on(print->y, corner.y);
  return 1;
}
#define PART_ON(print, tile, x, y) (part_on((print).x, x) * (tile)[0])
#endif

// For every cell (x, y) that a footprint touches, of a tile from `at` on: PART_ON(print, tile, x, y) of its light.
#define FOR_CELLS(layout, print, tile)                                                                                 \
  for (int4 box = cells_of(layout, &(print)), at = box; at.y < box.w; at.y += TILE_ROWS)                               \
    for (at.x = box.x; at.x < box.z; at.x += TILE)                                                                     \
      for (int filled = fill_tile(layout, &(print), at.xy, tile); filled; filled = 0)                                  \
        for (int y = at.y; y < min(at.y + TILE_ROWS, box.w); ++y)                                                      \
          for (int x = at.x; x < min(at.x + TILE, box.z); ++x)

#endif
