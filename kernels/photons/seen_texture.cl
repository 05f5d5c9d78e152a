// SPDX-License-Identifier: Apache-2.0
// The textures that the camera sees: light is spread over pixels without them.
#include "kernels/tracing/item_kernel.h"
#include "kernels/transport/eye_path.h"
#include "kernels/transport/eye_walk.h"

// Each is the mean of so many places in a pixel, along an edge.
#define PLACES_ALONG 4

// The colour of the texture, 1 without one, at the base that the likelier way through glass and by way of mirrors leads
// to; w: whether there is one.
static inline float4 texture_at_base(const World* world, Path path, Hit hit, uint pixel) {
  Interaction at = interaction_at(world, hit);
  if (!is_matt(&at.material)) {
    const Band band = whole_cluster(world->scene.cluster_count / 2);
    Visitor eye = eye_visitor(&band, (uint2)(0u), 0u, 0u, pixel, STREAM_CAMERA);
    eye.likelier = true;
    if (reach_base(world, &eye, &path, &hit, &at) == 0.0f) return (float4)(0.0f);
  }
  const Reflector reflector = reflector_at(world, &at.surface, at.triangle);
  return reflector.is_textured ? (float4)(reflector.rgb, 1.0f) : (float4)(1.0f);
}

// colours: [pixel][3], linear RGB; 1 where there is no texture.
ITEM_KERNEL(seen_texture, (WORLD_ARGUMENTS, DeviceCamera camera, uint count, __global float* colours),
                          (WORLD_NAMES, camera, count, colours)) {
  const World world = WORLD;
  if (index >= count) return;
  float4 sum = (float4)(0.0f);
  for (int i = 0; i < PLACES_ALONG * PLACES_ALONG; ++i) {
    const float2 place = ((float2)(i % PLACES_ALONG, i / PLACES_ALONG) + 0.5f) / PLACES_ALONG;
    float3 direction;
    EYE_OF(camera);
    const Hit hit = first_hit(&world, eye, index, place, (uint2)(0u), 0u, &direction);
    if (hit.primitive != NEPHROID_NO_PRIMITIVE)
      sum += texture_at_base(&world, path_from_eye(eye, direction), hit, index);
  }
  vstore3(sum.w > 0.0f ? sum.xyz / sum.w : (float3)(1.0f), index, colours);
}
