// SPDX-License-Identifier: Apache-2.0
// Splats a photon as the parallelogram that it stands for, by exact area: each pixel gets the part of the photon's
// light that lies in it. Footprints of neighbours in a lattice share their edges, so together they leave no gap.
#include "kernels/photons/footprint.h"
#include "kernels/photons/splat.h"
#include "kernels/photons/tile_types.h"

// How far a place moves on the film when it moves by `offset`. False: behind the camera.
static inline bool moved_on_film(const DeviceCamera* camera, float3 position, float3 offset, float2* moved) {
  const float3 from_camera = position - camera->position.xyz;
  const float3 here = (float3)(dot(from_camera, camera->right.xyz), dot(from_camera, camera->up.xyz),
                               dot(from_camera, camera->forward.xyz));
  const float3 step =
      (float3)(dot(offset, camera->right.xyz), dot(offset, camera->up.xyz), dot(offset, camera->forward.xyz));
  const float z = here.z + step.z;
  if (!(z > 1e-3f * here.z)) return false;
  const float2 slope = (step.xy * here.z - here.xy * step.z) / (here.z * z); // the difference, without cancellation
  *moved =
      0.5f * (float2)(slope.x / camera->tan_x * (float)camera->width, -slope.y / camera->tan_y * (float)camera->height);
  return true;
}

// A receiver's plane, for what stands between the camera and it.
typedef struct {
  __global const PixelView* views;
  int object;
  float3 per_depth; // 1 / depth along the view at (1, column, row)
  float3 position, normal;
  float side; // 1: light falls on its outer side
  float offset;
  uint triangle;
} SeenReceiver;

static inline SeenReceiver seen_receiver(const DeviceCamera* camera, __global const PixelView* views,
                                         const Surface* surface, uint triangle, float side) {
  // The ray of a pixel is forward + x right + y up at depth 1, x = (2 column / width - 1) tan_x, and it meets the plane
  // where depth * (normal . ray) = normal . (position - camera).
  const float3 n = surface->geometric / dot(surface->position - camera->position.xyz, surface->geometric);
  const float right = dot(n, camera->right.xyz) * camera->tan_x, up = dot(n, camera->up.xyz) * camera->tan_y;
  const SeenReceiver receiver = {views,
                                 surface->object,
                                 (float3)(dot(n, camera->forward.xyz) - right + up, 2.0f * right / (float)camera->width,
                                          -2.0f * up / (float)camera->height),
                                 surface->position,
                                 surface->geometric,
                                 side,
                                 surface->offset,
                                 triangle};
  return receiver;
}

// Whether the camera sees the receiver at a place of a pixel, in pixels. Asks a ray only where the pixel has several
// things in view.
static inline bool is_seen(const World* world, const DeviceCamera* camera, const SeenReceiver* receiver, int pixel,
                           float2 place) {
#if NEPHROID_OCCLUSION
  if (camera->receiver >= 0) return true;
  const PixelView view = receiver->views[pixel];
  const float per_depth = receiver->per_depth.x + receiver->per_depth.y * place.x + receiver->per_depth.z * place.y;
  if (view.object != VIEW_OF_SEVERAL)
    return view.object == receiver->object && per_depth >= view.farthest && per_depth <= view.nearest;
  if (!(per_depth > 0.0f)) return false; // above the plane's horizon
  const float2 slope = (float2)((2.0f * place.x / (float)camera->width - 1.0f) * camera->tan_x,
                                (1.0f - 2.0f * place.y / (float)camera->height) * camera->tan_y);
  const float3 from = camera->position.xyz +
                      (camera->forward.xyz + slope.x * camera->right.xyz + slope.y * camera->up.xyz) / per_depth +
                      receiver->side * receiver->offset * receiver->normal;
  const float3 back = camera->position.xyz - from;
  const float distance = length(back);
  return !is_blocked(world, from, back / distance, distance, receiver->triangle);
#else
  return true;
#endif
}

// A place in a square for each photon and pixel, evenly spread over the photons (Roberts' R2 sequence).
static inline float2 place_within(uint photon, uint pixel) {
  const uint start = pixel * 0x9e3779b9u ^ pixel >> 7;
  return convert_float2((uint2)(start + photon * 0xc13fa9a9u, (start ^ 0x5bd1e995u) + photon * 0x91e10da5u) >> 8) *
         0x1p-24f;
}

// Whether a footprint reaches the picture.
static inline bool touches_film(const DeviceCamera* camera, const Footprint* f) {
  const float2 low = low_corner(f), high = high_corner(f);
  return high.x >= 0.0f && high.y >= 0.0f && low.x < (float)camera->width && low.y < (float)camera->height;
}

// Adds a photon's light to the pixels. xyz: as of one pixel that gets all of it. False: too large for the film.
static inline bool add_footprint(const World* world, volatile __global long* film, const DeviceCamera* camera,
                                 const SeenReceiver* receiver, const Footprint* f, uint photon, float3 xyz,
                                 float scale) {
  const float2 low = (float2)(least(f->x), least(f->y)), high = (float2)(greatest(f->x), greatest(f->y));
  const int2 first = convert_int2_rtn(f->middle + low), last = convert_int2_rtn(f->middle + high);
  if (any(last < 0) || first.x >= camera->width || first.y >= camera->height) return true;
  const float3 quanta = xyz * scale;
  if (!(fabs(quanta.x) <= FILM_LIMIT && fabs(quanta.y) <= FILM_LIMIT && fabs(quanta.z) <= FILM_LIMIT)) return false;
  const bool in_one_pixel = all(first == last);
  const float per_area = 1.0f / f->area;
  float part = 0.0f;
  long rounded_before[3] = {0, 0, 0};
  for (int row = max(first.y, 0); row <= min(last.y, camera->height - 1); ++row) {
    // what the footprint has of this row
    const float top = (float)row - f->middle.y;
    const float4 y = clamp(f->y, top, top + 1.0f), xa = f->x + (y - f->y) * f->slope,
                 xb = f->x + (y.yzwx - f->y) * f->slope, rise = (f->y.yzwx - f->y) * f->area;
    const int4 is_beside = fmax(f->y, f->y.yzwx) < top || fmin(f->y, f->y.yzwx) > top + 1.0f;
    const float left = least(select(fmin(xa, xb), (float4)(INFINITY), is_beside)),
                right = greatest(select(fmax(xa, xb), (float4)(-INFINITY), is_beside)),
                inner_left = greatest(select(fmax(xa, xb), (float4)(-INFINITY), is_beside || rise >= 0.0f)),
                inner_right = least(select(fmin(xa, xb), (float4)(INFINITY), is_beside || rise <= 0.0f));
    const bool whole_row = low.y <= top && high.y >= top + 1.0f;
    const int from = max((int)floor(f->middle.x + left), 0),
              to = min((int)floor(f->middle.x + right), camera->width - 1);
    for (int column = from; column <= to; ++column) {
      float share = 1.0f;
      const float start = (float)column - f->middle.x;
      if (whole_row && start >= inner_left && start + 1.0f <= inner_right)
        share = fabs(per_area);
      else if (!in_one_pixel)
        share = covered(f, (float2)(start, top)) * per_area;
      if (!(share > 0.0f)) continue;
      // rounded sums, so that all pixels together get all of it
      part = fmin(part + share, 1.0f); // tiny footprints' shares are rounded
      const float2 from_corner = fmax((float2)((float)column, (float)row), f->middle + low),
                   to_corner = fmin((float2)((float)column + 1.0f, (float)row + 1.0f), f->middle + high);
      const int pixel = row * camera->width + column;
      const bool seen = is_seen(world, camera, receiver, pixel,
                                from_corner + (to_corner - from_corner) * place_within(photon, (uint)pixel));
      volatile __global long* sum = film + 3 * (size_t)pixel;
      const long rounded[3] = {convert_long_rte(quanta.x * part), convert_long_rte(quanta.y * part),
                               convert_long_rte(quanta.z * part)};
      for (int c = 0; c < 3; ++c) {
        if (seen && rounded[c] != rounded_before[c]) add_exactly(sum + c, rounded[c] - rounded_before[c]);
        rounded_before[c] = rounded[c];
      }
    }
  }
  return true;
}

// The footprint that reaches from -a/2 - b/2 to a/2 + b/2 about a place, shrunk to `widest` pixels. False where there
// is none: it has no area, is not finite, or reaches behind the camera. *shrunk: by which factor.
static inline bool footprint_on_film(const DeviceCamera* camera, float3 position, float3 a, float3 b, float widest,
                                     Footprint* f, float* shrunk) {
  float2 u, v;
  // The first-order size decides, so that a footprint that would reach behind the camera is small enough before.
  const float3 nearly = 1e-3f * a, nearby = 1e-3f * b;
  *shrunk = 1.0f;
  if (!moved_on_film(camera, position, nearly, &u) || !moved_on_film(camera, position, nearby, &v)) return false;
  const float2 reach = 1e3f * (fabs(u) + fabs(v));
  const float extent = fmax(reach.x, reach.y);
  if (!(extent < 1e20f)) return false;
  if (extent > widest) *shrunk = widest / extent;
  const float3 half_a = (0.5f * *shrunk) * a, half_b = (0.5f * *shrunk) * b;
  f->area = 0.0f;
  float2 corner[4];
  for (int i = 0; i < 4; ++i) {
    const float3 offset = (i == 1 || i == 2 ? half_a : -half_a) + (i >= 2 ? half_b : -half_b);
    if (!moved_on_film(camera, position, offset, &corner[i])) return false;
  }
  f->x = (float4)(corner[0].x, corner[1].x, corner[2].x, corner[3].x);
  f->y = (float4)(corner[0].y, corner[1].y, corner[2].y, corner[3].y);
  return has_area(f);
}
