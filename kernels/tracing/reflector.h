// SPDX-License-Identifier: Apache-2.0
// What a diffuse surface reflects at one of its points: a row of the reflectance tables, or with a texture a mixture of
// the three after it, red, green and blue (app/optics/primary_reflectances.h).
#include "kernels/tracing/shared_types.h"

#ifndef NEPHROID_TEXTURES
#define NEPHROID_TEXTURES 1
#endif

typedef struct {
  WAVELENGTH_TABLES(TABLE_MEMBER)
} SpectralTables;

typedef struct {
  int row; // -1: white
#if NEPHROID_TEXTURES
  bool is_textured;
  float3 rgb; // linear sRGB there, 0..1
#endif
} Reflector;

static inline Reflector reflector_of_row(int row) {
  Reflector reflector;
  reflector.row = row;
#if NEPHROID_TEXTURES
  reflector.is_textured = false;
  reflector.rgb = (float3)(0.0f);
#endif
  return reflector;
}

// Of a surface that reflects all light.
static inline Reflector white_reflector(void) { return reflector_of_row(-1); }
static inline bool is_white(Reflector reflector) { return reflector.row < 0; }

static inline float reflectance_of(const SpectralTables* tables, Reflector reflector, int wavelength) {
  if (is_white(reflector)) return 1.0f;
  const int place = reflector.row * WAVELENGTH_COUNT + wavelength;
#if NEPHROID_TEXTURES
  if (reflector.is_textured)
    return reflector.rgb.x * tables->reflectance[place + WAVELENGTH_COUNT] +
           reflector.rgb.y * tables->reflectance[place + 2 * WAVELENGTH_COUNT] +
           reflector.rgb.z * tables->reflectance[place + 3 * WAVELENGTH_COUNT];
#endif
  return tables->reflectance[place];
}

// The colour that a reflector makes of light. first: of the light's row in a table [row][reflector].
static inline float4 reflected_colour_of(__global const float4* table, int first, Reflector reflector) {
  const int place = first + reflector.row;
#if NEPHROID_TEXTURES
  if (reflector.is_textured) {
    const float3 xyz = reflector.rgb.x * table[place + 1].xyz + reflector.rgb.y * table[place + 2].xyz +
                       reflector.rgb.z * table[place + 3].xyz;
    return (float4)(xyz, table[place].w);
  }
#endif
  return table[place];
}
