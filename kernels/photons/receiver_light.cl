// SPDX-License-Identifier: Apache-2.0
// From what photons have left on the pages of receivers (receiver.h) to what looks find there: a page's total is all
// light that lies in it, whichever page it was added to. take_light goes over all pages, then sum_light over one level
// after the other, from the one above the deepest up.
#include "kernels/photons/receiver.h"
#include "kernels/tracing/work_item.h"

// Work items are the texels of the pages first, ..., first + count - 1, in all layers of one kind and in one half.
typedef struct {
  uint page, layer, texel;
} LightItem;

static inline LightItem light_item(const Receivers* on, uint first) {
  const uint i = work_item();
  const LightItem item = {first + i / PAGE_TEXELS / (uint)on->layers, i / PAGE_TEXELS % (uint)on->layers,
                          i % PAGE_TEXELS};
  return item;
}

static inline size_t texel_of(const Receivers* on, uint film_half, int kind, uint page, uint layer) {
  return (page_size(on) * (size_t)page + first_texel(on, film_half, kind, (int)layer)) / 3;
}

// Makes `part` of the light in undivided pages that of `sums`, times scale, and keeps the rest as it is. Light that a
// page above has for four texels is as much in each; with undivided_only, photons are points, and there is none.
kernel void take_light(global const int* receiver_table, global const long* sums, global float* totals, uint film_half,
                       int kind, float scale, float part, int undivided_only) {
  const Receivers on = receivers_of(receiver_table);
  const LightItem item = light_item(&on, 0u);
  if (item.page >= (uint)on.page_count) return;
  DevicePage page = on.pages[item.page];
  if (page.child != NO_PAGE) return;
  float3 light = (float3)(0.0f);
  float share = scale;
  uint number = item.page, x = item.texel % PAGE_EDGE, y = item.texel / PAGE_EDGE;
  for (;;) {
    light += share *
             convert_float3(vload3(texel_of(&on, film_half, kind, number, item.layer) + y * PAGE_EDGE + x, sums));
    if (page.parent == NO_PAGE || undivided_only) break;
    number = (uint)page.parent;
    x = ((uint)(page.x & 1) * PAGE_EDGE + x) / 2u;
    y = ((uint)(page.y & 1) * PAGE_EDGE + y) / 2u;
    share *= 0.25f;
    page = on.pages[number];
  }
  const size_t at = texel_of(&on, film_half, kind, item.page, item.layer) + item.texel;
  const float3 before = vload3(at, totals);
  vstore3(before + part * (light - before), at, totals);
}

// Clears a kind of light in all pages.
kernel void clear_light(global const int* receiver_table, global long* sums, uint film_half, int kind) {
  const Receivers on = receivers_of(receiver_table);
  const LightItem item = light_item(&on, 0u);
  if (item.page < (uint)on.page_count)
    vstore3((long3)(0), texel_of(&on, film_half, kind, item.page, item.layer) + item.texel, sums);
}

kernel void sum_light(global const int* receiver_table, global float* totals, uint film_half, int kind, uint first,
                      uint count) {
  const Receivers on = receivers_of(receiver_table);
  const LightItem item = light_item(&on, first);
  if (item.page >= first + count) return;
  const int child = on.pages[item.page].child;
  if (child == NO_PAGE) return;
  const uint half_edge = PAGE_EDGE / 2, x = item.texel % PAGE_EDGE, y = item.texel / PAGE_EDGE;
  const size_t from = texel_of(&on, film_half, kind, (uint)child + 2u * (y / half_edge) + x / half_edge, item.layer) +
                      2u * (y % half_edge) * PAGE_EDGE + 2u * (x % half_edge);
  const float3 sum = vload3(from, totals) + vload3(from + 1u, totals) + vload3(from + PAGE_EDGE, totals) +
                     vload3(from + PAGE_EDGE + 1u, totals);
  vstore3(sum, texel_of(&on, film_half, kind, item.page, item.layer) + item.texel, totals);
}
