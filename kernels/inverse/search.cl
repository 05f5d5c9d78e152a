// SPDX-License-Identifier: Apache-2.0
// Facets of a batch look for better slopes among the light of the others, all at once. Then they take them, those first
// that share no cell with a facet before them: so that each gains as much as it would alone.
#include "kernels/inverse/search.h"
#include "kernels/tracing/work_item.h"

// Refining takes so many steps of one length at most, and halves them until they are this part of a cell.
#define STEPS 2
#define FINEST 0.25f

// What the weighted squares would change by, were the facet's light put back with this slope; it counts as taken away.
static SEPARATE float score(const FacetSearch* s, float2 slope) {
  global const DeviceLayout* layout = s->layout;
  const Beams beams = beams_of(layout, &s->facet, slope);
#if NEPHROID_SMOOTHS
  float sum = -dot(facet_normal(slope, layout->n, s->facet.sines), s->pull);
#else
  float sum = 0.0f;
#endif
  for (int j = 0; j < layout->receivers; ++j) {
    const DeviceReceiver receiver = s->receivers[j];
    const float weight = receiver.weight;
    Beams room, now_room;
    const Beams *to = beams_to(layout, &s->facet, &beams, receiver, &room),
                *now = beams_to(layout, &s->facet, &s->now, receiver, &now_room);
    const Footprint print = footprint(layout, &s->facet, to, receiver);
    const float2 away =
        fabs(to->slope - now->slope) * (receiver.distance + s->facet.height) / (float2)(layout->cell_x, layout->cell_y);
    const float2 reach = reach_of(&print);
    bool near = away.x < 4.0f * reach.x + 4.0f && away.y < 4.0f * reach.y + 4.0f; // for sure, or it counts little
    Footprint own;
    if (near) {
      own = footprint(layout, &s->facet, now, receiver);
      const int4 a = cells_of(layout, &print), b = cells_of(layout, &own);
      near = a.x < b.z && b.x < a.z && a.y < b.w && b.y < a.w;
    }
    Tile tile, own_tile;
    FOR_CELLS(layout, print, tile) {
      if (near && x == at.x && y == at.y) fill_tile(layout, &own, at.xy, own_tile);
      const float light = to->power * PART_ON(print, tile, x, y);
      float there = s->lack[cell_at(layout, j, x, y)] + weight * light;
      if (near) there -= 2.0f * weight * now->power * PART_ON(own, own_tile, x, y);
      sum += light * there;
    }
  }
  return sum;
}

static SEPARATE FacetSearch search_of(global const DeviceLayout* layout, global const DeviceReceiver* receivers,
                                 global const DeviceIncoming* incoming, global const float* heights,
                                 global const float2* slopes, global const float* lack, float smoothing, uint index) {
  FacetSearch s = {layout, receivers, lack, facet_at(layout, incoming, heights, index)};
  s.now = beams_of(layout, &s.facet, slopes[index]);
#if NEPHROID_SMOOTHS
  s.pull = smoothing * pull_on(layout, incoming, heights, slopes, index);
#endif
  return s;
}

// Facet order[first + i] looks for found[i], first among its candidates; done[i]: it has none that is better.
__kernel void improve(SEARCH_ARGUMENTS, __global const float2* candidates, __global float2* found,
                      __global int* done) {
  const uint i = work_item();
  if (i >= batch.count) return;
  const uint index = order[batch.first + i];
  const FacetSearch s = search_of(layout, receivers, incoming, heights, slopes, lack, batch.smoothing, index);
  const float2 now = slopes[index];
  const float begin = score(&s, now);
  float2 from = now;
  float lowest = begin;
  for (int lane = 0; lane < 8; ++lane) {
    const float2 candidate = candidates[8 * i + lane];
    if (candidate.x == INFINITY) continue;
    const float sum = score(&s, candidate);
    if (sum < lowest) {
      lowest = sum;
      from = candidate;
    }
  }
  const float last = receivers[layout->receivers - 1].distance + s.facet.height;
  float2 step = 4.0f * lattice_of(layout, receivers, &s.facet, batch.seed, batch.sweep, index).fine_step;
  while (step.x > FINEST * layout->cell_x / last || step.y > FINEST * layout->cell_y / last) {
    step *= 0.5f;
    for (int k = 0; k < STEPS; ++k) {
      const float2 middle = from;
      for (int way = 0; way < 4; ++way) {
        const float2 slope =
            middle + step * (float2)((float)((way == 0) - (way == 1)), (float)((way == 2) - (way == 3)));
        if (!is_reachable(slope, layout->n, s.facet.sines, layout->steepest)) continue;
        const float there = score(&s, slope);
        if (there < lowest) {
          lowest = there;
          from = slope;
        }
      }
      if (from.x == middle.x && from.y == middle.y) break;
    }
  }
  found[i] = from;
  done[i] = !(lowest < begin);
}

static inline void claim_cells(global const DeviceLayout* layout, const Footprint* print, int receiver,
                               global uint* claims, uint key) {
  const int4 box = cells_of(layout, print);
  for (int y = box.y; y < box.w; ++y)
    for (int x = box.x; x < box.z; ++x) atomic_min(claims + cell_at(layout, receiver, x, y), key);
}

static SEPARATE bool holds_cells(global const DeviceLayout* layout, const Footprint* print, int receiver,
                                 global const uint* claims, uint key) {
  const int4 box = cells_of(layout, print);
  for (int y = box.y; y < box.w; ++y)
    for (int x = box.x; x < box.z; ++x)
      if (claims[cell_at(layout, receiver, x, y)] != key) return false;
  return true;
}

// Claims are the cells of all receivers, then the facets where neighbours are to be alike. A key is lower the later the
// turn and the earlier the facet in its batch, so that claims of turns before count no more.
#define KEY(turn, i) ((0xFFFFFu - (turn)) << 12 | (i))

__kernel void claim(SEARCH_ARGUMENTS, __global const float2* found, __global const int* done, __global uint* claims) {
  const uint i = work_item();
  if (i >= batch.count || done[i]) return;
  const uint index = order[batch.first + i], key = KEY(batch.turn, i);
  const Facet facet = facet_at(layout, incoming, heights, index);
  const Beams now = beams_of(layout, &facet, slopes[index]), then = beams_of(layout, &facet, found[i]);
  for (int j = 0; j < layout->receivers; ++j) {
    Beams room, then_room;
    const Footprint before =
                        footprint(layout, &facet, beams_to(layout, &facet, &now, receivers[j], &room), receivers[j]),
                    after = footprint(layout, &facet, beams_to(layout, &facet, &then, receivers[j], &then_room),
                                      receivers[j]);
    claim_cells(layout, &before, j, claims, key);
    claim_cells(layout, &after, j, claims, key);
  }
#if NEPHROID_SMOOTHS
  __global uint* facets = claims + cell_at(layout, layout->receivers, 0, 0);
  atomic_min(facets + index, key);
  for (int side = 0; side < 4; ++side) atomic_min(facets + neighbour(layout, index, side), key);
#endif
}

static SEPARATE void move_light(global const DeviceLayout* layout, const Footprint* print, float power, int receiver,
                                global long* light) {
  Tile tile;
  FOR_CELLS(layout, *print, tile) {
    const long quanta = quanta_of(fabs(power) * PART_ON(*print, tile, x, y));
    light[cell_at(layout, receiver, x, y)] += power < 0.0f ? -quanta : quanta;
  }
}

static SEPARATE void note_lack(global const DeviceLayout* layout, const Footprint* print, float weight, int receiver,
                               global const long* light, global const float* wanted, global float* lack) {
  const int4 box = cells_of(layout, print);
  for (int y = box.y; y < box.w; ++y)
    for (int x = box.x; x < box.z; ++x) {
      const size_t cell = cell_at(layout, receiver, x, y);
      lack[cell] = lack_of(light[cell], wanted[cell], weight);
    }
}

// Facets that hold all that they claimed have their cells to themselves; they take what they found if still better.
__kernel void take(SEARCH_ARGUMENTS, __global const float* wanted, __global long* light, __global const float2* found,
                   __global int* done, __global const uint* claims) {
  const uint i = work_item();
  if (i >= batch.count || done[i]) return;
  const uint index = order[batch.first + i], key = KEY(batch.turn, i);
  const Facet facet = facet_at(layout, incoming, heights, index);
  const Beams now = beams_of(layout, &facet, slopes[index]), then = beams_of(layout, &facet, found[i]);
  for (int j = 0; j < layout->receivers; ++j) {
    Beams room, then_room;
    const Footprint before =
                        footprint(layout, &facet, beams_to(layout, &facet, &now, receivers[j], &room), receivers[j]),
                    after = footprint(layout, &facet, beams_to(layout, &facet, &then, receivers[j], &then_room),
                                      receivers[j]);
    if (!holds_cells(layout, &before, j, claims, key) || !holds_cells(layout, &after, j, claims, key)) return;
  }
#if NEPHROID_SMOOTHS
  __global const uint* facets = claims + cell_at(layout, layout->receivers, 0, 0);
  if (facets[index] != key) return;
  for (int side = 0; side < 4; ++side)
    if (facets[neighbour(layout, index, side)] != key) return;
#endif
  done[i] = 1;
  const FacetSearch s = search_of(layout, receivers, incoming, heights, slopes, lack, batch.smoothing, index);
  if (!(score(&s, found[i]) < score(&s, slopes[index]))) return;
  for (int j = 0; j < layout->receivers; ++j) {
    Beams room, then_room;
    const Beams *from = beams_to(layout, &facet, &now, receivers[j], &room),
                *to = beams_to(layout, &facet, &then, receivers[j], &then_room);
    const Footprint before = footprint(layout, &facet, from, receivers[j]),
                    after = footprint(layout, &facet, to, receivers[j]);
    move_light(layout, &before, -from->power, j, light);
    move_light(layout, &after, to->power, j, light);
    note_lack(layout, &before, receivers[j].weight, j, light, wanted, lack);
    note_lack(layout, &after, receivers[j].weight, j, light, wanted, lack);
  }
  slopes[index] = found[i];
}
