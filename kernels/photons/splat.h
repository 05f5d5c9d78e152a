// SPDX-License-Identifier: Apache-2.0
// Adds a photon on a diffuse surface to the pixel that sees it. Unbiased: no map, no radius.
#include "kernels/scatter/scatter.h"
#include "kernels/tracing/camera.h"
#include "kernels/tracing/film.h"

// 0: nothing can stand between the camera and what it sees.
#ifndef NEPHROID_OCCLUSION
#define NEPHROID_OCCLUSION 1
#endif

// The way from a position to where the camera sees it from.
static inline float3 way_to_camera(const DeviceCamera* camera, float3 position) {
#if NEPHROID_LENS
  if (camera->orthographic)
    return dot(camera->position.xyz - position, camera->forward.xyz) *
           (camera->forward.xyz + camera->shift_x * camera->right.xyz + camera->shift_y * camera->up.xyz);
#endif
  return camera->position.xyz - position;
}

// The place of `position` in pixels from the top left corner. *depth is along the view, positive before the camera.
static inline float2 place_on_film(const DeviceCamera* camera, float3 position, float* depth) {
  const float3 to_camera = camera->position.xyz - position;
  const float z = -dot(to_camera, camera->forward.xyz);
  *depth = z;
#if NEPHROID_LENS
  const float far = camera->orthographic ? 1.0f : z;
  const float right = dot(to_camera, camera->right.xyz) + camera->shift_x * z,
              up = dot(to_camera, camera->up.xyz) + camera->shift_y * z;
  return (float2)((0.5f - 0.5f * right / (far * camera->tan_x)) * (float)camera->width,
                  (0.5f + 0.5f * up / (far * camera->tan_y)) * (float)camera->height);
#endif
  const float x = 0.5f - 0.5f * dot(to_camera, camera->right.xyz) / (z * camera->tan_x);
  const float y = 0.5f + 0.5f * dot(to_camera, camera->up.xyz) / (z * camera->tan_y);
  return (float2)(x * (float)camera->width, y * (float)camera->height);
}

// Whether the camera sees the side of `position` that light arrives on; *weight becomes the irradiance-to-pixel factor
// in m^-2: a flux F deposited there adds F reflectance / pi * weight to the pixel's radiance. A pixel's value is the
// mean of the radiance over its area A on the plane at distance 1, so F enters as F dq / (dA A), with dq / dA =
// cos(theta) distance / z^3 (theta at the surface, z along the view axis); orthographic: cos(theta) distance / z, in
// units of the picture's plane.
static inline bool project_to_film(const DeviceCamera* camera, float3 position, float3 geometric, float3 arriving,
                                   float metres_per_unit, float2* place, float* weight) {
  const float3 to_camera = way_to_camera(camera, position);
  const float cos_camera = dot(to_camera, geometric), cos_arriving = -dot(arriving, geometric);
  if (!(cos_camera * cos_arriving > 0.0f)) return false; // the camera sees its other side
  float z;
  *place = place_on_film(camera, position, &z);
  if (!(z > 0.0f)) return false;
  const float pixel_area = 4.0f * camera->tan_x * camera->tan_y / ((float)camera->width * (float)camera->height);
#if NEPHROID_LENS
  const float depth = (camera->orthographic ? 1.0f : z) * metres_per_unit; // parallel rays do not part with depth
#else
  const float depth = z * metres_per_unit;
#endif
  // cos_camera already is cos(theta) times the distance.
  *weight = fabs(cos_camera) / (z * depth * depth * pixel_area);
  return true;
}

// The pixel that sees `position`, or -1; *weight as above.
static inline int project_to_pixel(const DeviceCamera* camera, float3 position, float3 geometric, float3 arriving,
                                   float metres_per_unit, float* weight) {
  float2 place;
  if (!project_to_film(camera, position, geometric, arriving, metres_per_unit, &place, weight)) return -1;
  if (!(place.x >= 0.0f && place.x < (float)camera->width && place.y >= 0.0f && place.y < (float)camera->height))
    return -1;
  return (int)place.y * camera->width + (int)place.x;
}

// The pixel of a splat, and the factor from the light there to the pixel's radiance.
typedef struct {
  int pixel;    // -1: no pixel sees it
  float weight; // m^-2, see project_to_pixel; with shading_ratio
} Splat;

// The pixel that sees a place of a surface that light arrives at.
COMPILED_ONCE Splat splat_at(const World* world, const DeviceCamera* camera, const Surface* surface, uint triangle,
                             float3 arriving) {
  Splat splat = {-1, 0.0f};
  splat.pixel = project_to_pixel(camera, surface->position, surface->geometric, arriving, world->scene.metres_per_unit,
                                 &splat.weight);
  splat.weight *= shading_ratio(surface, arriving);
  splat.weight *= part_to_base(world, surface, normalize(way_to_camera(camera, surface->position)));
  if (camera->receiver >= 0) {
    if (surface->object != camera->receiver) splat.pixel = -1;
    return splat;
  }
#if NEPHROID_OCCLUSION
  if (splat.pixel < 0) return splat;
  const float3 from = start_on_side(surface, dot(arriving, surface->geometric) < 0.0f ? 1.0f : -1.0f);
  const float3 way = way_to_camera(camera, from);
  const float distance = length(way);
  if (is_blocked(world, from, way / distance, distance, triangle)) splat.pixel = -1;
#endif
  return splat;
}
