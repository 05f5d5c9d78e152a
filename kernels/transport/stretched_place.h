// SPDX-License-Identifier: Apache-2.0
// Where light of another wavelength than a path's falls. The last way of the path of parameter s is the ray (O, D).
// That of another wavelength begins at O + x O' and goes along D + x D', where x is its s less the path's
// (differential.h). It is cut with the tangent plane of the receiver exactly: a place on a grazing receiver is anything
// but linear in x.
#include "kernels/scatter/interaction.h"
#include "kernels/tracing/path.h"

// The place of light whose s is larger by x, on the tangent plane at the path's place. False where there is none.
static inline bool stretched_place(const Path* path, const Surface* surface, float x, float3* place) {
  const float3 origin = path->origin + x * path->differential.position;
  const float3 direction = path->direction + x * path->differential.direction;
  // Everything is relative to the path's place, which is exact: its neighbours are then as exact as their distance.
  const float before = dot(path->direction, surface->geometric), along = dot(direction, surface->geometric);
  const float3 to_surface = surface->position - origin;
  const float distance = dot(to_surface, surface->geometric) / along;
  *place = surface->position + (distance * direction - to_surface);
  return along * before > 0.0f && distance > 0.0f && all(isfinite(*place));
}

// Whether a point of a triangle's plane lies in the triangle; false for an ellipsoid's tangent plane.
static inline bool is_in_triangle(const Geometry* geometry, uint triangle, float3 position) {
  const DevicePrimitive met = geometry->primitives[triangle];
  if (is_ellipsoid(&met)) return false;
  const float3 e1 = met.edge_u.xyz, e2 = met.edge_v.xyz, from_a = position - met.corner.xyz;
  const float3 across = cross(e1, e2);
  const float u = dot(cross(from_a, e2), across), v = dot(cross(e1, from_a), across);
  return u >= 0.0f && v >= 0.0f && u + v <= dot(across, across);
}

// Finds the receiver beside a triangle by a short ray back along the normal. from: the surface at the path's place;
// side: where the path arrives. False where that ray does not meet the same object, facing the same way: the receiver
// ends, or something stands on it.
static inline bool surface_beside(const World* world, const Surface* from, float side, float3 place, Surface* surface,
                                  uint* triangle) {
  const float reach = 0.1f * distance(place, from->position) + 8.0f * from->offset;
  const float3 down = -side * from->geometric;
  const Hit hit = closest_hit(world->geometry.nodes, world->geometry.blocks, world->geometry.root, place - reach * down,
                              down, 0.0f, 2.0f * reach, NEPHROID_NO_PRIMITIVE);
  if (hit.primitive == NEPHROID_NO_PRIMITIVE) return false;
  *surface = surface_of(world, hit);
  *triangle = hit.primitive;
  return surface->object == from->object && dot(surface->geometric, from->geometric) > 0.7f;
}

// Whether a place on the tangent plane of a surface is on the receiver. *beside: in another triangle.
static inline bool is_on_receiver(const World* world, const Surface* from, uint triangle, float side, float3 place,
                                  bool* beside) {
  if (is_in_triangle(&world->geometry, triangle, place)) return true;
  *beside = true;
  Surface surface;
  uint other;
  return surface_beside(world, from, side, place, &surface, &other);
}

// Moves *surface to a place on its tangent plane, or to what is beside its triangle there. beside: it may be. False:
// the receiver has ended.
static inline bool move_on_receiver(const World* world, float side, float3 place, bool beside, Surface* surface,
                                    uint* triangle) {
  if (beside && !is_in_triangle(&world->geometry, *triangle, place)) {
    const Surface from = *surface;
    return surface_beside(world, &from, side, place, surface, triangle);
  }
#if NEPHROID_NORMAL_MAPS
  const float2 at = place_in_triangle(world, *triangle, place);
  const Hit there = {0.0f, at.x, at.y, *triangle};
  *surface = surface_of(world, there);
#endif
  surface->position = place;
  return true;
}
