// SPDX-License-Identifier: Apache-2.0
// The traversal of bvh.h for devices whose work items have no vectors: one box and one triangle at a time, with few
// registers. A level of the tree that waits is a node and the mask of its children still to be visited, 5 bytes. The
// nearest is found anew each time, within the closest hit so far. Hits are the same bit for bit.
// The levels of the tree that may wait: at least Bvh::depth.
#ifndef NEPHROID_BVH_DEPTH
#define NEPHROID_BVH_DEPTH 96
#endif

// The nearest child in the mask `left` whose box the ray meets within [t_min, t]; -1: none. Removes it and missed ones.
static inline int bvh_nearest(global const float* node, const BvhRay* r, float t_min, float t, int* left) {
  int nearest = -1;
  float nearest_entry = INFINITY;
  for (int rest = *left; rest; rest &= rest - 1) {
    const int child = bvh_lowest_bit(rest);
    const float x0 = fma(node[r->near_x + child], r->inverse.x, -r->near.x);
    const float y0 = fma(node[16 + r->near_y + child], r->inverse.y, -r->near.y);
    const float z0 = fma(node[32 + r->near_z + child], r->inverse.z, -r->near.z);
    const float x1 = fma(node[8 - r->near_x + child], r->inverse.x, -r->far.x);
    const float y1 = fma(node[24 - r->near_y + child], r->inverse.y, -r->far.y);
    const float z1 = fma(node[40 - r->near_z + child], r->inverse.z, -r->far.z);
    const float first = BVH_MAX(BVH_MAX(x0, y0), BVH_MAX(z0, t_min)), last = BVH_MIN(BVH_MIN(x1, y1), BVH_MIN(z1, t));
    if (!(first <= last)) {
      *left &= ~(1 << child);
    } else if (nearest < 0 || first < nearest_entry) {
      nearest = child;
      nearest_entry = first;
    }
  }
  if (nearest >= 0) *left &= ~(1 << nearest);
  return nearest;
}

// bvh_triangles for one triangle; corner: its lane of a block.
static inline bool bvh_triangle(global const float* corner, const BvhRay* r, float t_min, float t_max, float* t,
                                float* u, float* v) {
#pragma OPENCL FP_CONTRACT OFF
  global const float* x = corner + 4 * r->kx;
  global const float* y = corner + 4 * r->ky;
  global const float* z = corner + 4 * r->kz;
  const float az = z[0] - r->oz, bz = z[12] - r->oz, cz = z[24] - r->oz;
  const float ax = fma(-r->sx, az, x[0] - r->ox), ay = fma(-r->sy, az, y[0] - r->oy);
  const float bx = fma(-r->sx, bz, x[12] - r->ox), by = fma(-r->sy, bz, y[12] - r->oy);
  const float cx = fma(-r->sx, cz, x[24] - r->ox), cy = fma(-r->sy, cz, y[24] - r->oy);
  const float ea = cx * by - cy * bx, eb = ax * cy - ay * cx, ec = bx * ay - by * ax;
  const float det = ea + eb + ec;
  if (!((min(min(ea, eb), ec) >= 0.0f || max(max(ea, eb), ec) <= 0.0f) && det != 0.0f)) return false;
  const float scale = 1.0f / det;
  *t = (ea * az + eb * bz + ec * cz) * r->sz * scale;
  *u = eb * scale;
  *v = ec * scale;
  return *t > t_min && *t <= t_max;
}

// Replaces `hit` by a nearer hit in a leaf, if there is one.
static inline void bvh_leaf(global const float* blocks, int leaf, const BvhRay* ray, float t_min, uint skip, Hit* hit) {
  const int first = ~leaf >> 4, triangles = 4 * (~leaf & 3);
  for (int i = 0; i < triangles; ++i) {
    global const float* block = blocks + 40 * (size_t)(first + i / 4);
    float t, u, v;
    if (!bvh_triangle(block + i % 4, ray, t_min, hit->t, &t, &u, &v)) continue;
    const uint id = ((global const uint*)block)[36 + i % 4];
    if (id == skip || (t == hit->t && id >= hit->primitive)) continue;
    hit->t = t;
    hit->u = u;
    hit->v = v;
    hit->primitive = id;
  }
#if NEPHROID_ELLIPSOIDS
  bvh_ellipsoids(blocks + 40 * (size_t)(first + triangles / 4), 3 * (~leaf >> 2 & 3), ray, t_min, skip, hit);
#endif
}

// any: the traversal stops at the first hit that it finds.
static inline Hit bvh_hit(global const float* nodes, global const float* blocks, int root, const BvhRay* ray,
                          float t_min, float t_max, uint skip, bool any) {
  Hit hit = {t_max, 0.0f, 0.0f, NEPHROID_NO_PRIMITIVE};
  int at = root, left = 0xFF;
  int waiting[NEPHROID_BVH_DEPTH];
  uchar waiting_left[NEPHROID_BVH_DEPTH];
  int top = 0;
  while (true) {
    if (!BVH_LEAF_ONLY && at >= 0) {
      global const float* node = nodes + 64 * (size_t)at;
      const int child = bvh_nearest(node, ray, t_min, hit.t, &left);
      if (child >= 0) {
        waiting[top] = at;
        waiting_left[top] = (uchar)left;
        top += left != 0;
        at = ((global const int*)node)[48 + child];
        left = 0xFF;
        continue;
      }
    } else {
      bvh_leaf(blocks, at, ray, t_min, skip, &hit);
      if (any && hit.primitive != NEPHROID_NO_PRIMITIVE) return hit;
    }
    if (top == 0) return hit;
    --top;
    at = waiting[top];
    left = waiting_left[top];
  }
}

static inline Hit bvh_closest(global const float* nodes, global const float* blocks, int root, BvhRay ray, float t_min,
                              float t_max, uint skip) {
  return bvh_hit(nodes, blocks, root, &ray, t_min, t_max, skip, false);
}

static inline bool bvh_any(global const float* nodes, global const float* blocks, int root, BvhRay ray, float t_min,
                           float t_max, uint skip) {
  return bvh_hit(nodes, blocks, root, &ray, t_min, t_max, skip, true).primitive != NEPHROID_NO_PRIMITIVE;
}
