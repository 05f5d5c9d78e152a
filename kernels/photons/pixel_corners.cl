// SPDX-License-Identifier: Apache-2.0
// What the camera sees at the corners of pixels. A pixel with the same surface at all four needs no ray to tell whether
// something stands before a photon there.
#include "kernels/tracing/camera.h"
#include "kernels/tracing/world.h"

// corners: [row][column] of (height + 1) x (width + 1): as_float(object), -1: none; its depth along the view.
__kernel void pixel_corners(WORLD_ARGUMENTS, DeviceCamera camera, __global uint2* corners, uint count) {
  const World world = WORLD;
  const uint number = (uint)get_global_id(0);
  if (number >= count) return;
  const uint across = (uint)camera.width + 1u;
  const float3 direction =
      primary_direction(&camera, (int)(number % across), (int)(number / across), (float2)(0.0f));
  Path path = path_from_eye(&camera, direction);
  const Hit hit = next_hit(&world, &path);
  int object = -1;
  float depth = 0.0f;
  if (hit.primitive != NEPHROID_NO_PRIMITIVE) {
    object = object_of_primitive(&world.geometry, hit.primitive);
    depth = hit.t * dot(direction, camera.forward.xyz);
  }
  corners[number] = (uint2)(as_uint(object), as_uint(depth));
}
