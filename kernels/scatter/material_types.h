// SPDX-License-Identifier: Apache-2.0
// The materials, each on one line: MATERIAL(its word in presets, its name here, its lobes). This list makes the
// preset's words and the numbers MATERIAL_*, and sends a surface's verbs to the material's file on host and device.
#ifndef NEPHROID_MATERIAL_TYPES_H
#define NEPHROID_MATERIAL_TYPES_H

// The ways in which a surface may send light on.
#define LOBE_DIFFUSE 1u      // to all sides: what caustics fall on
#define LOBE_REFLECTION 2u   // in one direction, or about it where the surface is rough
#define LOBE_TRANSMISSION 4u // the same, through the surface
#define LOBES_ALL 7u
// Beside the lobes: a surface without thickness, which light passes straight on.
#define IS_PANE 8u

// clang-format off
#define MATERIALS(MATERIAL) \
  MATERIAL(diffuse, DIFFUSE, LOBE_DIFFUSE) \
  MATERIAL(dielectric, DIELECTRIC, LOBE_REFLECTION | LOBE_TRANSMISSION) \
  MATERIAL(mirror, MIRROR, LOBE_REFLECTION) \
  MATERIAL(conductor, CONDUCTOR, LOBE_REFLECTION) \
  MATERIAL(plastic, PLASTIC, LOBE_DIFFUSE | LOBE_REFLECTION) \
  MATERIAL(varnished_metal, VARNISHED_METAL, LOBE_REFLECTION) \
  MATERIAL(glazing, GLAZING, LOBE_REFLECTION | LOBE_TRANSMISSION | IS_PANE)
// clang-format on

#define MATERIAL_NUMBER(word, NAME, lobes) MATERIAL_##NAME,
enum { MATERIALS(MATERIAL_NUMBER) MATERIAL_TYPE_COUNT };

#endif
