// SPDX-License-Identifier: Apache-2.0
// The environment as a latitude-longitude picture at infinity: its colour in a direction, and that colour's XYZ in
// some wavelengths. The picture has colours, but glass bends and absorbs wavelengths. So a colour stands for a
// spectrum, the sum of the fixed spectra of the three sRGB primaries (app/optics/colour.h).
#include "kernels/lights/light.h"
#include "kernels/tracing/shared_types.h"

typedef struct {
  __global const float* texels;       // [row][column][3]: linear sRGB
  __global const float4* primary_before; // [402][primary]: XYZ of the primary's spectrum in the wavelengths before
  DeviceBackground size;
} Background;

static inline float3 texel_at(const Background* b, int row, int column) {
  return vload3((size_t)row * (size_t)b->size.width + (size_t)column, b->texels);
}

// The four texels about a direction. Columns go on around; the first and the last row are repeated.
typedef struct {
  int row, next_row, column, next_column;
  float right_part, lower_part; // weights of the next ones
} TexelPlace;

static inline TexelPlace texel_place(const DeviceBackground* size, float3 direction) {
  // The azimuth goes from the picture's middle, -z, to its right, +x. A map turned to the left is read to the right.
  const float azimuth = atan2(direction.x, -direction.z) / (2.0f * PI_F) + 0.5f + size->turns;
  const float zenith = atan2(sqrt(direction.x * direction.x + direction.z * direction.z), direction.y) / PI_F;
  const float x = (azimuth - floor(azimuth)) * (float)size->width - 0.5f;
  const float y = clamp(zenith * (float)size->height - 0.5f, 0.0f, (float)(size->height - 1));
  const float left = floor(x), top = floor(y);
  const int column = left < 0.0f ? size->width - 1 : min((int)left, size->width - 1), row = (int)top;
  const TexelPlace place = {
      row, min(row + 1, size->height - 1), column, column + 1 < size->width ? column + 1 : 0, x - left, y - top};
  return place;
}

// Linear sRGB in a direction, bilinear between texels.
static inline float3 background_rgb(const Background* b, float3 direction) {
  const TexelPlace at = texel_place(&b->size, direction);
  // a + t (b - a) is exact where a and b are equal.
  const float3 a = texel_at(b, at.row, at.column), c = texel_at(b, at.next_row, at.column);
  const float3 upper = a + at.right_part * (texel_at(b, at.row, at.next_column) - a),
               lower = c + at.right_part * (texel_at(b, at.next_row, at.next_column) - c);
  return upper + at.lower_part * (lower - upper);
}

// The XYZ of a colour's spectrum in the wavelengths first, ..., end - 1.
static inline float3 background_xyz(const Background* b, float3 rgb, int first, int end) {
  __global const float4 *before = b->primary_before + 3 * first, *after = b->primary_before + 3 * end;
  return rgb.x * (after[0].xyz - before[0].xyz) + rgb.y * (after[1].xyz - before[1].xyz) +
         rgb.z * (after[2].xyz - before[2].xyz);
}
