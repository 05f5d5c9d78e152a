// SPDX-License-Identifier: Apache-2.0
// Structs that engine 3's host code writes and its kernels read: app/inverse/layout.h in single precision. Lengths are in millimetres.
#ifndef NEPHROID_FACET_TYPES_H
#define NEPHROID_FACET_TYPES_H

#include "kernels/tracing/shared_types.h"

#ifndef __OPENCL_C_VERSION__
namespace nephroid::shared {
#endif

// Light is counted in quanta: so many are what a facet sends at best. Sums do not depend on the order of their terms then.
#define FACET_QUANTA 0x1p24f

// A footprint is so many beams at most: 2^4.
#define BEAMS 16
#define INDEX_LEVELS 5

typedef struct {
  float size_x, size_y; // of the object
  float facet_x, facet_y;
  float receiver_x, receiver_y;
  float cell_x, cell_y;
  int columns, rows; // of facets
  int cells_x, cells_y;
  int receivers;
  float n;
  float steepest; // of a facet's gradient
  float usable;   // slope of light that falls straight on
  float sun_radius, scatter;
  float spreads; // a lamp: one over its distance, as light sees it in the object; 0: parallel light
  int free_heights;
  // Of light with a band or a width: beams that stand for it.
  float index_spread;                       // between the outermost indices
  int index_levels;                         // level l has 2^l groups of indices
  float index_over[2 * BEAMS - 1];          // over n: level after level
  float index_within[INDEX_LEVELS];         // variance of the index that is left in the groups of a level
  float disc[2 * BEAMS], coarse_disc[8];    // x and y of points
  float left_of_disc, left_of_coarse_disc;  // of the variance, for each point
  float piece_in_cells, wide_in_cells;
} DeviceLayout;

typedef struct {
  float distance;
  float weight; // of its squares
} DeviceReceiver;

// Light that falls on a facet: inverse::Incoming.
typedef struct {
  float sines[2], around[2];
  float spread[4]; // columns
  float power;
  int padding;
} DeviceIncoming;

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(DeviceLayout) == 408 && sizeof(DeviceReceiver) == 8 && sizeof(DeviceIncoming) == 40);
} // namespace nephroid::shared
#endif

#endif
