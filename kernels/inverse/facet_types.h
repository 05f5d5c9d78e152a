// SPDX-License-Identifier: Apache-2.0
// Structs that engine 3's host code writes and its kernels read: app/inverse/layout.h in single precision, millimetres.
#ifndef NEPHROID_FACET_TYPES_H
#define NEPHROID_FACET_TYPES_H

#include "kernels/tracing/shared_types.h"

#ifndef __OPENCL_C_VERSION__
namespace nephroid::shared {
#endif

// Light is counted in quanta; a facet sends this many at best. So sums do not depend on the order of their terms.
#define FACET_QUANTA 0x1p24f

// The most beams of a footprint, 2^4.
#define BEAMS 16
#define INDEX_LEVELS 5
// The beams that stand for light with a width and one wavelength.
#define LIGHT_POINTS 8
#define FEW_POINTS 4 // and many wavelengths
// The light of all, and one for each receiver.
#define MOST_LIGHTS 17

// inverse::LightPoints, all and few. left: xx, yy, zz, yz, xz, xy.
typedef struct {
  float at[3 * LIGHT_POINTS], few_at[3 * FEW_POINTS];
  float left[6], few_left[6];
} DeviceLightPoints;

typedef struct {
  float size_x, size_y; // size of the object
  float facet_x, facet_y;
  float receiver_x, receiver_y;
  float cell_x, cell_y;
  int columns, rows; // facets across and down
  int cells_x, cells_y;
  int receivers;
  float n;
  float steepest; // the largest gradient of a facet
  float usable;   // largest slope of light that falls straight on
  float one_over_straight; // one over the part of the light that a facet lets through without bending it
  float sun_radius[MOST_LIGHTS]; // of each light's disc: in the order of `points`
  float scatter;
  float wave_x, wave_y; // Layout::wave_width(), as standard deviations
  float spreads; // a lamp: one over its distance, as light sees it in the object; 0: no light is a lamp's
  int free_heights;
  // The beams that stand for light with a band or a width.
  float index_spread;                       // the largest index minus the least
  int index_levels;                         // level l has 2^l groups of indices
  float index_over[2 * BEAMS - 1];          // index minus n, level after level
  float index_part[2 * BEAMS - 1];          // part of what counts, in the same order
  float index_within[INDEX_LEVELS];         // variance of the index that is left in the groups of a level
  DeviceLightPoints points[MOST_LIGHTS];    // of the light of all, then of the receivers' own
  float piece_in_cells, wide_in_cells;
} DeviceLayout;

typedef struct {
  float x, y; // the receiver's middle
  float distance;
  float weight; // weight of the receiver's squares
  int light;    // of its own, from 1 on; 0: that of all
  float spreads; // of its light: DeviceLayout
  float lamp;    // standard deviation of the slope, along each axis, that the size of its lamp gives a flat facet
  int padding;
} DeviceReceiver;

// Light that falls on a facet: inverse::Incoming. The facets of the light of all, then those of the receivers' own.
typedef struct {
  float sines[2], around[2];
  float spread[4]; // column by column
  float power;
  float lamp[3]; // root of the covariance of a lamp's places: xx, xy, yy of a lower triangle
} DeviceIncoming;

// The part of a triangle of the solid: inverse::Part.
#define PART_FACET 0
#define PART_WALL 1
#define PART_SIDE 2
#define PART_FRONT 3

// How many quantiles of half a slit's light the judge has.
#define SLIT_QUANTILES 1024

// A ray's light is counted in quanta; this many fall on a facet.
#define RAY_QUANTA 0x1p32f

// Where the light on the front goes: inverse::RayOutcomes. Many places keep the sums, so that rays seldom meet there.
#define RAY_REFLECTED 0
#define RAY_LOST 1
#define RAY_SENT 2
#define RAY_BY_WALLS 3
#define RAY_OUTCOMES 4
#define RAY_OUTCOME_SUMS 256

// The judge's light: what falls on the front, or on a mirror, n < 0, and the screens.
typedef struct {
  float4 direction; // for parallel light
  float4 lamp;
  float lamp_weight; // weight of a ray over the cosine and one over the squared distance; 0: parallel light
  float n, sun_radius, scatter, wavelength; // wavelength: the mean, in mm
  float size_x, size_y, facet_x, facet_y;
  float entry, before; // z of where light falls in; how far before it rays begin
  float receiver_x, receiver_y, cell_x, cell_y;
  int columns, along; // facets of a row; rays along one side of a facet
  int cells_x, cells_y, screens;
  uint part_step; // from a ray's part of the spectrum to the next one's; 0: one index
  int is_round; // 1: light falls on the ellipse within the front
  uint lamp_places; // how many points stand for it; 0: it is one itself
  int padding;
} DeviceFront;

// How a ray leaves the object.
typedef struct {
  float4 from, direction;
  float part; // part of its light; 0: lost
  float reflected;
  int met_wall;
  uint leaves; // the last surface it met
} DeviceWayOut;

// The facets first, ..., first + count - 1 of a sweep's order, which look for better slopes.
typedef struct {
  uint2 seed;
  uint sweep, turn; // turn: of those in which facets claim cells
  uint first, count;
  float smoothing; // what unlike neighbours cost
  int padding;
} DeviceBatch;

// The rays of a round, number `turn`: those of `count` work items from the first of a row of facets on.
typedef struct {
  uint2 seed;
  uint turn, first_row, count;
  int padding;
} DeviceJudgeLaunch;

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(DeviceFront) == 128 && sizeof(DeviceWayOut) == 48 && sizeof(DeviceJudgeLaunch) == 24);
static_assert(sizeof(DeviceBatch) == 32);
static_assert(sizeof(DeviceLayout) == 3704 && sizeof(DeviceReceiver) == 32 && sizeof(DeviceIncoming) == 48);
} // namespace nephroid::shared
#endif

#endif
