// SPDX-License-Identifier: Apache-2.0
// Structs of tiles that the host and kernels share.
#ifndef NEPHROID_TILE_TYPES_H
#define NEPHROID_TILE_TYPES_H

#include "kernels/tracing/shared_types.h"

#ifndef __OPENCL_C_VERSION__
namespace nephroid::shared {
#endif

// A square lattice of photons from one place of a light, in a part of one cluster, towards one target.
typedef struct {
  uint first_photon; // of the round; its points follow row after row
  uint side;         // points in a row and in a column
  int light, cluster;
  int target;             // among those of the light; -1: the cone of a spot
  uint film_half;         // the half of the film that it adds to
  float step;             // distance of two points in the square [-1, 1] x [-1, 1]
  float shift_x, shift_y; // of the first point, in steps, 0..1
  float place_x, place_y; // DeviceLight with places: where its light begins, 0..1
  float wavelength;       // 0..1: chooses a wavelength of its cluster
  float low, high;        // the part of the cluster's wavelengths that it stands for
  int is_drawn;           // whether its wavelength was drawn from that part; 0: it is the middle one
  float photons;          // photons of its emitter in this half, at all places, over the number of parts
  float share;            // DeviceEmitter::share
  float widest;           // pixels that a footprint may reach
  uint phase;             // random bits: which points stand for others where little light is left
} DeviceLattice;

#define VIEW_OF_SEVERAL (-2)

// What the camera sees in a pixel (pixel_views.cl).
typedef struct {
  int object;              // that fills the pixel; -1: none; VIEW_OF_SEVERAL: different things
  float farthest, nearest; // range of 1 / depth along the view, with some slack
} PixelView;

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(DeviceLattice) == 76 && sizeof(PixelView) == 12);
} // namespace nephroid::shared
#endif

#endif
