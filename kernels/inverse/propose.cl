// SPDX-License-Identifier: Apache-2.0
// Facets of a batch look for slopes that are worth to be scored exactly: by what lacks about the middle of their light.
#include "kernels/inverse/search.h"
#include "kernels/tracing/registers.h"
#include "kernels/tracing/work_item.h"

// A receiver's cells with a rim of one more all around, where nothing lacks.
static inline size_t rimmed_at(global const DeviceLayout* layout, int receiver, int x, int y) {
  return ((size_t)receiver * (size_t)(layout->cells_y + 2) + (size_t)(y + 1)) * (size_t)(layout->cells_x + 2) +
         (size_t)(x + 1);
}

// The beam of a flat facet on the middle of cell 0, along one axis.
static inline Beam flat_beam(global const DeviceLayout* layout, DeviceReceiver receiver, int axis) {
  const float distance = receiver.distance;
  const float wide = (axis == 0 ? layout->facet_x : layout->facet_y) * (1.0f + distance * receiver.spreads),
              sun = 0.5f * layout->sun_radius[receiver.light],
              blur = distance * sqrt(12.0f * (sun * sun + layout->scatter * layout->scatter +
                                              receiver.lamp * receiver.lamp));
  const float cell = axis == 0 ? layout->cell_x : layout->cell_y;
  return beam_of(0.5f, wide / cell, blur / cell);
}

// The mean of the lack under such beams about every cell's middle: what candidates are looked up in, at the nearest
// cell. First along y, then along x; a row of cells an item.
__kernel void smear_y(__global const DeviceLayout* layout, __global const DeviceReceiver* receivers,
                      __global const float* lack, __global float* along_y) {
  const int row = (int)work_item(), cells_x = layout->cells_x, cells_y = layout->cells_y;
  if (row >= cells_y * layout->receivers) return;
  const int y = row % cells_y;
  const Beam beam = flat_beam(layout, receivers[row / cells_y], 1);
  const int reach = (int)fmin(ceil(beam.reach - 0.5f), (float)cells_y);
  lack += (size_t)row * (size_t)cells_x;
  along_y += (size_t)row * (size_t)cells_x;
  for (int x = 0; x < cells_x; ++x) along_y[x] = 0.0f;
  for (int d = max(-reach, -y), end = min(reach, cells_y - 1 - y); d <= end; ++d) {
    const float part = part_on(beam, d);
    for (int x = 0; x < cells_x; ++x) along_y[x] += part * lack[d * cells_x + x];
  }
}
__kernel void smear_x(__global const DeviceLayout* layout, __global const DeviceReceiver* receivers,
                      __global const float* along_y, __global float* smeared) {
  const int row = (int)work_item(), cells_x = layout->cells_x, cells_y = layout->cells_y;
  if (row >= cells_y * layout->receivers) return;
  const Beam beam = flat_beam(layout, receivers[row / cells_y], 0);
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
#define GATHER(from, i)                                                                                                \
  (float8)((from)[i.s0], (from)[i.s1], (from)[i.s2], (from)[i.s3], (from)[i.s4], (from)[i.s5], (from)[i.s6],           \
           (from)[i.s7])

// Eight slopes at a time, each the best of those that were tried in its place; infinite: none was reachable.
typedef struct {
  float8 lowest, x, y;
} Eight;

typedef struct {
  float8 x, y;
} EightSlopes;

#if NEPHROID_LIGHTS
// facet_gradient() and slope_behind() of eight; light that is reflected totally goes far beside all receivers.
static inline EightSlopes gradients(float8 x, float8 y, float n, float2 sines) {
  const float8 out = rsqrt(1.0f + x * x + y * y);
  const float8 over = 1.0f / (copysign(sqrt(n * n - dot(sines, sines)), n) - out);
  const EightSlopes made = {(sines.x - x * out) * over, (sines.y - y * out) * over};
  return made;
}
static inline EightSlopes slopes_behind(EightSlopes g, float n, float2 sines) {
  const float inside = copysign(sqrt(n * n - dot(sines, sines)), n);
  const float8 length = rsqrt(1.0f + g.x * g.x + g.y * g.y),
               along = (sines.x * g.x + sines.y * g.y + inside) * length, square = 1.0f - n * n + along * along,
               turn = (along - sqrt(fmax(square, 0.0f))) * length, down = inside - turn;
  const int8 goes = square > 0.0f && n * along > 0.0f && down > 0.0f;
  const float8 over = 1.0f / fmax(down, 1e-3f), far = (float8)(1e6f);
  const EightSlopes made = {select(far, (sines.x - turn * g.x) * over, goes),
                            select(far, (sines.y - turn * g.y) * over, goes)};
  return made;
}
#endif

// Tries slopes on a lattice, `count` across and down from x and y on: by the sum of what lacks where light falls.
static SEPARATE void try_lattice(const FacetSearch* s, global const float* smeared, float8 x_from, float8 y_from,
                                 float2 step, int2 count, Eight* best) {
  global const DeviceLayout* layout = s->layout;
  SET_ASIDE float8 lowest = best->lowest, best_x = best->x, best_y = best->y, x_begin = x_from, y_begin = y_from;
  ROLLED
  for (int k = 0; k < count.y; ++k) {
    ROLLED
    for (int i = 0; i < count.x; ++i) {
      const float8 x = x_begin + (float)i * step.x, y = y_begin + (float)k * step.y;
      float8 sum = (float8)(0.0f);
#if NEPHROID_LIGHTS
      const EightSlopes g = gradients(x, y, layout->n, s->facet.sines);
#endif
      ROLLED
      for (int j = 0; j < layout->receivers; ++j) {
        const DeviceReceiver receiver = s->receivers[j];
        const float way = receiver.distance + s->facet.height;
        const float2 on_axis = in_cells(layout, receiver, s->facet.middle),
                     per_slope = way / (float2)(layout->cell_x, -layout->cell_y);
        EightSlopes to = {x, y};
#if NEPHROID_LIGHTS
        if (receiver.light > 0) to = slopes_behind(g, layout->n, in_light(layout, &s->facet, receiver.light).sines);
#endif
        int8 at = (layout->cells_x + 2) *
                  convert_int8(clamp(floor(on_axis.y + per_slope.y * to.y), -1.0f, (float)layout->cells_y));
        at += convert_int8(clamp(floor(on_axis.x + per_slope.x * to.x), -1.0f, (float)layout->cells_x));
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

// Facet order[first + i] gets eight slopes to try: of the rows part, part + PARTS, ... of its lattice the best of every
// eighth column, then of the cells about each; of the parts' the better one. x is infinite where none was reachable.
__kernel void propose(SEARCH_ARGUMENTS, __global const float* smeared, __global float2* candidates) {
  const uint i = work_item();
  if (i >= batch.count) return;
  const uint index = order[batch.first + i];
  FacetSearch s = {layout, receivers, lack, facet_at(layout, incoming, heights, index)};
#if NEPHROID_SMOOTHS
  s.pull = batch.smoothing * pull_on(layout, incoming, heights, slopes, index);
#endif
  const Lattice lattice = lattice_of(layout, receivers, &s.facet, batch.seed, batch.sweep, index);
  const float2 step = lattice.step, fine_step = lattice.fine_step;
  float lowest[8];
  for (int lane = 0; lane < 8; ++lane) lowest[lane] = INFINITY;
  candidates += 8 * i;
  ROLLED
  for (int part = 0; part < PARTS; ++part) {
    Eight own = {(float8)(INFINITY), (float8)(0.0f), (float8)(0.0f)};
    try_lattice(&s, smeared, lattice.corner.x + LANES * step.x, (float8)(lattice.corner.y + (float)part * step.y),
                (float2)(8, PARTS) * step, (int2)(LATTICE / 8, LATTICE / PARTS), &own);
    try_lattice(&s, smeared, own.x - 0.5f * (step.x - fine_step.x), own.y - 0.5f * (step.y - fine_step.y), fine_step,
                lattice.fine, &own);
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
