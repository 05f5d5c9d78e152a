// SPDX-License-Identifier: Apache-2.0
// The light of all facets on every receiver, what lacks there, and how the weighted squares change with each slope.
#include "kernels/inverse/light.h"
#include "kernels/tracing/film.h"

// light: [receiver][cell], to which every facet adds.
__kernel void add_light(DeviceLayout own_layout, __global const DeviceReceiver* receivers, __global const DeviceIncoming* incoming,
                        __global const float* heights, __global const float2* slopes, __global long* light)
{
  const uint index = (uint)get_global_id(0);
  if (index >= (uint)(own_layout.columns * own_layout.rows)) return;
  const Facet facet = facet_at(&own_layout, incoming, heights, index);
  const Beams beams = beams_of(&own_layout, &facet, slopes[index]);
  for (int j = 0; j < own_layout.receivers; ++j) {
    const Footprint print = footprint(&own_layout, &facet, &beams, receivers[j].distance);
    Tile tile;
    FOR_CELLS(&own_layout, print, tile)
      add_exactly(light + cell_at(&own_layout, j, x, y), quanta_of(beams.power * PART_ON(print, tile, x, y)));
  }
}

__kernel void find_lack(DeviceLayout own_layout, __global const DeviceReceiver* receivers, __global const long* light,
                        __global const float* wanted, __global float* lack)
{
  const uint item = (uint)get_global_id(0), cells = (uint)(own_layout.cells_x * own_layout.cells_y);
  if (item < cells * (uint)own_layout.receivers) lack[item] = lack_of(light[item], wanted[item], receivers[item / cells].weight);
}

// Over which the gradient is a difference, in cells: as little as single precision tells apart well.
#define DIFFERENCE 0.02f

static inline float along_lack(const DeviceLayout* layout, const Facet* facet, float2 slope, int receiver, float distance,
                               global const float* lack)
{
  const Beams beams = beams_of(layout, facet, slope);
  const Footprint print = footprint(layout, facet, &beams, distance);
  float sum = 0.0f;
  Tile tile;
  FOR_CELLS(layout, print, tile) sum += PART_ON(print, tile, x, y) * lack[cell_at(layout, receiver, x, y)];
  return beams.power * sum;
}

// Of the weighted squares, by each facet's slope.
__kernel void find_gradient(DeviceLayout own_layout, __global const DeviceReceiver* receivers, __global const DeviceIncoming* incoming,
                            __global const float* heights, __global const float2* slopes, __global const float* lack,
                            __global float2* gradient)
{
  const uint index = (uint)get_global_id(0);
  if (index >= (uint)(own_layout.columns * own_layout.rows)) return;
  const Facet facet = facet_at(&own_layout, incoming, heights, index);
  const float2 slope = slopes[index];
  float2 sum = (float2)(0.0f);
  for (int j = 0; j < own_layout.receivers; ++j) {
    const float distance = receivers[j].distance;
    const float2 h = DIFFERENCE * (float2)(own_layout.cell_x, own_layout.cell_y) / distance;
    const float2 x = (float2)(h.x, 0.0f), y = (float2)(0.0f, h.y);
    sum.x += (along_lack(&own_layout, &facet, slope + x, j, distance, lack) - along_lack(&own_layout, &facet, slope - x, j, distance, lack)) / (2.0f * h.x);
    sum.y += (along_lack(&own_layout, &facet, slope + y, j, distance, lack) - along_lack(&own_layout, &facet, slope - y, j, distance, lack)) / (2.0f * h.y);
  }
  gradient[index] = sum;
}
