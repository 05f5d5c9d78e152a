// SPDX-License-Identifier: Apache-2.0
// Closest and any hit of a ray with triangles and ellipsoids in a bounding volume hierarchy of 8 children a node
// (app/scene/bvh.cpp builds it). A work item has one ray. The 8 boxes of a node and the 4 triangles of a block are
// tested at once, as float8 and float4.
//
// Node, 64 floats: for each axis 8 lower, then 8 upper bounds (48 floats), then 8 children as ints, then 8 unused.
//   A child >= 0 is a node. A child < 0 is a leaf: ~child = first block << 4 | blocks of ellipsoids << 2 | blocks of
//   triangles, which come first. A missing child has an empty box.
// Block of triangles, 40 floats: x, y, z of the first vertex of 4 triangles, of the second, of the third (36 floats),
//   then 4 triangle ids as ints. A missing triangle has its three vertices in one point.
// Block of ellipsoids, 40 floats: 3 of 13 floats, which are its centre, the rows of the matrix that takes a vector from
//   there to the unit sphere, and the primitive's id as an int; NEPHROID_NO_PRIMITIVE: a missing one.
//
// What is exact. A vertex is moved into the ray's space by the same operations for every triangle that it belongs to.
// The sign of an edge function is never wrong, only sometimes zero, and zero counts as inside. So a ray cannot pass
// between two triangles that share an edge (Woop, Benthin and Wald 2013, "Watertight ray/triangle intersection"). Boxes
// are grown by more than every rounding error of the tests, so the tree loses no primitive. Among hits at the same
// distance the lowest primitive id wins, so the answer depends on the mesh and the ray alone.
#include "kernels/tracing/registers.h"

// Entries of the traversal stack: at least Bvh::stack of the tree.
#ifndef NEPHROID_BVH_STACK
#define NEPHROID_BVH_STACK 96
#endif

// 0: all primitives are triangles.
#ifndef NEPHROID_ELLIPSOIDS
#define NEPHROID_ELLIPSOIDS 1
#endif

#define NEPHROID_NO_PRIMITIVE 0xFFFFFFFFu

// 1: one box and one triangle at a time.
#ifndef NEPHROID_BVH_SCALAR
#ifdef NEPHROID_GPU
#define NEPHROID_BVH_SCALAR 1
#else
#define NEPHROID_BVH_SCALAR 0
#endif
#endif

// A tree that needs one entry is a single leaf: a ball over a floor.
#define BVH_LEAF_ONLY (NEPHROID_ELLIPSOIDS && NEPHROID_BVH_STACK == 1)

typedef struct {
  float t;        // distance in lengths of the direction; the t_max given where nothing was hit
  float u, v; // barycentric: the point is (1 - u - v) v0 + u v1 + v v2; of an ellipsoid: of its point (u, v, w) on the
              // unit sphere
  uint primitive; // number of the triangle; ellipsoids count on from the triangles; or NEPHROID_NO_PRIMITIVE
#if NEPHROID_ELLIPSOIDS
  float w;
#endif
} Hit;

// A mask: bit i is set where lane i of a vector comparison is true. On x86 processors it is one instruction, which
// saves 15 % of a traversal's time. NEPHROID_BVH_PORTABLE leaves that out, to test what other devices run.
#if defined(NEPHROID_CPU) && defined(__AVX__) && defined(__has_builtin) && !defined(NEPHROID_BVH_PORTABLE)
#if __has_builtin(__builtin_ia32_movmskps256) && __has_builtin(__builtin_ia32_movmskps)
#define BVH_MOVEMASK
#endif
#endif
#ifdef BVH_MOVEMASK
static inline int bvh_mask8(int8 m) { return __builtin_ia32_movmskps256(as_float8(m)); }
static inline int bvh_mask4(int4 m) { return __builtin_ia32_movmskps(as_float4(m)); }
#else
static inline int bvh_mask8(int8 m) {
  const int8 bits = m & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
  const int4 b = bits.lo | bits.hi;
  const int2 c = b.lo | b.hi;
  return c.x | c.y;
}
static inline int bvh_mask4(int4 m) {
  const int4 bits = m & (int4)(1, 2, 4, 8);
  const int2 c = bits.lo | bits.hi;
  return c.x | c.y;
}
#endif
static inline int bvh_lowest_bit(int mask) { return 31 - clz(mask & -mask); }

// The minimum and maximum of numbers that may be infinite, as an empty box and an endless ray's t_max are. min and max
// are undefined there (OpenCL 1.2, 6.12.4), and fmin and fmax handle NaN, which costs 20 to 40 % here.
#define BVH_MIN(a, b) ((a) < (b) ? (a) : (b))
#define BVH_MAX(a, b) ((a) > (b) ? (a) : (b))

// A ray as the tests of boxes and primitives read it.
typedef struct {
  float3 inverse;             // 1 / direction, finite
  float3 near, far;           // origin / direction, rounded so that boxes only ever grow
  int near_x, near_y, near_z; // where in a node the bounds lie that the ray meets first
  int kx, ky, kz;             // axes: kz is where the direction is largest
  float ox, oy, oz;           // the origin along kx, ky, kz
  float sx, sy, sz;           // shear that makes the direction (0, 0, 1)
#if NEPHROID_ELLIPSOIDS
  float3 origin, direction;
#endif
} BvhRay;

// The components of a along kx, ky, kz, not read by index: a GPU would put the vector into memory for that.
static inline float3 bvh_axes(float3 a, int kz) { return kz == 0 ? a.yzx : kz == 1 ? a.zxy : a; }

// Finds where a ray from afar passes the scene's middle, where small objects are. Writes its point nearest to the
// middle and returns how far that is, in lengths of the direction; 0: the ray does not come from afar. Rounding errors,
// and with them the slack of bvh_ray, grow with the origin's distance: boxes of an object smaller than 2^-20 of it
// would all overlap, and the ray would test every triangle. One fused multiply-add rounds only its small result, so the
// point lies on the line as exactly as single precision allows.
static inline float bvh_approach(float3 o, float3 d, float3* nearest) {
  const float way = -dot(o, d) / dot(d, d);
  *nearest = fma((float3)(way), d, o);
  const float3 before = fabs(o), after = 16.0f * fabs(*nearest);
  const bool from_afar = BVH_MAX(BVH_MAX(after.x, after.y), after.z) < BVH_MAX(BVH_MAX(before.x, before.y), before.z);
  return from_afar && way > 0.0f ? way : 0.0f;
}

static inline float bvh_inverse(float d) { return 1.0f / copysign(BVH_MAX(fabs(d), 1e-20f), d); }

static inline BvhRay bvh_ray(float3 o, float3 d) {
  BvhRay r;
  r.inverse = (float3)(bvh_inverse(d.x), bvh_inverse(d.y), bvh_inverse(d.z));
  // Growing every box by `slack` covers the rounding of this test and of the triangle test that comes from the origin.
  // Rounding that comes from the triangles' own coordinates is in the tree's boxes already.
  const float slack = 0x1p-20f * BVH_MAX(BVH_MAX(fabs(o.x), fabs(o.y)), fabs(o.z));
  const float3 grow = fabs(r.inverse) * slack;
  r.near = o * r.inverse + grow;
  r.far = o * r.inverse - grow;
  r.near_x = r.inverse.x < 0.0f ? 8 : 0; // the inverse tells -0 from 0
  r.near_y = r.inverse.y < 0.0f ? 8 : 0;
  r.near_z = r.inverse.z < 0.0f ? 8 : 0;
  const float3 a = fabs(d);
  r.kz = a.x > a.y ? (a.x > a.z ? 0 : 2) : (a.y > a.z ? 1 : 2);
  r.kx = r.kz == 2 ? 0 : r.kz + 1;
  r.ky = r.kx == 2 ? 0 : r.kx + 1;
  const float3 along = bvh_axes(d, r.kz), start = bvh_axes(o, r.kz);
  r.sz = 1.0f / along.z;
  r.sx = along.x * r.sz;
  r.sy = along.y * r.sz;
  r.ox = start.x;
  r.oy = start.y;
  r.oz = start.z;
#if NEPHROID_ELLIPSOIDS
  r.origin = o;
  r.direction = d;
#endif
  return r;
}

// Children of a node whose boxes the ray meets within [t_min, t], as a mask; *entry is where it enters each.
static inline int bvh_boxes(global const float* node, const BvhRay* r, float t_min, float t, float8* entry) {
  const float8 ix = r->inverse.x, iy = r->inverse.y, iz = r->inverse.z;
  const float8 x0 = fma(vload8(0, node + r->near_x), ix, (float8)(-r->near.x));
  const float8 y0 = fma(vload8(0, node + 16 + r->near_y), iy, (float8)(-r->near.y));
  const float8 z0 = fma(vload8(0, node + 32 + r->near_z), iz, (float8)(-r->near.z));
  const float8 x1 = fma(vload8(0, node + 8 - r->near_x), ix, (float8)(-r->far.x));
  const float8 y1 = fma(vload8(0, node + 24 - r->near_y), iy, (float8)(-r->far.y));
  const float8 z1 = fma(vload8(0, node + 40 - r->near_z), iz, (float8)(-r->far.z));
  const float8 first = BVH_MAX(BVH_MAX(x0, y0), BVH_MAX(z0, (float8)(t_min)));
  const float8 last = BVH_MIN(BVH_MIN(x1, y1), BVH_MIN(z1, (float8)(t)));
  *entry = first;
  return bvh_mask8(first <= last);
}

// Tests a block of 4 triangles. Returns the mask of those hit within (t_min, t_max], with distance and barycentrics.
static inline int bvh_triangles(global const float* block, const BvhRay* r, float t_min, float t_max, float4* t,
                                float4* u, float4* v) {
// A fused multiply-add would round one of an edge function's two products alone, and its sign could be wrong.
#pragma OPENCL FP_CONTRACT OFF
  global const float* x = block + 4 * r->kx;
  global const float* y = block + 4 * r->ky;
  global const float* z = block + 4 * r->kz;
  const float4 az = vload4(0, z) - r->oz, bz = vload4(0, z + 12) - r->oz, cz = vload4(0, z + 24) - r->oz;
  const float4 ax = fma(-r->sx, az, vload4(0, x) - r->ox), ay = fma(-r->sy, az, vload4(0, y) - r->oy);
  const float4 bx = fma(-r->sx, bz, vload4(0, x + 12) - r->ox), by = fma(-r->sy, bz, vload4(0, y + 12) - r->oy);
  const float4 cx = fma(-r->sx, cz, vload4(0, x + 24) - r->ox), cy = fma(-r->sy, cz, vload4(0, y + 24) - r->oy);
  const float4 ea = cx * by - cy * bx, eb = ax * cy - ay * cx, ec = bx * ay - by * ax;
  const float4 det = ea + eb + ec;
  const float4 low = min(min(ea, eb), ec), high = max(max(ea, eb), ec);
  const int inside = bvh_mask4(((low >= 0.0f) | (high <= 0.0f)) & (det != 0.0f));
  if (inside == 0) return 0;
  const float4 scale = 1.0f / det;
  *t = (ea * az + eb * bz + ec * cz) * r->sz * scale;
  *u = eb * scale;
  *v = ec * scale;
  return inside & bvh_mask4((*t > t_min) & (*t <= t_max));
}

#if NEPHROID_ELLIPSOIDS
// Takes a vector from the ellipsoid's centre to the unit sphere's space.
static inline float3 bvh_to_unit_sphere(global const float* ellipsoid, float3 way) {
  return (float3)(dot(vload3(1, ellipsoid), way), dot(vload3(2, ellipsoid), way), dot(vload3(3, ellipsoid), way));
}

// Tests an ellipsoid: true where it is hit within (t_min, t_max]; *unit becomes the place on the unit sphere. The ray
// is cut at its point nearest to the centre first, so that neither the origin's distance nor a small half chord costs
// precision (Haines, Günther and Akenine-Möller 2019, "Precision improvements for ray/sphere intersection"): with l the
// nearest point of the line to the unit sphere's centre and e the direction there, |l + s e| = 1 at s = +-sqrt((1 -
// l^2) / e^2). leaves: the ray starts on the ellipsoid; its other hit lies ahead where the middle does.
static inline bool bvh_ellipsoid(global const float* ellipsoid, const BvhRay* r, float t_min, float t_max, bool leaves,
                                 float* t, float3* unit) {
  const float3 from_centre = r->origin - vload3(0, ellipsoid);
  const float way = -dot(from_centre, r->direction) / dot(r->direction, r->direction);
  const float3 nearest = bvh_to_unit_sphere(ellipsoid, fma((float3)(way), r->direction, from_centre));
  const float3 e = bvh_to_unit_sphere(ellipsoid, r->direction);
  const float inverse = 1.0f / dot(e, e);
  const float rest = -dot(nearest, e) * inverse; // 0 for a sphere
  const float3 l = fma((float3)(rest), e, nearest);
  const float left = 1.0f - dot(l, l);
  if (!(left > 0.0f)) return false;
  const float half_chord = sqrt(left * inverse), middle = way + rest;
  const bool first = !leaves && middle - half_chord > t_min;
  const float s = first ? -half_chord : half_chord;
  *t = middle + s;
  *unit = fma((float3)(s), e, l);
  return (!leaves || middle > 0.0f) && *t > t_min && *t <= t_max;
}

// Replaces `hit` by a nearer hit of `count` ellipsoids in blocks, if there is one.
static inline void bvh_ellipsoids(global const float* blocks, int count, const BvhRay* ray, float t_min, uint skip,
                                  Hit* hit) {
  for (int i = 0; i < count; ++i) {
    global const float* ellipsoid = blocks + 40 * (size_t)(i / 3) + 13 * (i % 3);
    const uint id = ((global const uint*)ellipsoid)[12];
    if (id == NEPHROID_NO_PRIMITIVE) break;
    float t;
    float3 unit;
    if (!bvh_ellipsoid(ellipsoid, ray, t_min, hit->t, id == skip, &t, &unit)) continue;
    if (t == hit->t && id >= hit->primitive) continue;
    hit->t = t;
    hit->u = unit.x;
    hit->v = unit.y;
    hit->w = unit.z;
    hit->primitive = id;
  }
}
#endif

#if NEPHROID_BVH_SCALAR
#include "kernels/tracing/bvh_scalar.h"
#else
// The closest hit with t_min < t <= t_max, without triangle `skip` and where the ray leaves ellipsoid `skip`.
static inline Hit bvh_closest(global const float* nodes, global const float* blocks, int root, BvhRay ray, float t_min,
                              float t_max, uint skip) {
  Hit hit = {t_max, 0.0f, 0.0f, NEPHROID_NO_PRIMITIVE};
  int at = root;
#if !BVH_LEAF_ONLY
  int waiting[NEPHROID_BVH_STACK];
  float waiting_entry[NEPHROID_BVH_STACK];
  int top = 0;
  while (true) {
    while (at >= 0) {
      global const float* node = nodes + 64 * (size_t)at;
      global const int* children = (global const int*)(node + 48);
      float8 entry;
      int mask = bvh_boxes(node, &ray, t_min, hit.t, &entry);
      if (mask == 0) goto next;
      int child = bvh_lowest_bit(mask);
      mask &= mask - 1;
      at = children[child];
      if (mask == 0) continue;
      // The traversal goes on with the nearest child. The others wait, the farthest at the bottom.
      float entries[8];
      vstore8(entry, 0, entries);
      float nearest = entries[child];
      const int bottom = top;
      do {
        child = bvh_lowest_bit(mask);
        mask &= mask - 1;
        int other = children[child];
        float other_entry = entries[child];
        if (other_entry < nearest) {
          const int swapped = at;
          const float swapped_entry = nearest;
          at = other;
          nearest = other_entry;
          other = swapped;
          other_entry = swapped_entry;
        }
        int place = top++;
        for (; place > bottom && waiting_entry[place - 1] < other_entry; --place) {
          waiting[place] = waiting[place - 1];
          waiting_entry[place] = waiting_entry[place - 1];
        }
        waiting[place] = other;
        waiting_entry[place] = other_entry;
      } while (mask);
    }
#endif
    {
      const int first = ~at >> 4, count = ~at & 3;
      for (int i = 0; i < count; ++i) {
        global const float* block = blocks + 40 * (size_t)(first + i);
        float4 t4, u4, v4;
        int mask = bvh_triangles(block, &ray, t_min, hit.t, &t4, &u4, &v4);
        if (mask == 0) continue;
        float t[4], u[4], v[4];
        vstore4(t4, 0, t);
        vstore4(u4, 0, u);
        vstore4(v4, 0, v);
        do {
          const int lane = bvh_lowest_bit(mask);
          mask &= mask - 1;
          const uint id = ((global const uint*)block)[36 + lane];
          if (id == skip || t[lane] > hit.t || (t[lane] == hit.t && id >= hit.primitive)) continue;
          hit.t = t[lane];
          hit.u = u[lane];
          hit.v = v[lane];
          hit.primitive = id;
        } while (mask);
      }
#if NEPHROID_ELLIPSOIDS
      bvh_ellipsoids(blocks + 40 * (size_t)(first + count), 3 * (~at >> 2 & 3), &ray, t_min, skip, &hit);
#endif
    }
#if BVH_LEAF_ONLY
  return hit;
#else
  next:
    do {
      if (top == 0) return hit;
      --top;
    } while (waiting_entry[top] > hit.t);
    at = waiting[top];
  }
#endif
}

// Whether anything is hit with t_min < t <= t_max; skips what bvh_closest skips.
static inline bool bvh_any(global const float* nodes, global const float* blocks, int root, BvhRay ray, float t_min,
                           float t_max, uint skip) {
#if BVH_LEAF_ONLY
  {
    const int at = root;
#else
  int waiting[NEPHROID_BVH_STACK];
  int top = 0;
  waiting[top++] = root;
  while (top > 0) {
    const int at = waiting[--top];
    if (at >= 0) {
      global const float* node = nodes + 64 * (size_t)at;
      global const int* children = (global const int*)(node + 48);
      float8 entry;
      for (int mask = bvh_boxes(node, &ray, t_min, t_max, &entry); mask; mask &= mask - 1)
        waiting[top++] = children[bvh_lowest_bit(mask)];
      continue;
    }
#endif
    const int first = ~at >> 4, count = ~at & 3;
    for (int i = 0; i < count; ++i) {
      global const float* block = blocks + 40 * (size_t)(first + i);
      float4 t, u, v;
      for (int mask = bvh_triangles(block, &ray, t_min, t_max, &t, &u, &v); mask; mask &= mask - 1)
        if (((global const uint*)block)[36 + bvh_lowest_bit(mask)] != skip) return true;
    }
#if NEPHROID_ELLIPSOIDS
    for (int i = 0; i < 3 * (~at >> 2 & 3); ++i) {
      global const float* ellipsoid = blocks + 40 * (size_t)(first + count + i / 3) + 13 * (i % 3);
      const uint id = ((global const uint*)ellipsoid)[12];
      float t;
      float3 unit;
      if (id == NEPHROID_NO_PRIMITIVE) break;
      if (bvh_ellipsoid(ellipsoid, &ray, t_min, t_max, id == skip, &t, &unit)) return true;
    }
#endif
  }
  return false;
}

#endif // NEPHROID_BVH_SCALAR

// Both queries below trace a ray from afar in two parts that overlap: the first from its origin, the second from its
// point nearest to the scene's middle, so that neither part sees rounding errors of the other's distance.
#define BVH_FIRST_PART 0.75f
#define BVH_SECOND_PART 0.5f

// The closest hit with t_min < t <= t_max. skip: the triangle or ellipsoid that the ray leaves, or
// NEPHROID_NO_PRIMITIVE; an ellipsoid is met again on its far side. The direction need not be of unit length, but must
// not be shorter than 1e-15. t_min may be negative, because a point near its goal defines a ray from afar more exactly.
COMPILED_ONCE Hit closest_hit(global const float* nodes, global const float* blocks, int root, float3 origin,
                              float3 direction, float t_min, float t_max, uint skip) {
  float3 nearest;
  const float way = bvh_approach(origin, direction, &nearest);
  float moved = 0.0f, to = way > 0.0f ? BVH_MIN(BVH_FIRST_PART * way, t_max) : t_max;
  Hit hit;
  while (true) {
    hit = bvh_closest(nodes, blocks, root, bvh_ray(origin, direction), t_min - moved, to - moved, skip);
    hit.t += moved;
    if (hit.primitive != NEPHROID_NO_PRIMITIVE || !(to < t_max)) return hit;
    origin = nearest;
    moved = way;
    t_min = BVH_SECOND_PART * way;
    if (NEPHROID_ELLIPSOIDS) skip = NEPHROID_NO_PRIMITIVE; // it lies behind this part's beginning
    to = t_max;
  }
}

// Whether anything but `skip` (as in closest_hit) is hit with 0 < t <= t_max.
COMPILED_ONCE bool any_hit(global const float* nodes, global const float* blocks, int root, float3 origin,
                           float3 direction, float t_max, uint skip) {
  float3 nearest;
  const float way = bvh_approach(origin, direction, &nearest);
  float t_min = 0.0f, moved = 0.0f, to = way > 0.0f ? BVH_MIN(BVH_FIRST_PART * way, t_max) : t_max;
  while (true) {
    if (bvh_any(nodes, blocks, root, bvh_ray(origin, direction), t_min - moved, to - moved, skip)) return true;
    if (!(to < t_max)) return false;
    origin = nearest;
    moved = way;
    t_min = BVH_SECOND_PART * way;
    if (NEPHROID_ELLIPSOIDS) skip = NEPHROID_NO_PRIMITIVE; // it lies behind this part's beginning
    to = t_max;
  }
}
