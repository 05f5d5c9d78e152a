// SPDX-License-Identifier: Apache-2.0
// Where a path meets a surface, and which materials there are.
#include "kernels/scatter/interface.h"
#include "kernels/tracing/path.h"

// Bit 1 << MATERIAL_* for each type that the scene has. The code of other types compiles to nothing.
#ifndef NEPHROID_MATERIALS
#define NEPHROID_MATERIALS ((1 << MATERIAL_TYPE_COUNT) - 1)
#endif

typedef struct {
  Surface surface;
  DeviceMaterial material; // with the roughness that it has there
  uint triangle;
} Interaction;

static inline bool is_material(const DeviceMaterial* material, int type) {
  return (NEPHROID_MATERIALS >> type & 1) != 0 && (NEPHROID_MATERIALS == 1 << type || material->type == type);
}

// LOBE_* of a material.
static inline uint lobes_of(const DeviceMaterial* material) {
  uint of_material = 0u;
#define ADD_LOBES(word, NAME, lobes) of_material |= is_material(material, MATERIAL_##NAME) ? (lobes) & LOBES_ALL : 0u;
  MATERIALS(ADD_LOBES)
#undef ADD_LOBES
  return of_material;
}

// A surface with a diffuse lobe is matt. Where it reflects too, that is its coat, and the diffuse lobe is its base.
static inline bool is_matt(const DeviceMaterial* material) { return (lobes_of(material) & LOBE_DIFFUSE) != 0u; }
static inline bool is_only_matt(const DeviceMaterial* material) { return lobes_of(material) == LOBE_DIFFUSE; }
static inline bool has_coat(const DeviceMaterial* material) {
  return lobes_of(material) == (LOBE_DIFFUSE | LOBE_REFLECTION);
}

// The verbs of a base, for a material without one.
#define MATERIAL_WITHOUT_BASE(word) \
  static inline float word##_coat_reflectance(const World* world, const DeviceMaterial* material, float cos_i) { \
    return 1.0f; \
  } \
  static inline float word##_part_to_base(const World* world, const DeviceMaterial* material, float cosine) { \
    return 0.0f; \
  }
