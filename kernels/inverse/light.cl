// SPDX-License-Identifier: Apache-2.0
// The light of all facets on every receiver, what lacks there, and how the weighted squares change with each slope.
#include "kernels/inverse/light.h"
#include "kernels/tracing/film.h"
#include "kernels/tracing/registers.h"
#include "kernels/tracing/work_item.h"

// light: [receiver][cell], to which every facet adds.
__kernel void add_light(__global const DeviceLayout* layout, __global const DeviceReceiver* receivers,
                        __global const DeviceIncoming* incoming, __global const float* heights,
                        __global const float2* slopes, __global long* light) {
  const uint index = work_item();
  if (index >= (uint)(layout->columns * layout->rows)) return;
  const Facet facet = facet_at(layout, incoming, heights, index);
  const Beams beams = beams_of(layout, &facet, slopes[index]);
  for (int j = 0; j < layout->receivers; ++j) {
    Beams room;
    const Beams* to = beams_to(layout, &facet, &beams, receivers[j], &room);
    const Footprint print = footprint(layout, &facet, to, receivers[j]);
    Tile tile;
    FOR_CELLS(layout, print, tile)
      add_exactly(light + cell_at(layout, j, x, y), quanta_of(to->power * PART_ON(print, tile, x, y)));
  }
}

__kernel void find_lack(__global const DeviceLayout* layout, __global const DeviceReceiver* receivers,
                        __global const long* light, __global const float* wanted, __global float* lack) {
  const uint item = work_item(), cells = (uint)(layout->cells_x * layout->cells_y);
  if (item < cells * (uint)layout->receivers)
    lack[item] = lack_of(light[item], wanted[item], receivers[item / cells].weight);
}

// How the part of a beam before t falls as its middle moves on: its density there.
static inline float density_at(Beam beam, float t) {
  const float away = fabs(t - beam.middle);
  return away <= beam.even ? beam.one_over_width : 2.0f * beam.tail * fmax(0.0f, beam.reach - away);
}

// How a footprint's light times what lacks where it falls changes as it moves, by cells.
static inline float2 along_lack(global const DeviceLayout* layout, const Footprint* print, global const float* lack) {
#if NEPHROID_SPREAD
  const int beams = print->groups * print->points;
#else
  const int beams = 1;
#endif
  float2 sum = (float2)(0.0f);
  for (int i = 0; i < beams; ++i) {
    Beam bx = print->x, by = print->y;
    float part = 1.0f;
#if NEPHROID_SPREAD
    part = part_of(layout, print, i);
    const float2 shift = shift_of(layout, print, i);
    bx.middle += shift.x;
    by.middle += shift.y;
#endif
    const int x_begin = edge_cell(floor(bx.middle - bx.reach), layout->cells_x),
              x_end = edge_cell(ceil(bx.middle + bx.reach), layout->cells_x);
    for (int y = edge_cell(floor(by.middle - by.reach), layout->cells_y),
             y_end = edge_cell(ceil(by.middle + by.reach), layout->cells_y);
         y < y_end; ++y) {
      float before = part_before(bx, (float)x_begin), density = density_at(bx, (float)x_begin);
      float2 row = (float2)(0.0f); // by x, and all of it
      for (int x = x_begin; x < x_end; ++x) {
        const float after = part_before(bx, (float)(x + 1)), next = density_at(bx, (float)(x + 1));
        row += (float2)(density - next, after - before) * lack[y * layout->cells_x + x];
        before = after;
        density = next;
      }
      sum += part * row * (float2)(part_on(by, y), density_at(by, (float)y) - density_at(by, (float)(y + 1)));
    }
  }
  return sum;
}

#if NEPHROID_LIGHTS
// Of a gradient by the slope in a receiver's light, in cells, that by the slope in the light of all.
static inline float2 by_slope_of_all(global const DeviceLayout* layout, const Facet* facet, const Beams* beams,
                                     DeviceReceiver receiver, float2 along) {
  if (receiver.light == 0) return along;
  const float little = 1e-3f, n = layout->n;
  const float2 sines = in_light(layout, facet, receiver.light).sines;
  const float2 size = (float2)(layout->cell_x, -layout->cell_y);
  float2 result;
  for (int axis = 0; axis < 2; ++axis) {
    const float2 step = little * (float2)(axis == 0, axis == 1);
    const float2 change = slope_behind(facet_gradient(beams->slope + step, n, facet->sines), n, sines).xy -
                          slope_behind(facet_gradient(beams->slope - step, n, facet->sines), n, sines).xy;
    const float sum = dot(along, change / size) / (2.0f * little);
    if (axis == 0) result.x = sum * size.x; else result.y = sum * size.y;
  }
  return result;
}
#endif

// The gradient of the weighted squares by the slopes of facets first .. first + count - 1. That a footprint's size and
// light change with the slope too is left out: less than a hundredth where a facet is small beside the distances.
__kernel void find_gradient(__global const DeviceLayout* layout, __global const DeviceReceiver* receivers,
                            __global const DeviceIncoming* incoming, __global const float* heights,
                            __global const float2* slopes, __global const float* lack, uint first, uint count,
                            __global float2* gradient) {
  const uint item = work_item(), index = first + item;
  if (item >= count) return;
  const Facet facet = facet_at(layout, incoming, heights, index);
  const Beams beams = beams_of(layout, &facet, slopes[index]);
  float2 sum = (float2)(0.0f);
  for (int j = 0; j < layout->receivers; ++j) {
    Beams room;
    const Beams* to = beams_to(layout, &facet, &beams, receivers[j], &room);
    const Footprint print = footprint(layout, &facet, to, receivers[j]);
#if NEPHROID_LIGHTS
    sum += to->power * (receivers[j].distance + facet.height) *
           by_slope_of_all(layout, &facet, &beams, receivers[j],
                           along_lack(layout, &print, lack + cell_at(layout, j, 0, 0)));
#else
    sum += (receivers[j].distance + facet.height) * along_lack(layout, &print, lack + cell_at(layout, j, 0, 0));
#endif
  }
#if !NEPHROID_LIGHTS
  sum *= beams.power;
#endif
  gradient[index] = sum / (float2)(layout->cell_x, -layout->cell_y);
}
