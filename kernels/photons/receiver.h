// SPDX-License-Identifier: Apache-2.0
// Light on receivers: what photons leave on diffuse surfaces is kept in texels there, and paths from the eye look it
// up, each over its own footprint.
//
// A chart is the part of an object's surface that faces one way along an axis, in a slab of depth, seen along that
// axis. So there are no seams, no u and v, and a flat floor has one chart. A photon lights each chart that its surface
// faces by more than CHART_LEAST. A look takes the chart that its surface faces most. Irradiance is what a texel holds
// per area, times the cosine between chart and surface.
//
// The texels of a chart are in a quadtree of pages, which are as fine as the eye asks for (app/photons/receivers). A
// photon adds its light to the finest pages under it whose texels are not much smaller than its footprint. Then
// receiver_light.cl gives each page what lies in those above it and below it.
#include "kernels/photons/footprint.h"
#include "kernels/photons/receiver_types.h"
#include "kernels/tracing/film.h"
#include "kernels/tracing/surface.h"
#include "kernels/tracing/world.h"

// 1: light is kept on receivers, for what glass and mirrors show.
#ifndef NEPHROID_RECEIVERS
#define NEPHROID_RECEIVERS 0
#endif

// 1: caustics alone; 2: also their light from diffuse surfaces, of the layer "indirect".
#ifndef NEPHROID_KINDS_OF_LIGHT
#define NEPHROID_KINDS_OF_LIGHT 1
#endif

// A surface that faces an axis by less than this is not on its charts. Every surface faces one by .577 or more.
#define CHART_LEAST 0.4f
// A footprint reaches over at most so many texels, less than half a page, so that it lies in at most four pages.
#define FOOTPRINT_TEXELS 14.0f
// A look's footprint has about so many texels along an edge: those of the root of its area.
#define LOOK_TEXELS 3.0f

typedef struct {
  __global const DeviceCharts* receivers; // [object]
  __global const int* roots;                // [chart]: a page, or NO_PAGE
  __global const DevicePage* pages;
  __global const int *layer_members, *wavelength_layers; // DeviceReceiverTable
  __global const float* layer_places;
  int page_count;
  int layers; // of each kind of light
} Receivers;

static inline Receivers receivers_of(__global const int* table) {
  const DeviceReceiverTable at = *(__global const DeviceReceiverTable*)table;
  const Receivers on = {(__global const DeviceCharts*)(table + at.receivers), table + at.roots,
                        (__global const DevicePage*)(table + at.pages),
                        table + at.layer_members, table + at.wavelength_layers,
                        (__global const float*)(table + at.layer_places), at.page_count, at.layers};
  return on;
}

// Light is [half][page][kind][layer][PAGE_TEXELS][3]. From a page to the next, and the first of a half, kind and layer.
static inline size_t page_size(const Receivers* on) {
  return 3 * PAGE_TEXELS * NEPHROID_KINDS_OF_LIGHT * (size_t)on->layers;
}
static inline size_t first_texel(const Receivers* on, uint film_half, int kind, int layer) {
  return page_size(on) * (size_t)on->page_count * film_half +
         3 * PAGE_TEXELS * ((size_t)kind * (size_t)on->layers + (size_t)layer);
}

static inline int layer_of(const Receivers* on, int wavelength) { return on->wavelength_layers[wavelength]; }
// Of a band whose wavelengths go one way, and of others that of its leader.
static inline int layer_of_band(const Receivers* on, const SpectralTables* tables, const Band* band) {
  return layer_of(on, band->wavelength >= 0 ? band->wavelength
                                            : tables->cluster_wavelengths[tables->cluster_first[band->cluster]]);
}
// Whether all of a cluster is in one layer.
static inline bool is_of_one_layer(const Receivers* on, const SpectralTables* tables, int cluster) {
  const int first = tables->cluster_first[cluster], end = tables->cluster_first[cluster + 1],
            layer = layer_of(on, tables->cluster_wavelengths[first]);
  return first >= on->layer_members[layer] && end <= on->layer_members[layer + 1];
}

static inline float of_axis(float3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }
static inline float2 across_axis(float3 v, int axis) { return axis == 0 ? v.yz : axis == 1 ? v.zx : v.xy; }

// A place and a footprint on an object's charts, in edges of its cube.
typedef struct {
  DeviceCharts receiver;
  float3 position, a, b; // the footprint reaches from -a/2 - b/2 to a/2 + b/2
  float3 normal;         // of the lit side
} ReceiverPlace;

static inline ReceiverPlace receiver_place(const Receivers* on, const Surface* surface, float side, float3 a,
                                           float3 b) {
  ReceiverPlace place;
  place.receiver = on->receivers[surface->object];
  const float3 low = (float3)(place.receiver.low[0], place.receiver.low[1], place.receiver.low[2]);
  place.position = (surface->position - low) * place.receiver.per_unit;
  place.a = a * place.receiver.per_unit;
  place.b = b * place.receiver.per_unit;
  place.normal = side * surface->geometric;
  return place;
}

static inline int slab_of(const ReceiverPlace* place, float depth) {
  return clamp((int)(depth * (float)place->receiver.slabs), 0, place->receiver.slabs - 1);
}

static inline int chart_of(const ReceiverPlace* place, int axis, float depth) {
  const int way = of_axis(place->normal, axis) > 0.0f ? 1 : 0;
  return place->receiver.first_chart + (2 * axis + way) * place->receiver.slabs + slab_of(place, depth);
}

// The parallelogram of a place's footprint on a chart, in edges of the cube.
static inline Footprint footprint_on_chart(float2 middle, float2 a, float2 b) {
  Footprint f;
  f.middle = middle;
  f.x = 0.5f * (float4)(-a.x - b.x, a.x - b.x, a.x + b.x, b.x - a.x);
  f.y = 0.5f * (float4)(-a.y - b.y, a.y - b.y, a.y + b.y, b.y - a.y);
  f.slope = (float4)(0.0f);
  f.area = 0.0f;
  return f;
}

// The level, with a fraction, at which something of this size reaches over so many texels.
static inline float level_of(float size, float texels) {
  return clamp(log2(texels / (PAGE_EDGE * size)), 0.0f, (float)PAGE_LEVELS);
}

// The page of at most this level under a place.
static inline int page_under(const Receivers* on, int root, float2 place, int deepest) {
  int number = root;
  for (int level = 0; level < deepest; ++level) {
    const DevicePage page = on->pages[number];
    if (page.child == NO_PAGE) break;
    const float2 corner = place * (float)(2 << level) - convert_float2((int2)(2 * page.x + 1, 2 * page.y + 1));
    number = page.child + (corner.x >= 0.0f ? 1 : 0) + (corner.y >= 0.0f ? 2 : 0);
  }
  return number;
}

// The pages of at most this level under a footprint, which reaches over at most FOOTPRINT_TEXELS of their texels.
static inline int pages_under(const Receivers* on, int root, float2 low, float2 high, int deepest, int under[4]) {
  int count = 1;
  under[0] = root;
  for (int level = 0; level < deepest; ++level) {
    int next[4], next_count = 0;
    bool is_split = false;
    for (int i = 0; i < count; ++i) {
      const DevicePage page = on->pages[under[i]];
      if (page.child == NO_PAGE || page.level > level) {
        if (next_count < 4) next[next_count++] = under[i];
        continue;
      }
      is_split = true;
      const float to_level = (float)(2 << level); // pages of the children's level across the chart
      for (int child = 0; child < 4; ++child) {
        const float2 corner = convert_float2((int2)(2 * page.x + (child & 1), 2 * page.y + (child >> 1)));
        if (all(high * to_level > corner) && all(low * to_level <= corner + 1.0f) && next_count < 4)
          next[next_count++] = page.child + child;
      }
    }
    if (!is_split) break;
    count = next_count;
    for (int i = 0; i < count; ++i) under[i] = next[i];
  }
  return count;
}

// The footprint in texels of a page, from its corner.
static inline Footprint footprint_on_page(const Footprint* f, const DevicePage* page) {
  const float scale = (float)(PAGE_EDGE << page->level);
  Footprint on = *f;
  on.middle = f->middle * scale - convert_float2((int2)(page->x, page->y)) * (float)PAGE_EDGE;
  on.x *= scale;
  on.y *= scale;
  return on;
}

// The texels of a page that a footprint may touch: from.x to to.x and from.y to to.y.
static inline void texels_under(const Footprint* f, int2* from, int2* to) {
  *from = max(convert_int2_rtn(low_corner(f)), (int2)(0));
  *to = min(convert_int2_rtn(high_corner(f)), (int2)(PAGE_EDGE - 1));
}

static inline void add_quanta(volatile __global long* sum, long x, long y, long z) {
  add_exactly(sum, x);
  add_exactly(sum + 1, y);
  add_exactly(sum + 2, z);
}

// Adds a photon's light to the texel under its place on a chart.
static inline void add_point_to_chart(const Receivers* on, int root, float2 place, volatile __global long* sums,
                                      float3 quanta) {
  const int number = page_under(on, root, place, PAGE_LEVELS);
  const DevicePage page = on->pages[number];
  const int2 from_corner =
      convert_int2_rtn(place * (float)(PAGE_EDGE << page.level)) - (int2)(page.x, page.y) * PAGE_EDGE;
  const int2 texel = clamp(from_corner, (int2)(0), (int2)(PAGE_EDGE - 1)); // Oclgrind takes no scalars here
  add_quanta(sums + page_size(on) * (size_t)number + 3 * (texel.y * PAGE_EDGE + texel.x), convert_long_rte(quanta.x),
             convert_long_rte(quanta.y), convert_long_rte(quanta.z));
}

// Adds a footprint's light to a chart, by exact area; all texels together get all of it.
static inline void add_to_chart(const Receivers* on, int root, const Footprint* on_chart, int deepest,
                                volatile __global long* sums, float3 quanta) {
  int under[4];
  const int count = pages_under(on, root, low_corner(on_chart), high_corner(on_chart), deepest, under);
  float part = 0.0f;
  long rounded_before[3] = {0, 0, 0};
  for (int i = 0; i < count; ++i) {
    const DevicePage page = on->pages[under[i]];
    Footprint f = footprint_on_page(on_chart, &page);
    if (!has_area(&f)) shrink_to_point(&f);
    volatile __global long* const texels = sums + page_size(on) * (size_t)under[i];
    int2 from, to;
    texels_under(&f, &from, &to);
    for (int row = from.y; row <= to.y; ++row)
      for (int column = from.x; column <= to.x; ++column) {
        const float share =
            f.area == 0.0f ? 1.0f : covered(&f, (float2)((float)column, (float)row) - f.middle) / f.area;
        if (!(share > 0.0f)) continue;
        part = fmin(part + share, 1.0f);
        volatile __global long* const sum = texels + 3 * (row * PAGE_EDGE + column);
        const long rounded[3] = {convert_long_rte(quanta.x * part), convert_long_rte(quanta.y * part),
                                 convert_long_rte(quanta.z * part)};
        for (int c = 0; c < 3; ++c) {
          if (rounded[c] != rounded_before[c]) add_exactly(sum + c, rounded[c] - rounded_before[c]);
          rounded_before[c] = rounded[c];
        }
      }
  }
}

// Leaves a photon's light on its receiver. side: of the surface that it arrives at, 1 or -1. a, b: its footprint
// reaches from -a/2 - b/2 to a/2 + b/2 about the place; where that is wide or not finite, it is a point. sums: from
// first_texel on. quanta: its light as XYZ. False: too large, or not finite.
static inline bool add_to_receiver(const Receivers* on, const Surface* surface, float side, float3 a, float3 b,
                                   volatile __global long* sums, float3 quanta) {
  if (!(fabs(quanta.x) <= FILM_LIMIT && fabs(quanta.y) <= FILM_LIMIT && fabs(quanta.z) <= FILM_LIMIT)) return false;
  ReceiverPlace place = receiver_place(on, surface, side, a, b);
  if (place.receiver.first_chart == NO_PAGE) return true;
  const float3 size = fabs(place.a) + fabs(place.b);
  const float widest = fmax(size.x, fmax(size.y, size.z));
  const bool is_point = !(widest > 0.0f && widest < FOOTPRINT_TEXELS / PAGE_EDGE);
  if (is_point) place.a = place.b = (float3)(0.0f);
  for (int axis = 0; axis < 3; ++axis) {
    if (!(fabs(of_axis(place.normal, axis)) > CHART_LEAST)) continue;
    const Footprint f = footprint_on_chart(across_axis(place.position, axis), across_axis(place.a, axis),
                                           across_axis(place.b, axis));
    const int deepest = (int)level_of(widest, FOOTPRINT_TEXELS);
    // A look takes texels in the slab of its place, and those beside it may lie in the next one.
    const float depth = of_axis(place.position, axis), faces = fabs(of_axis(place.normal, axis)),
                rise = sqrt(fmax(1.0f - faces * faces, 0.0f)) / faces;
    const int root = on->roots[chart_of(&place, axis, depth)],
              level = root == NO_PAGE ? 0 : on->pages[page_under(on, root, f.middle, PAGE_LEVELS)].level;
    const float reach = 2.0f * rise / (float)(PAGE_EDGE << level) +
                        0.5f * (fabs(of_axis(place.a, axis)) + fabs(of_axis(place.b, axis)));
    const int last = chart_of(&place, axis, depth + reach);
    for (int chart = chart_of(&place, axis, depth - reach); chart <= last; ++chart)
      if (on->roots[chart] == NO_PAGE)
        continue;
      else if (is_point)
        add_point_to_chart(on, on->roots[chart], f.middle, sums, quanta);
      else
        add_to_chart(on, on->roots[chart], &f, deepest, sums, quanta);
  }
  return true;
}

// Makes the singular values of (a, b) at least `least`, so that a look never sees a single texel's edges.
static inline void widen(float2* a, float2* b, float least) {
  float cosine;
  const float sine = sincos(0.5f * atan2(2.0f * dot(*a, *b), dot(*a, *a) - dot(*b, *b)), &cosine);
  float2 along = cosine * *a + sine * *b, aside = cosine * *b - sine * *a;
  const float length_along = length(along), length_aside = length(aside);
  if (!(length_along > 1e-20f)) {
    along = (float2)(least, 0.0f);
    aside = (float2)(0.0f, least);
  } else {
    const float2 unit = along / length_along;
    along = fmax(length_along, least) * unit;
    aside = length_aside > 1e-3f * length_along ? aside * (fmax(length_aside, least) / length_aside)
                                                : least * (float2)(-unit.y, unit.x);
  }
  *a = cosine * along - sine * aside;
  *b = sine * along + cosine * aside;
}

// What a look at a place sees: a footprint on the chart that its surface faces most, and pages of this level.
typedef struct {
  int chart; // NO_PAGE: there is none
  float2 middle, a, b;
  int level;
  float cosine; // between the surface and the chart
} ChartLook;

// at: where the place is in its footprint, from (0, 0) to (1, 1).
static inline ChartLook look_on_chart(const Receivers* on, const Surface* surface, float side, float3 a, float3 b,
                                      float2 at) {
  ChartLook look;
  const ReceiverPlace place = receiver_place(on, surface, side, a, b);
  look.chart = NO_PAGE;
  if (place.receiver.first_chart == NO_PAGE) return look;
  const float3 faces = fabs(place.normal);
  const int axis = faces.x >= faces.y && faces.x >= faces.z ? 0 : faces.y >= faces.z ? 1 : 2;
  look.chart = chart_of(&place, axis, of_axis(place.position, axis));
  look.middle = across_axis(place.position, axis);
  look.a = across_axis(place.a, axis);
  look.b = across_axis(place.b, axis);
  look.cosine = of_axis(faces, axis);
  const float2 size = fabs(look.a) + fabs(look.b);
  float extent = fmax(size.x, size.y);
  const float most = FOOTPRINT_TEXELS / PAGE_EDGE;
  if (!(extent < most)) { // or not finite
    look.a = extent < 1e9f ? look.a * (most / extent) : (float2)(most, 0.0f);
    look.b = extent < 1e9f ? look.b * (most / extent) : (float2)(0.0f, most);
    extent = most;
  }
  look.middle += (0.5f - at.x) * look.a + (0.5f - at.y) * look.b;
  const float edge = sqrt(fabs(look.a.x * look.b.y - look.a.y * look.b.x));
  look.level = (int)fmin(round(level_of(edge, LOOK_TEXELS)), level_of(extent, FOOTPRINT_TEXELS));
  return look;
}

// The XYZ of each kind of light.
typedef struct {
  float3 caustic, indirect;
} LightOfKinds;

static inline void add_light(LightOfKinds* sum, float part, LightOfKinds more) {
  sum->caustic += part * more.caustic;
  sum->indirect += part * more.indirect;
}

// The mean irradiance over a footprint, in quanta per square unit, of `layers` layers, each with its weight. at: as in
// look_on_chart. totals: from first_texel of the first kind on, by receiver_light.cl.
static inline LightOfKinds look_at_receiver(const Receivers* on, const Surface* surface, float side, float3 a, float3 b,
                                            float2 at, __global const float* totals, int layers,
                                            const float* weights) {
  const LightOfKinds none = {(float3)(0.0f), (float3)(0.0f)};
  ChartLook look = look_on_chart(on, surface, side, a, b, at);
  if (look.chart == NO_PAGE || on->roots[look.chart] == NO_PAGE) return none;
  const int root = on->roots[look.chart];
  int under[4];
  const int level = on->pages[page_under(on, root, look.middle, look.level)].level;
  widen(&look.a, &look.b, 1.0f / (float)(PAGE_EDGE << level));
  const Footprint f = footprint_on_chart(look.middle, look.a, look.b);
  const int count = pages_under(on, root, low_corner(&f), high_corner(&f), level, under);
  LightOfKinds sum = none;
  float area = 0.0f;
  for (int i = 0; i < count; ++i) {
    const DevicePage page = on->pages[under[i]];
    Footprint on_page = footprint_on_page(&f, &page);
    has_area(&on_page);
    const float texel = 1.0f / (float)(PAGE_EDGE << page.level), orientation = on_page.area < 0.0f ? -1.0f : 1.0f;
    __global const float* const texels = totals + page_size(on) * (size_t)under[i];
    int2 from, to;
    texels_under(&on_page, &from, &to);
    for (int row = from.y; row <= to.y; ++row)
      for (int column = from.x; column <= to.x; ++column) {
        const float part =
            fmax(orientation * covered(&on_page, (float2)((float)column, (float)row) - on_page.middle), 0.0f);
        for (int layer = 0; layer < layers; ++layer) {
          const float weight = part * weights[layer];
          sum.caustic += weight * vload3(layer * PAGE_TEXELS + row * PAGE_EDGE + column, texels);
#if NEPHROID_KINDS_OF_LIGHT > 1
          sum.indirect +=
              weight * vload3((on->layers + layer) * PAGE_TEXELS + row * PAGE_EDGE + column, texels);
#endif
        }
        area += part * texel * texel;
      }
  }
  const float per_unit = on->receivers[surface->object].per_unit, square_units = area / (per_unit * per_unit);
  if (!(square_units > 0.0f)) return none;
  sum.caustic *= look.cosine / square_units;
  sum.indirect *= look.cosine / square_units;
  return sum;
}
