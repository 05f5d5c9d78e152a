// SPDX-License-Identifier: Apache-2.0
// The light of all facets on every receiver, what lacks there, and how the weighted squares change with each slope.
#include "kernels/inverse/light.h"
#include "kernels/tracing/film.h"
#include "kernels/tracing/registers.h"

// light: [receiver][cell], to which every facet adds.
__kernel void add_light(__global const DeviceLayout* layout, __global const DeviceReceiver* receivers, __global const DeviceIncoming* incoming,
                        __global const float* heights, __global const float2* slopes, __global long* light)
{
  const uint index = (uint)get_global_id(0);
  if (index >= (uint)(layout->columns * layout->rows)) return;
  const Facet facet = facet_at(layout, incoming, heights, index);
  const Beams beams = beams_of(layout, &facet, slopes[index]);
  for (int j = 0; j < layout->receivers; ++j) {
    const Footprint print = footprint(layout, &facet, &beams, receivers[j]);
    Tile tile;
    FOR_CELLS(layout, print, tile)
      add_exactly(light + cell_at(layout, j, x, y), quanta_of(beams.power * PART_ON(print, tile, x, y)));
  }
}

__kernel void find_lack(__global const DeviceLayout* layout, __global const DeviceReceiver* receivers, __global const long* light,
                        __global const float* wanted, __global float* lack)
{
  const uint item = (uint)get_global_id(0), cells = (uint)(layout->cells_x * layout->cells_y);
  if (item < cells * (uint)layout->receivers) lack[item] = lack_of(light[item], wanted[item], receivers[item / cells].weight);
}

// Over which the gradient is a difference, in cells of the last receiver: as little as single precision tells apart well.
#define DIFFERENCE 0.02f

// A facet's light times what lacks where it falls.
static inline float along_lack(global const DeviceLayout* layout, const Facet* facet, float2 slope, global const DeviceReceiver* receivers,
                               global const float* lack)
{
  const Beams beams = beams_of(layout, facet, slope);
  float sum = 0.0f;
  for (int j = 0; j < layout->receivers; ++j) {
    const Footprint print = footprint(layout, facet, &beams, receivers[j]);
    Tile tile;
    FOR_CELLS(layout, print, tile) sum += PART_ON(print, tile, x, y) * lack[cell_at(layout, j, x, y)];
  }
  return beams.power * sum;
}

// Of the weighted squares, by each facet's slope.
__kernel void find_gradient(__global const DeviceLayout* layout, __global const DeviceReceiver* receivers, __global const DeviceIncoming* incoming,
                            __global const float* heights, __global const float2* slopes, __global const float* lack,
                            __global float2* gradient)
{
  const uint index = (uint)get_global_id(0);
  if (index >= (uint)(layout->columns * layout->rows)) return;
  const Facet facet = facet_at(layout, incoming, heights, index);
  const float2 slope = slopes[index];
  const float2 h = DIFFERENCE * (float2)(layout->cell_x, layout->cell_y) / receivers[layout->receivers - 1].distance;
  float change[4];
  ROLLED
  for (int side = 0; side < 4; ++side) {
    const float2 moved = slope + (side & 1 ? -h : h) * (side < 2 ? (float2)(1.0f, 0.0f) : (float2)(0.0f, 1.0f));
    change[side] = along_lack(layout, &facet, moved, receivers, lack);
  }
  gradient[index] = (float2)(change[0] - change[1], change[2] - change[3]) / (2.0f * h);
}
