// SPDX-License-Identifier: Apache-2.0
// Facets of a batch look for better slopes among the light of the others, all at once. Then they take them, those first that share no cell
// with a facet before them: so that each gains as much as it would alone.
#include "kernels/inverse/light.h"
#include "kernels/tracing/random.h"
#include "kernels/tracing/registers.h"

// 1: neighbours are to be alike.
#ifndef NEPHROID_SMOOTHS
#define NEPHROID_SMOOTHS 1
#endif

// Refining takes so many steps of one length at most, and halves them until they are this part of a cell.
#define STEPS 2
#define FINEST 0.25f

// Candidates across and down, of which the best of every part are scored exactly.
#define LATTICE 32
#define PARTS 2
// Then so many across and down about a candidate, at most: the cells that a step of the lattice passes over.
#define MOST_FINE 8

#define SEARCH_ARGUMENTS                                                                                                                   \
  __global const DeviceLayout* layout, global const DeviceReceiver *receivers, global const DeviceIncoming *incoming, global const float *heights,   \
      global float2 *slopes, global float *lack, float smoothing

typedef struct {
  global const DeviceLayout* layout;
  global const DeviceReceiver* receivers;
  global const float* lack;
  Facet facet;
  Beams now; // where its light is, which counts as taken away
  float3 pull;
} Search;


// What the weighted squares would change by, were the facet's light, which counts as taken away, put back with this slope.
static SEPARATE float score(const Search* s, float2 slope)
{
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
    const Footprint print = footprint(layout, &s->facet, &beams, receiver);
    const float2 away = fabs(slope - s->now.slope) * (receiver.distance + s->facet.height) / (float2)(layout->cell_x, layout->cell_y);
    const float2 reach = reach_of(&print);
    bool near = away.x < 4.0f * reach.x + 4.0f && away.y < 4.0f * reach.y + 4.0f; // for sure, or it counts little
    Footprint own;
    if (near) {
      own = footprint(layout, &s->facet, &s->now, receiver);
      const int4 a = cells_of(layout, &print), b = cells_of(layout, &own);
      near = a.x < b.z && b.x < a.z && a.y < b.w && b.y < a.w;
    }
    Tile tile, own_tile;
    FOR_CELLS(layout, print, tile) {
      if (near && x == at.x && y == at.y) fill_tile(layout, &own, at.xy, own_tile);
      const float light = beams.power * PART_ON(print, tile, x, y);
      float there = s->lack[cell_at(layout, j, x, y)] + weight * light;
      if (near) there -= 2.0f * weight * s->now.power * PART_ON(own, own_tile, x, y);
      sum += light * there;
    }
  }
  return sum;
}

#if NEPHROID_SMOOTHS
static inline float neighbours_of(global const DeviceLayout* layout, int column, int row)
{
  return (float)((column > 0) + (column + 1 < layout->columns) + (row > 0) + (row + 1 < layout->rows));
}

// The sum of Cost_N over all facets (app/inverse/assign/cost.h) falls by n . pull where a facet of normal n is put among its neighbours:
// their normals, times one part in the facet's neighbours and one in each neighbour's own.
static inline float3 pull_on(global const DeviceLayout* layout, global const DeviceIncoming* incoming, global const float* heights,
                             global const float2* slopes, uint index)
{
  const int column = (int)(index % (uint)layout->columns), row = (int)(index / (uint)layout->columns);
  const float own = neighbours_of(layout, column, row);
  float3 sum = (float3)(0.0f);
  for (int side = 0; side < 4; ++side) {
    const int c = column + (side == 0) - (side == 1), r = row + (side == 2) - (side == 3);
    if (c < 0 || r < 0 || c >= layout->columns || r >= layout->rows) continue;
    const uint other = (uint)(r * layout->columns + c);
    const Facet facet = facet_at(layout, incoming, heights, other);
    sum += (1.0f / own + 1.0f / neighbours_of(layout, c, r)) * facet_normal(slopes[other], layout->n, facet.sines);
  }
  return sum;
}
#endif

static SEPARATE Search search_of(global const DeviceLayout* layout, global const DeviceReceiver* receivers, global const DeviceIncoming* incoming,
                               global const float* heights, global const float2* slopes, global const float* lack, float smoothing, uint index)
{
  Search s = {layout, receivers, lack, facet_at(layout, incoming, heights, index)};
  s.now = beams_of(layout, &s.facet, slopes[index]);
#if NEPHROID_SMOOTHS
  s.pull = smoothing * pull_on(layout, incoming, heights, slopes, index);
#endif
  return s;
}

// A receiver's cells with a rim of one more all around, where nothing lacks.
static inline size_t rimmed_at(global const DeviceLayout* layout, int receiver, int x, int y)
{
  return ((size_t)receiver * (size_t)(layout->cells_y + 2) + (size_t)(y + 1)) * (size_t)(layout->cells_x + 2) + (size_t)(x + 1);
}

// The beam of a flat facet on the middle of cell 0, along one axis.
static inline Beam flat_beam(global const DeviceLayout* layout, float distance, int axis)
{
  const float wide = (axis == 0 ? layout->facet_x : layout->facet_y) * (1.0f + distance * layout->spreads), sun = 0.5f * layout->sun_radius,
              blur = distance * sqrt(12.0f * (sun * sun + layout->scatter * layout->scatter));
  const float cell = axis == 0 ? layout->cell_x : layout->cell_y;
  return beam_of(0.5f, wide / cell, blur / cell);
}

// The mean of the lack under such beams about every cell's middle: what candidates are looked up in, at the nearest cell. First along y, then
// along x; a row of cells an item.
__kernel void smear_y(__global const DeviceLayout* layout, __global const DeviceReceiver* receivers, __global const float* lack, __global float* along_y)
{
  const int row = (int)get_global_id(0), cells_x = layout->cells_x, cells_y = layout->cells_y;
  if (row >= cells_y * layout->receivers) return;
  const int y = row % cells_y;
  const Beam beam = flat_beam(layout, receivers[row / cells_y].distance, 1);
  const int reach = (int)fmin(ceil(beam.reach - 0.5f), (float)cells_y);
  lack += (size_t)row * (size_t)cells_x;
  along_y += (size_t)row * (size_t)cells_x;
  for (int x = 0; x < cells_x; ++x) along_y[x] = 0.0f;
  for (int d = max(-reach, -y), end = min(reach, cells_y - 1 - y); d <= end; ++d) {
    const float part = part_on(beam, d);
    for (int x = 0; x < cells_x; ++x) along_y[x] += part * lack[d * cells_x + x];
  }
}
__kernel void smear_x(__global const DeviceLayout* layout, __global const DeviceReceiver* receivers, __global const float* along_y,
                      __global float* smeared)
{
  const int row = (int)get_global_id(0), cells_x = layout->cells_x, cells_y = layout->cells_y;
  if (row >= cells_y * layout->receivers) return;
  const Beam beam = flat_beam(layout, receivers[row / cells_y].distance, 0);
  const int reach = (int)fmin(ceil(beam.reach - 0.5f), (float)cells_x);
  along_y += (size_t)row * (size_t)cells_x;
  smeared += rimmed_at(layout, row / cells_y, 0, row % cells_y);
  for (int x = 0; x < cells_x; ++x) smeared[x] = 0.0f;
  for (int d = -reach; d <= reach; ++d) {
    const float part = part_on(beam, d);
    for (int x = max(0, -d), end = min(cells_x, cells_x - d); x < end; ++x) smeared[x] += part * along_y[x + d];
  }
}

#define LANES (float8)(0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f, 7.0f)
#define GATHER(from, i)                                                                                                                   \
  (float8)((from)[i.s0], (from)[i.s1], (from)[i.s2], (from)[i.s3], (from)[i.s4], (from)[i.s5], (from)[i.s6], (from)[i.s7])

// Eight slopes at a time, of which each is the best of those that were tried in its place; infinite: none was reachable.
typedef struct {
  float8 lowest, x, y;
} Eight;

// Tries slopes on a lattice, `count` across and down from x and y on: by the sum of what lacks where a facet's light falls.
static SEPARATE void try_lattice(const Search* s, global const float* smeared, float8 x_from, float8 y_from, float2 step, int2 count, Eight* best)
{
  global const DeviceLayout* layout = s->layout;
  SET_ASIDE float8 lowest = best->lowest, best_x = best->x, best_y = best->y, x_begin = x_from, y_begin = y_from;
  ROLLED
  for (int k = 0; k < count.y; ++k) {
    ROLLED
    for (int i = 0; i < count.x; ++i) {
      const float8 x = x_begin + (float)i * step.x, y = y_begin + (float)k * step.y;
      float8 sum = (float8)(0.0f);
      ROLLED
      for (int j = 0; j < layout->receivers; ++j) {
        const DeviceReceiver receiver = s->receivers[j];
        const float way = receiver.distance + s->facet.height;
        const float2 on_axis = in_cells(layout, receiver, s->facet.middle), per_slope = way / (float2)(layout->cell_x, -layout->cell_y);
        int8 at = (layout->cells_x + 2) * convert_int8(clamp(floor(on_axis.y + per_slope.y * y), -1.0f, (float)layout->cells_y));
        at += convert_int8(clamp(floor(on_axis.x + per_slope.x * x), -1.0f, (float)layout->cells_x));
        global const float* cells = smeared + rimmed_at(layout, j, 0, 0);
        sum += GATHER(cells, at);
      }
#if NEPHROID_SMOOTHS || NEPHROID_INCOMING
      float each[8], xs[8], ys[8];
      vstore8(sum, 0, each);
      vstore8(x, 0, xs);
      vstore8(y, 0, ys);
      for (int lane = 0; lane < 8; ++lane) {
        const float2 slope = (float2)(xs[lane], ys[lane]);
#if NEPHROID_SMOOTHS
        each[lane] -= dot(facet_normal(slope, layout->n, s->facet.sines), s->pull);
#endif
        if (!is_reachable(slope, layout->n, s->facet.sines, layout->steepest)) each[lane] = INFINITY;
      }
      sum = vload8(0, each);
      const int8 better = sum < lowest;
#else
      const int8 better = sum < lowest && x * x + y * y <= layout->usable * layout->usable;
#endif
      lowest = select(lowest, sum, better);
      best_x = select(best_x, x, better);
      best_y = select(best_y, y, better);
    }
  }
  best->lowest = lowest;
  best->x = best_x;
  best->y = best_y;
}

// A lattice of slopes to points of one of the receivers, LATTICE across and down, and cells about each of them.
typedef struct {
  float2 corner, step, fine_step;
  int2 fine; // cells of a step
} Lattice;

// Moved at random; another receiver every time, so that light is tried that misses those behind it.
static inline Lattice lattice_of(global const DeviceLayout* layout, global const DeviceReceiver* receivers, const Facet* facet, uint2 seed, uint sweep,
                                 uint index)
{
  const float4 random = random4(seed, sweep, index, 0u, STREAM_FACETS);
  const DeviceReceiver to = receivers[min((int)(random.z * (float)layout->receivers), layout->receivers - 1)];
  const float2 size = (float2)(layout->receiver_x, layout->receiver_y);
  const float far = to.distance + facet->height;
  Lattice made;
  made.step = size / (LATTICE * far);
  made.corner = random.xy * made.step + ((float2)(to.x, to.y) - 0.5f * size - facet->middle) / far;
  made.fine = clamp((int2)(layout->cells_x, layout->cells_y) / LATTICE, 1, MOST_FINE);
  made.fine_step = made.step / convert_float2(made.fine);
  return made;
}

// Facet order[first + i] gets eight slopes to try: of the rows part, part + PARTS, ... of its lattice the best of every eighth column, then of
// the cells about each; of the parts' the better one. x is infinite where none was reachable.
__kernel void propose(SEARCH_ARGUMENTS, __global const float* smeared, __global const uint* order, uint first, uint count, uint2 seed,
                      uint sweep, __global float2* candidates)
{
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  const uint index = order[first + i];
  Search s = {layout, receivers, lack, facet_at(layout, incoming, heights, index)};
#if NEPHROID_SMOOTHS
  s.pull = smoothing * pull_on(layout, incoming, heights, slopes, index);
#endif
  const Lattice lattice = lattice_of(layout, receivers, &s.facet, seed, sweep, index);
  const float2 step = lattice.step, fine_step = lattice.fine_step;
  float lowest[8];
  for (int lane = 0; lane < 8; ++lane) lowest[lane] = INFINITY;
  candidates += 8 * i;
  ROLLED
  for (int part = 0; part < PARTS; ++part) {
    Eight own = {(float8)(INFINITY), (float8)(0.0f), (float8)(0.0f)};
    try_lattice(&s, smeared, lattice.corner.x + LANES * step.x, (float8)(lattice.corner.y + (float)part * step.y), (float2)(8, PARTS) * step,
                (int2)(LATTICE / 8, LATTICE / PARTS), &own);
    try_lattice(&s, smeared, own.x - 0.5f * (step.x - fine_step.x), own.y - 0.5f * (step.y - fine_step.y), fine_step, lattice.fine, &own);
    float there[8], xs[8], ys[8];
    vstore8(own.lowest, 0, there);
    vstore8(own.x, 0, xs);
    vstore8(own.y, 0, ys);
    for (int lane = 0; lane < 8; ++lane) {
      if (part > 0 && !(there[lane] < lowest[lane])) continue;
      lowest[lane] = there[lane];
      candidates[lane] = (float2)(there[lane] == INFINITY ? INFINITY : xs[lane], ys[lane]);
    }
  }
}

// Facet order[first + i] looks for found[i], first among its candidates; done[i]: it has none that is better.
__kernel void look(SEARCH_ARGUMENTS, __global const float2* candidates, __global const uint* order, uint first, uint count, uint2 seed,
                   uint sweep, __global float2* found, __global int* done)
{
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  const uint index = order[first + i];
  const Search s = search_of(layout, receivers, incoming, heights, slopes, lack, smoothing, index);
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
  float2 step = 4.0f * lattice_of(layout, receivers, &s.facet, seed, sweep, index).fine_step;
  while (step.x > FINEST * layout->cell_x / last || step.y > FINEST * layout->cell_y / last) {
    step *= 0.5f;
    for (int k = 0; k < STEPS; ++k) {
      const float2 middle = from;
      for (int way = 0; way < 4; ++way) {
        const float2 slope = middle + step * (float2)((float)((way == 0) - (way == 1)), (float)((way == 2) - (way == 3)));
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

static inline void claim_cells(global const DeviceLayout* layout, const Footprint* print, int receiver, global uint* claims, uint key)
{
  const int4 box = cells_of(layout, print);
  for (int y = box.y; y < box.w; ++y)
    for (int x = box.x; x < box.z; ++x) atomic_min(claims + cell_at(layout, receiver, x, y), key);
}

static SEPARATE bool holds_cells(global const DeviceLayout* layout, const Footprint* print, int receiver, global const uint* claims, uint key)
{
  const int4 box = cells_of(layout, print);
  for (int y = box.y; y < box.w; ++y)
    for (int x = box.x; x < box.z; ++x)
      if (claims[cell_at(layout, receiver, x, y)] != key) return false;
  return true;
}

// Claims are the cells of all receivers, then the facets where neighbours are to be alike. A key is lower the later the turn and the
// earlier the facet in its batch, so that claims of turns before count no more.
#define KEY(turn, i) ((0xFFFFFu - (turn)) << 12 | (i))

__kernel void claim(SEARCH_ARGUMENTS, __global const uint* order, uint first, uint count, __global const float2* found, __global const int* done,
                    __global uint* claims, uint turn)
{
  const uint i = (uint)get_global_id(0);
  if (i >= count || done[i]) return;
  const uint index = order[first + i], key = KEY(turn, i);
  const Facet facet = facet_at(layout, incoming, heights, index);
  const Beams now = beams_of(layout, &facet, slopes[index]), then = beams_of(layout, &facet, found[i]);
  for (int j = 0; j < layout->receivers; ++j) {
    const Footprint before = footprint(layout, &facet, &now, receivers[j]),
                    after = footprint(layout, &facet, &then, receivers[j]);
    claim_cells(layout, &before, j, claims, key);
    claim_cells(layout, &after, j, claims, key);
  }
#if NEPHROID_SMOOTHS
  __global uint* facets = claims + cell_at(layout, layout->receivers, 0, 0);
  const int column = (int)(index % (uint)layout->columns), row = (int)(index / (uint)layout->columns);
  atomic_min(facets + index, key);
  if (column > 0) atomic_min(facets + index - 1, key);
  if (column + 1 < layout->columns) atomic_min(facets + index + 1, key);
  if (row > 0) atomic_min(facets + index - layout->columns, key);
  if (row + 1 < layout->rows) atomic_min(facets + index + layout->columns, key);
#endif
}

static SEPARATE void move_light(global const DeviceLayout* layout, const Footprint* print, float power, int receiver, global long* light)
{
  Tile tile;
  FOR_CELLS(layout, *print, tile) {
    const long quanta = quanta_of(fabs(power) * PART_ON(*print, tile, x, y));
    light[cell_at(layout, receiver, x, y)] += power < 0.0f ? -quanta : quanta;
  }
}

static SEPARATE void note_lack(global const DeviceLayout* layout, const Footprint* print, float weight, int receiver, global const long* light,
                             global const float* wanted, global float* lack)
{
  const int4 box = cells_of(layout, print);
  for (int y = box.y; y < box.w; ++y)
    for (int x = box.x; x < box.z; ++x) {
    const size_t cell = cell_at(layout, receiver, x, y);
    lack[cell] = lack_of(light[cell], wanted[cell], weight);
  }
}

// Facets that hold all that they claimed have their cells to themselves. They take what they found if it is better still.
__kernel void take(SEARCH_ARGUMENTS, __global const float* wanted, __global long* light, __global const uint* order, uint first, uint count,
                   __global const float2* found, __global int* done, __global const uint* claims, uint turn)
{
  const uint i = (uint)get_global_id(0);
  if (i >= count || done[i]) return;
  const uint index = order[first + i], key = KEY(turn, i);
  const Facet facet = facet_at(layout, incoming, heights, index);
  const Beams now = beams_of(layout, &facet, slopes[index]), then = beams_of(layout, &facet, found[i]);
  for (int j = 0; j < layout->receivers; ++j) {
    const Footprint before = footprint(layout, &facet, &now, receivers[j]),
                    after = footprint(layout, &facet, &then, receivers[j]);
    if (!holds_cells(layout, &before, j, claims, key) || !holds_cells(layout, &after, j, claims, key)) return;
  }
#if NEPHROID_SMOOTHS
  __global const uint* facets = claims + cell_at(layout, layout->receivers, 0, 0);
  const int column = (int)(index % (uint)layout->columns), row = (int)(index / (uint)layout->columns);
  if (facets[index] != key || (column > 0 && facets[index - 1] != key) ||
      (column + 1 < layout->columns && facets[index + 1] != key) || (row > 0 && facets[index - layout->columns] != key) ||
      (row + 1 < layout->rows && facets[index + layout->columns] != key))
    return;
#endif
  done[i] = 1;
  const Search s = search_of(layout, receivers, incoming, heights, slopes, lack, smoothing, index);
  if (!(score(&s, found[i]) < score(&s, slopes[index]))) return;
  for (int j = 0; j < layout->receivers; ++j) {
    const Footprint before = footprint(layout, &facet, &now, receivers[j]),
                    after = footprint(layout, &facet, &then, receivers[j]);
    move_light(layout, &before, -now.power, j, light);
    move_light(layout, &after, then.power, j, light);
    note_lack(layout, &before, receivers[j].weight, j, light, wanted, lack);
    note_lack(layout, &after, receivers[j].weight, j, light, wanted, lack);
  }
  slopes[index] = found[i];
}
