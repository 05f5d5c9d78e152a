// SPDX-License-Identifier: Apache-2.0
// A mirror: it reflects a part of each wavelength that does not depend on the angle.
#include "kernels/scatter/interaction.h"

static inline bool mirror_scatter(const World* world, Path* path, const Interaction* at, const Band* band, float u,
                                  ScatterSample* sample) {
  *sample = reflect_at(path->direction, &at->surface, 1.0f, 1.0f);
  sample->reflectance = 1.0f;
  attenuate(&world->tables, &path->throughput, band, at->material.attenuator, 1.0f);
  return true;
}

MATERIAL_WITHOUT_BASE(mirror)
