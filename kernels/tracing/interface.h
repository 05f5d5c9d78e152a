// SPDX-License-Identifier: Apache-2.0
// A path at a dielectric's surface: which media meet there, and whether it is reflected or goes through.
#include "kernels/materials/pane.h"
#include "kernels/tracing/media.h"

// 0: every dielectric has n = 1, so nothing is bent or reflected.
#ifndef NEPHROID_BENDING
#define NEPHROID_BENDING 1
#endif

// What meets at a surface. The objects whose media they are, -1: air; the indices of refraction there.
typedef struct {
  int near_object, far_object;
  float n_near, n_far;
  Media beyond;
} Sides;

static inline float index_of_object(int object, __global const DeviceObject* objects, __global const float* n_of) {
  return object < 0 ? 1.0f : n_of[objects[object].material];
}

// media: those that enclose a path along `direction`. n_of: index of refraction by material, for the path's cluster.
// False: more than MEDIA_DEPTH media.
static inline bool find_sides(const Media* media, const Surface* surface, __global const DeviceObject* objects,
                              __global const float* n_of, float3 direction, Sides* sides) {
  sides->beyond = *media;
  sides->near_object = medium_object(media, objects);
  if (dot(direction, surface->geometric) < 0.0f) {
    if (!enter_medium(&sides->beyond, surface->object)) return false;
  } else if (is_inside(media, surface->object))
    leave_medium(&sides->beyond, surface->object);
  else
    sides->near_object = surface->object; // an open mesh: the path got in without meeting its surface
  sides->far_object = medium_object(&sides->beyond, objects);
  sides->n_near = index_of_object(sides->near_object, objects, n_of);
  sides->n_far = index_of_object(sides->far_object, objects, n_of);
  return true;
}

// media: updated where the path goes through. layer: the surface's coating. choice: uniform in [0, 1), picks reflection
// with the reflectance as its probability. *n_ratio: n on the near side over n on the far side, 1 for a reflected path.
// False: as find_sides.
static inline bool cross_interface(Media* media, const Surface* surface, __global const DeviceObject* objects,
                                   __global const float* n_of, const DeviceMaterial* material, Layer layer,
                                   float3 direction, float choice, Bend* bend, float* n_ratio) {
  *n_ratio = 1.0f;
#if NEPHROID_PANES
  if (material->is_thin) {
    const int around = medium_object(media, objects);
    *bend = bend_at_pane(direction, surface, index_of_object(around, objects, n_of),
                         n_of[objects[surface->object].material], choice);
    bend->near_material = bend->far_material = around < 0 ? -1 : objects[around].material;
    return true;
  }
#endif
  Sides sides;
  if (!find_sides(media, surface, objects, n_of, direction, &sides)) return false;
#if NEPHROID_BENDING
  const bool coated = NEPHROID_COATINGS && layer.thickness > 0.0f && sides.near_object != sides.far_object;
  const bool bends = sides.n_near != sides.n_far || coated;
#else
  const bool bends = false;
#endif
  if (!bends) { // nothing changes: one medium hides the other, or both are the same
    bend->direction = direction;
    bend->transmitted = bend->straight = true;
    bend->reflectance = 0.0f;
  } else
    *bend = bend_at_surface(direction, surface, sides.n_near, sides.n_far, layer, choice);
  bend->near_material = sides.near_object < 0 ? -1 : objects[sides.near_object].material;
  bend->far_material = sides.far_object < 0 ? -1 : objects[sides.far_object].material;
  if (bend->transmitted) {
    *media = sides.beyond;
    *n_ratio = sides.n_near / sides.n_far;
  }
  return true;
}
