// SPDX-License-Identifier: Apache-2.0
// What the camera sees in a pixel (pixel_views.cl).
#ifndef NEPHROID_PIXEL_VIEW_TYPES_H
#define NEPHROID_PIXEL_VIEW_TYPES_H

#ifndef __OPENCL_C_VERSION__
namespace nephroid::shared {
#endif

#define VIEW_OF_SEVERAL (-2)

typedef struct {
  int object;              // that fills the pixel; -1: none; VIEW_OF_SEVERAL: different things
  float farthest, nearest; // range of 1 / depth along the view, with some slack
} PixelView;

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(PixelView) == 12);
} // namespace nephroid::shared
#endif

#endif
