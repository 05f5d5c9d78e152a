// SPDX-License-Identifier: Apache-2.0
// A matt surface: the same radiance to all sides, its albedo over pi of the irradiance (Lambert's law).
#include "kernels/scatter/interaction.h"

static inline bool diffuse_scatter(const World* world, Path* path, const Interaction* at, const Band* band, float u,
                                   ScatterSample* sample) {
  return false; // it has no other lobe
}

static inline float diffuse_coat_reflectance(const World* world, const DeviceMaterial* material, float cos_i) {
  return 0.0f;
}

static inline float diffuse_part_to_base(const World* world, const DeviceMaterial* material, float cosine) {
  return 1.0f;
}
