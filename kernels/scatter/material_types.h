// SPDX-License-Identifier: Apache-2.0
// The materials, each on one line: MATERIAL(its word in presets, its name here). This list makes the preset's words and
// the numbers MATERIAL_*, and sends a surface's verbs to the material's file on the host and on the device.
#ifndef NEPHROID_MATERIAL_TYPES_H
#define NEPHROID_MATERIAL_TYPES_H

// clang-format off
#define MATERIALS(MATERIAL) \
  MATERIAL(diffuse, DIFFUSE) \
  MATERIAL(dielectric, DIELECTRIC) \
  MATERIAL(mirror, MIRROR) \
  MATERIAL(conductor, CONDUCTOR) \
  MATERIAL(plastic, PLASTIC)
// clang-format on

#define MATERIAL_NUMBER(word, NAME) MATERIAL_##NAME,
enum { MATERIALS(MATERIAL_NUMBER) MATERIAL_TYPE_COUNT };

#endif
