// SPDX-License-Identifier: Apache-2.0
// What the camera sees of each pixel: whether one surface fills it, so that no ray need be asked what stands before a
// photon there.
#include "kernels/photons/tile_types.h"
#include "kernels/tracing/camera.h"
#include "kernels/tracing/work_item.h"
#include "kernels/tracing/world.h"

// corners: [row][column] of (height + 1) x (width + 1): the object, -1: none; as_uint(1 / its depth along the view).
__kernel void pixel_corners(WORLD_ARGUMENTS, DeviceCamera camera, __global uint2* corners, uint count) {
  const World world = WORLD;
  const uint number = work_item();
  if (number >= count) return;
  const uint across = (uint)camera.width + 1u;
  const float3 direction = primary_direction(&camera, (int)(number % across), (int)(number / across), (float2)(0.0f));
  Path path = path_from_eye(&camera, direction);
  const Hit hit = next_hit(&world, &path);
  int object = -1;
  float per_depth = 0.0f;
  if (hit.primitive != NEPHROID_NO_PRIMITIVE) {
    object = object_of_primitive(&world.geometry, hit.primitive);
    per_depth = 1.0f / (hit.t * dot(direction, camera.forward.xyz));
  }
  corners[number] = (uint2)(as_uint(object), as_uint(per_depth));
}

// views: [row][column].
__kernel void pixel_views(__global const uint2* corners, int width, int height, __global PixelView* views) {
  const int number = (int)work_item();
  if (number >= width * height) return;
  __global const uint2* corner = corners + (size_t)(number / width) * (width + 1) + number % width;
  const uint2 seen[4] = {corner[0], corner[1], corner[width + 1], corner[width + 2]};
  PixelView view = {(int)seen[0].x, INFINITY, 0.0f};
  for (int i = 0; i < 4; ++i) {
    const float per_depth = as_float(seen[i].y);
    view.farthest = fmin(view.farthest, per_depth);
    view.nearest = fmax(view.nearest, per_depth);
    if (seen[i].x != seen[0].x) view.object = VIEW_OF_SEVERAL;
  }
  // A pixel of one slanted surface has a small range of depths.
  const float range = view.nearest - view.farthest;
  if (range > 0.1f * view.nearest) view.object = VIEW_OF_SEVERAL;
  const float slack = range + 1e-3f * view.nearest;
  view.farthest -= slack;
  view.nearest += slack;
  views[number] = view;
}
