// SPDX-License-Identifier: Apache-2.0
// A slope's light among that of all facets.
#ifndef NEPHROID_LIGHT_OF_FACETS_H
#define NEPHROID_LIGHT_OF_FACETS_H

#include "kernels/inverse/footprint.h"

// The index in arrays [receiver][cell].
static inline size_t cell_at(global const DeviceLayout* layout, int receiver, int x, int y) {
  return ((size_t)receiver * (size_t)layout->cells_y + (size_t)y) * (size_t)layout->cells_x + (size_t)x;
}

static inline long quanta_of(float light) { return convert_long_rte(light * FACET_QUANTA); }

// What lacks in a cell: the change of the weighted squares with its light, 2 weight (Z - T).
static inline float lack_of(long light, float wanted, float weight) {
  return 2.0f * weight * ((float)light * (1.0f / FACET_QUANTA) - wanted);
}

#endif
