// SPDX-License-Identifier: Apache-2.0
// Traces rays from a buffer, one an item, so that tests and benchmarks reach bvh.h. Engines call bvh.h directly.
#include "kernels/tracing/bvh.h"
#include "kernels/tracing/work_item.h"

typedef struct {
  float origin[3];
  float t_max;
  float direction[3];
  uint skip;
} DeviceRay;

typedef struct {
  float t, u, v;
  uint primitive;
} DeviceHit;

static inline float3 trace_vector(global const float* a) { return (float3)(a[0], a[1], a[2]); }

kernel void closest_hits(global const float* nodes, global const float* blocks, int root, global const DeviceRay* rays,
                         global DeviceHit* hits, uint count) {
  const uint i = work_item();
  if (i >= count) return;
  const Hit hit = closest_hit(nodes, blocks, root, trace_vector(rays[i].origin), trace_vector(rays[i].direction), 0.0f,
                              rays[i].t_max, rays[i].skip);
  const DeviceHit found = {hit.t, hit.u, hit.v, hit.primitive};
  hits[i] = found;
}

kernel void any_hits(global const float* nodes, global const float* blocks, int root, global const DeviceRay* rays,
                     global uint* hit, uint count) {
  const uint i = work_item();
  if (i >= count) return;
  hit[i] = any_hit(nodes, blocks, root, trace_vector(rays[i].origin), trace_vector(rays[i].direction), rays[i].t_max,
                   rays[i].skip);
}
