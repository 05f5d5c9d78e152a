// SPDX-License-Identifier: Apache-2.0
// The films that relighting keeps, as the host and kernels share them: see layers.h.
#ifndef NEPHROID_LAYER_TYPES_H
#define NEPHROID_LAYER_TYPES_H

#ifndef __OPENCL_C_VERSION__
namespace nephroid::shared {
#endif

// The number of cells in a block; all belong to one reflector.
#define LAYER_BLOCK 64

// The places that the survey (relight_direct.cl) samples in each pixel, and the paths of each through glass.
#define SURVEY_PLACES 4
#define SURVEY_PATHS 2

// One reflector that a pixel sees.
typedef struct {
  int reflector;
  int cell;
} LayerCell;

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(LayerCell) == 8);
} // namespace nephroid::shared
#endif

#endif
