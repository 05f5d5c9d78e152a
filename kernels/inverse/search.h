// SPDX-License-Identifier: Apache-2.0
// What kernels share in which a facet looks for a slope: what stands around it, and the lattice that it tries.
#ifndef NEPHROID_SEARCH_H
#define NEPHROID_SEARCH_H

#include "kernels/inverse/light.h"
#include "kernels/tracing/random.h"

// 1: neighbours should be alike.
#ifndef NEPHROID_SMOOTHS
#define NEPHROID_SMOOTHS 1
#endif

// Candidates across and down; the best of every part are scored exactly.
#define LATTICE 32
#define PARTS 2
// At most this many are then tried across and down about a candidate: the cells that a step of the lattice passes over.
#define MOST_FINE 8

// order: the facets of a sweep, one after the other.
#define SEARCH_ARGUMENTS                                                                                               \
  __global const DeviceLayout* layout, global const DeviceReceiver *receivers, global const DeviceIncoming *incoming,  \
      global const float *heights, global float2 *slopes, global float *lack, global const uint *order,                \
      DeviceBatch batch

typedef struct {
  global const DeviceLayout* layout;
  global const DeviceReceiver* receivers;
  global const float* lack;
  Facet facet;
  Beams now; // where its light is; that light counts as taken away
  float3 pull;
} FacetSearch;

#if NEPHROID_SMOOTHS
// The facet at a side, 0 .. 3; at the rim the facet itself.
static inline uint neighbour(global const DeviceLayout* layout, uint index, int side) {
  const int column = (int)(index % (uint)layout->columns) + (side == 0) - (side == 1),
            row = (int)(index / (uint)layout->columns) + (side == 2) - (side == 3);
  const bool is_facet = column >= 0 && row >= 0 && column < layout->columns && row < layout->rows;
  return is_facet ? (uint)(row * layout->columns + column) : index;
}

static inline float neighbours_of(global const DeviceLayout* layout, uint index) {
  float count = 0.0f;
  for (int side = 0; side < 4; ++side) count += neighbour(layout, index, side) != index;
  return count;
}

// The sum of Cost_N over all facets (app/inverse/assign/cost.h) falls by n . pull where a facet of normal n is put
// among its neighbours: their normals, times one part in the facet's neighbours and one in each neighbour's own.
static inline float3 pull_on(global const DeviceLayout* layout, global const DeviceIncoming* incoming,
                             global const float* heights, global const float2* slopes, uint index) {
  const float own = neighbours_of(layout, index);
  float3 sum = (float3)(0.0f);
  for (int side = 0; side < 4; ++side) {
    const uint other = neighbour(layout, index, side);
    if (other == index) continue;
    const Facet facet = facet_at(layout, incoming, heights, other);
    sum += (1.0f / own + 1.0f / neighbours_of(layout, other)) * facet_normal(slopes[other], layout->n, facet.sines);
  }
  return sum;
}
#endif

// A lattice of slopes to points of one of the receivers, LATTICE across and down, and cells about each of them.
typedef struct {
  float2 corner, step, fine_step;
  int2 fine; // the cells of a step
} Lattice;

// The lattice moves at random, to another receiver every time, so that light is tried that misses those behind it.
static inline Lattice lattice_of(global const DeviceLayout* layout, global const DeviceReceiver* receivers,
                                 const Facet* facet, uint2 seed, uint sweep, uint index) {
  const float4 random = random4(seed, sweep, index, 0u, STREAM_FACETS);
  const DeviceReceiver to = receivers[min((int)(random.z * (float)layout->receivers), layout->receivers - 1)];
  const float2 size = (float2)(layout->receiver_x, layout->receiver_y);
  const float far = to.distance + facet->height;
  Lattice made;
  made.step = size / (LATTICE * far);
  float2 low = ((float2)(to.x, to.y) - 0.5f * size - facet->middle) / far;
#if NEPHROID_LIGHTS
  if (to.light > 0) {
    const float2 high = slope_in_light_of_all(layout, facet, to.light, low + LATTICE * made.step);
    low = slope_in_light_of_all(layout, facet, to.light, low);
    made.step = fmax((high - low) / LATTICE, 0.25f * made.step);
  }
#endif
  made.corner = random.xy * made.step + low;
  made.fine = clamp((int2)(layout->cells_x, layout->cells_y) / LATTICE, (int2)(1), (int2)(MOST_FINE));
  made.fine_step = made.step / convert_float2(made.fine);
  return made;
}

#endif
