// SPDX-License-Identifier: Apache-2.0
// A path at a dielectric's surface: which media meet there, and whether it is reflected or goes through.
#include "kernels/materials/pane.h"
#include "kernels/tracing/media.h"

// 0: every dielectric has n = 1, so nothing is bent or reflected.
#ifndef NEPHROID_BENDING
#define NEPHROID_BENDING 1
#endif

// media: those that enclose the path; updated where it goes through. n_of: index of refraction by material, for the
// path's cluster. layer: the surface's coating. choice: uniform in [0, 1), picks reflection with the reflectance as its
// probability. *n_ratio: n on the near side over n on the far side, 1 for a reflected path. False: more than
// MEDIA_DEPTH media.
static inline bool cross_interface(Media* media, const Surface* surface, __global const DeviceObject* objects,
                                   __global const float* n_of, const DeviceMaterial* material, Layer layer,
                                   float3 direction, float choice, Bend* bend, float* n_ratio) {
  const bool enters = dot(direction, surface->geometric) < 0.0f;
  Media beyond = *media;
  int near_object = medium_object(media, objects);
  *n_ratio = 1.0f;
#if NEPHROID_PANES
  if (material->is_thin) {
    const int around = near_object < 0 ? -1 : objects[near_object].material;
    const float n = around < 0 ? 1.0f : n_of[around];
    *bend = bend_at_pane(direction, surface, n, n_of[objects[surface->object].material], choice);
    bend->near_material = bend->far_material = around;
    return true;
  }
#endif
  if (enters) {
    if (!enter_medium(&beyond, surface->object)) return false;
  } else if (is_inside(media, surface->object))
    leave_medium(&beyond, surface->object);
  else
    near_object = surface->object; // an open mesh: the path got in without meeting its surface
  const int far_object = medium_object(&beyond, objects);
  const int near_material = near_object < 0 ? -1 : objects[near_object].material;
  const int far_material = far_object < 0 ? -1 : objects[far_object].material;
  const float n_i = near_material < 0 ? 1.0f : n_of[near_material];
  const float n_t = far_material < 0 ? 1.0f : n_of[far_material];
#if NEPHROID_BENDING
  const bool coated = NEPHROID_COATINGS && layer.thickness > 0.0f && near_object != far_object;
  const bool bends = n_i != n_t || coated;
#else
  const bool bends = false;
#endif
  if (!bends) { // nothing changes: one medium hides the other, or both are the same
    bend->direction = direction;
    bend->transmitted = bend->straight = true;
    bend->reflectance = 0.0f;
  } else
    *bend = bend_at_surface(direction, surface, n_i, n_t, layer, choice);
  bend->near_material = near_material;
  bend->far_material = far_material;
  if (bend->transmitted) {
    *media = beyond;
    *n_ratio = n_i / n_t;
  }
  return true;
}
