// SPDX-License-Identifier: Apache-2.0
// Splats a photon as the parallelogram that it stands for, by exact area: each pixel gets the part of the photon's light
// that lies in it. Footprints of neighbours in a lattice share their edges, so together they leave no gap.
#include "kernels/photons/splat.h"

// A parallelogram on the film, in pixels.
typedef struct {
  float2 corner[4]; // around it, relative to `middle`
  float2 middle;
  float area;
} FilmFootprint;

// How far a place moves on the film when it moves by `way`. False: behind the camera.
static inline bool moved_on_film(const DeviceCamera* camera, float3 position, float3 way, float2* moved) {
  const float3 from_camera = position - camera->position.xyz;
  const float3 here = (float3)(dot(from_camera, camera->right.xyz), dot(from_camera, camera->up.xyz),
                               dot(from_camera, camera->forward.xyz));
  const float3 step = (float3)(dot(way, camera->right.xyz), dot(way, camera->up.xyz), dot(way, camera->forward.xyz));
  const float z = here.z + step.z;
  if (!(z > 1e-3f * here.z)) return false;
  const float2 slope = (step.xy * here.z - here.xy * step.z) / (here.z * z); // the difference, without cancellation
  *moved = 0.5f * (float2)(slope.x / camera->tan_x * (float)camera->width, -slope.y / camera->tan_y * (float)camera->height);
  return true;
}

// The integral of clamp(x, 0, 1) from 0 to x.
static inline float ramp_sum(float x) {
  const float inside = clamp(x, 0.0f, 1.0f);
  return 0.5f * inside * inside + fmax(x - 1.0f, 0.0f);
}

// The area of the pixel at `pixel` (its corner relative to the middle) that lies in the footprint, 0..1, signed by its
// orientation: the sum over the edges of what lies beside them.
static inline float covered(const FilmFootprint* f, float2 pixel) {
  float sum = 0.0f;
  for (int i = 0; i < 4; ++i) {
    const float2 a = f->corner[i] - pixel, b = f->corner[(i + 1) & 3] - pixel;
    const float y0 = clamp(a.y, 0.0f, 1.0f), y1 = clamp(b.y, 0.0f, 1.0f);
    if (y0 == y1) continue;
    const float slope = (b.x - a.x) / (b.y - a.y);
    const float x0 = a.x + (y0 - a.y) * slope, x1 = a.x + (y1 - a.y) * slope;
    const float beside = fabs(x1 - x0) < 1e-2f ? clamp(0.5f * (x0 + x1), 0.0f, 1.0f)
                                               : (ramp_sum(x1) - ramp_sum(x0)) / (x1 - x0);
    sum += (y1 - y0) * beside;
  }
  return sum;
}

// What stands between the camera and a receiver.
typedef struct {
  __global const uint2* corners; // pixel_corners.cl
  int object;
  float3 position, normal; // the receiver's plane
  float side;              // 1: light falls on its outer side
  float offset;
  uint triangle;
} SeenReceiver;

// Whether the camera sees the receiver at a place of a pixel, in pixels. Asks a ray only where the pixel's corners see
// different things.
static inline bool is_seen(const World* world, const DeviceCamera* camera, const SeenReceiver* receiver, int column,
                           int row, float2 place) {
#if NEPHROID_OCCLUSION
  if (camera->receiver >= 0) return true;
  const float2 slope = (float2)((2.0f * place.x / (float)camera->width - 1.0f) * camera->tan_x,
                                (1.0f - 2.0f * place.y / (float)camera->height) * camera->tan_y);
  const float3 way = camera->forward.xyz + slope.x * camera->right.xyz + slope.y * camera->up.xyz;
  const float depth = dot(receiver->position - camera->position.xyz, receiver->normal) / dot(way, receiver->normal);
  __global const uint2* corner = receiver->corners + (size_t)row * (camera->width + 1) + column;
  const uint2 seen[4] = {corner[0], corner[1], corner[camera->width + 1], corner[camera->width + 2]};
  bool alike = true;
  float nearest = INFINITY, farthest = 0.0f;
  for (int i = 0; i < 4; ++i) {
    alike = alike && seen[i].x == seen[0].x;
    nearest = fmin(nearest, as_float(seen[i].y));
    farthest = fmax(farthest, as_float(seen[i].y));
  }
  // A pixel of one slanted surface has a small range of depths.
  if (alike && farthest - nearest < 0.1f * nearest)
    return (int)seen[0].x == receiver->object && depth > nearest - (farthest - nearest) - 1e-3f * nearest &&
           depth < farthest + (farthest - nearest) + 1e-3f * nearest;
  const float3 at = camera->position.xyz + depth * way;
  const float3 from = at + receiver->side * receiver->offset * receiver->normal;
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
  return convert_float2((uint2)(start + photon * 0xc13fa9a9u, (start ^ 0x5bd1e995u) + photon * 0x91e10da5u) >> 8) * 0x1p-24f;
}

// Whether a footprint reaches the picture.
static inline bool touches_film(const DeviceCamera* camera, const FilmFootprint* f) {
  float2 low = f->corner[0], high = f->corner[0];
  for (int i = 1; i < 4; ++i) {
    low = fmin(low, f->corner[i]);
    high = fmax(high, f->corner[i]);
  }
  return all(f->middle + high >= 0.0f) && all(f->middle + low < (float2)((float)camera->width, (float)camera->height));
}

// Adds a photon's light to the pixels. xyz: as of one pixel that gets all of it. False: too large for the film.
static inline bool add_footprint(const World* world, volatile __global long* film, const DeviceCamera* camera,
                                 const SeenReceiver* receiver, const FilmFootprint* f, uint photon,
                                 float3 xyz, float scale) {
  float2 low = f->corner[0], high = f->corner[0];
  for (int i = 1; i < 4; ++i) {
    low = fmin(low, f->corner[i]);
    high = fmax(high, f->corner[i]);
  }
  const int2 first = convert_int2_rtn(f->middle + low), last = convert_int2_rtn(f->middle + high);
  if (any(last < 0) || first.x >= camera->width || first.y >= camera->height) return true;
  const float3 quanta = xyz * scale;
  if (!(fabs(quanta.x) <= FILM_LIMIT && fabs(quanta.y) <= FILM_LIMIT && fabs(quanta.z) <= FILM_LIMIT)) return false;
  const bool one = all(first == last);
  float part = 0.0f;
  long added[3] = {0, 0, 0};
  for (int row = max(first.y, 0); row <= min(last.y, camera->height - 1); ++row) {
    // what the footprint has of this row
    float left = INFINITY, right = -INFINITY, inner_left = -INFINITY, inner_right = INFINITY;
    const float top = (float)row - f->middle.y;
    for (int i = 0; i < 4; ++i) {
      const float2 a = f->corner[i], b = f->corner[(i + 1) & 3];
      if (fmax(a.y, b.y) < top || fmin(a.y, b.y) > top + 1.0f) continue;
      const float slope = a.y == b.y ? 0.0f : (b.x - a.x) / (b.y - a.y);
      const float xa = a.x + (clamp(a.y, top, top + 1.0f) - a.y) * slope, xb = b.x + (clamp(b.y, top, top + 1.0f) - b.y) * slope;
      left = fmin(left, fmin(xa, xb));
      right = fmax(right, fmax(xa, xb));
      const float turn = (b.y - a.y) * f->area; // on which side of the footprint the edge lies
      if (turn < 0.0f) inner_left = fmax(inner_left, fmax(xa, xb));
      if (turn > 0.0f) inner_right = fmin(inner_right, fmin(xa, xb));
    }
    const bool whole_row = low.y <= top && high.y >= top + 1.0f;
    const int from = max((int)floor(f->middle.x + left), 0), to = min((int)floor(f->middle.x + right), camera->width - 1);
    for (int column = from; column <= to; ++column) {
      float share = 1.0f;
      const float start = (float)column - f->middle.x;
      if (whole_row && start >= inner_left && start + 1.0f <= inner_right)
        share = 1.0f / fabs(f->area);
      else if (!one)
        share = covered(f, (float2)(start, top)) / f->area;
      if (!(share > 0.0f)) continue;
      // rounded sums, so that all pixels together get all of it
      part += share;
      const float2 from_corner = fmax((float2)((float)column, (float)row), f->middle + low),
                   to_corner = fmin((float2)((float)column + 1.0f, (float)row + 1.0f), f->middle + high);
      const bool seen = is_seen(world, camera, receiver, column, row,
                                from_corner + (to_corner - from_corner) * place_within(photon, (uint)(row * camera->width + column)));
      volatile __global long* sum = film + 3 * (size_t)(row * camera->width + column);
      const long whole[3] = {convert_long_rte(quanta.x * part), convert_long_rte(quanta.y * part), convert_long_rte(quanta.z * part)};
      for (int c = 0; c < 3; ++c) {
        if (seen && whole[c] != added[c]) add_exactly(sum + c, whole[c] - added[c]);
        added[c] = whole[c];
      }
    }
  }
  return true;
}

// The footprint that reaches from -a/2 - b/2 to a/2 + b/2 about a place, shrunk to `widest` pixels. False where there is
// none: it has no area, is not finite, or reaches behind the camera. *shrunk: by which factor.
static inline bool footprint_on_film(const DeviceCamera* camera, float3 position, float3 a, float3 b, float widest,
                                     FilmFootprint* f, float* shrunk) {
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
  for (int i = 0; i < 4; ++i) {
    const float3 way = (i == 1 || i == 2 ? half_a : -half_a) + (i >= 2 ? half_b : -half_b);
    if (!moved_on_film(camera, position, way, &f->corner[i])) return false;
  }
  for (int i = 0; i < 4; ++i) {
    const float2 p = f->corner[i], q = f->corner[(i + 1) & 3];
    f->area += 0.5f * (p.x * q.y - p.y * q.x);
  }
  return fabs(f->area) > 1e-6f;
}
