// SPDX-License-Identifier: Apache-2.0
// Structs of light on receivers that the host and kernels share. Lengths are in scene units.
#ifndef NEPHROID_RECEIVER_TYPES_H
#define NEPHROID_RECEIVER_TYPES_H

#include "kernels/tracing/shared_types.h"

#ifndef __OPENCL_C_VERSION__
namespace nephroid::shared {
#endif

// A page has PAGE_EDGE x PAGE_EDGE texels. Each level of a tree has pages of half the size, and so have their texels.
#define PAGE_EDGE 32
#define PAGE_TEXELS (PAGE_EDGE * PAGE_EDGE)
#define PAGE_LEVELS 16
#define NO_PAGE (-1)
#define MOST_LAYERS 8 // of light, each of some wavelengths

// The charts of an object: for each axis one of what faces down it and one of what faces up it, in each slab of depth.
#define CHARTS_OF_SLAB 6
typedef struct {
  float low[3];    // corner of the cube about the object that its charts are sides of
  float per_unit;  // 1 / the cube's edge
  int first_chart; // NO_PAGE: no light is kept on the object
  int slabs;
} DeviceCharts;

// A page of a chart's quadtree.
typedef struct {
  int child;  // the first of its four children, or NO_PAGE; number 2 j + i is i to the right and j down
  int parent; // or NO_PAGE
  int x, y;   // its place among the 2^level x 2^level pages of its level
  int level;
} DevicePage;

// Where a path from the eye ends.
typedef struct {
  int chart;  // NO_PAGE: on none
  float x, y; // there, 0..1
  int level;  // of the pages whose texels are as large as it wants them
} DeviceLook;

// How many samples of a pixel ask for pages, each in its part of the spectrum, and how many ends of each.
#define ASKING_SAMPLES 4
#define ASKING_ENDS 4

// The table of a run's receivers: these, in ints from its start, then the structs.
typedef struct {
  int receivers, roots, pages; // where each begins: DeviceCharts [object], int [chart], DevicePage [page]
  int layer_members, layer_places; // ... int and float [layer + 1]: the first of all clusters' members in a layer, and
                                   // that one's place in the spectrum (member_at)
  int wavelength_layers;           // ... int [WAVELENGTH_COUNT]: the layer of each
  int page_count;
  int layers; // of light, MOST_LAYERS or fewer
} DeviceReceiverTable;

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(DeviceCharts) == 24 && sizeof(DevicePage) == 20 && sizeof(DeviceLook) == 16);
static_assert(sizeof(DeviceReceiverTable) == 32);
} // namespace nephroid::shared
#endif

#endif
