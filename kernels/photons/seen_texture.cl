// SPDX-License-Identifier: Apache-2.0
// The textures of the matt surfaces that the camera sees directly: light is spread over pixels without them.
#include "kernels/tracing/work_item.h"
#include "kernels/transport/eye_path.h"

// Each is the mean of so many places in a pixel, along an edge.
#define PLACES_ALONG 2

// colours: [pixel][3], linear RGB; 1 where there is no texture.
__kernel void seen_texture(WORLD_ARGUMENTS, DeviceCamera camera, uint count, __global float* colours) {
  const World world = WORLD;
  const uint pixel = work_item();
  if (pixel >= count) return;
  float3 sum = (float3)(0.0f);
  for (int i = 0; i < PLACES_ALONG * PLACES_ALONG; ++i) {
    const float2 place = ((float2)(i % PLACES_ALONG, i / PLACES_ALONG) + 0.5f) / PLACES_ALONG;
    float3 direction;
    EYE_OF(camera);
    const Hit hit = first_hit(&world, eye, pixel, place, (uint2)(0u), 0u, STREAM_CAMERA, &direction);
    float3 colour = (float3)(1.0f);
    if (hit.primitive != NEPHROID_NO_PRIMITIVE) {
      const Surface surface = surface_of(&world, hit);
      const Reflector reflector = reflector_at(&world, &surface, hit.primitive);
      if (reflector.is_textured) colour = reflector.rgb;
    }
    sum += colour;
  }
  vstore3(sum / (PLACES_ALONG * PLACES_ALONG), pixel, colours);
}
