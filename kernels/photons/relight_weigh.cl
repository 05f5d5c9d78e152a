// SPDX-License-Identifier: Apache-2.0
// Two weighted sums of a film of layers (layers.h): the picture under a light and the draw of its error. The film is
// read once: first each cell by itself, then each pixel's cells together.
#include "kernels/photons/layer_types.h"
#include "kernels/tracing/work_item.h"

// Each work item weighs eight cells of one reflector. rows: halves times layers.
__kernel void weigh(__global const long* sums, int block_count, int rows, __global const int* reflector_of_block,
                    __global const float* weights,     // [reflector][row][6]: RGB of the one, RGB of the other
                    __global float* weighed) { // [eight cells][6][cell of the eight]
  const int item = (int)work_item(), block = item / (LAYER_BLOCK / 8), eighth = item % (LAYER_BLOCK / 8);
  if (block >= block_count) return;
  __global const long* from = sums + (size_t)block * (size_t)rows * LAYER_BLOCK;
  __global const float* weight = weights + (size_t)reflector_of_block[block] * (size_t)rows * 6;
  float8 a = (float8)(0.0f), b = a, c = a, d = a, e = a, f = a;
  for (int row = 0; row < rows; ++row) {
    const size_t four = 2 * ((size_t)row * (LAYER_BLOCK / 8) + (size_t)eighth); // a long8 may fit no register
    const float8 value = (float8)(convert_float4(vload4(four, from)), convert_float4(vload4(four + 1, from)));
    a += weight[0] * value;
    b += weight[1] * value;
    c += weight[2] * value;
    d += weight[3] * value;
    e += weight[4] * value;
    f += weight[5] * value;
    weight += 6;
  }
  const float8 sums_of[6] = {a, b, c, d, e, f};
  for (int k = 0; k < 6; ++k) vstore8(sums_of[k], 6 * (size_t)item + (size_t)k, weighed);
}

// Each work item adds up one pixel.
__kernel void gather_cells(__global const int* first, __global const LayerCell* cells, __global const float* weighed,
                           int pixel_count,
                           __global float* pictures) { // [2][pixel][3]
  const int pixel = (int)work_item();
  if (pixel >= pixel_count) return;
  float sums[6] = {0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f};
  for (int i = first[pixel]; i < first[pixel + 1]; ++i) {
    const int cell = cells[i].cell;
    for (int c = 0; c < 6; ++c) sums[c] += weighed[(size_t)(cell / 8) * 48 + (size_t)(8 * c + cell % 8)];
  }
  for (int c = 0; c < 6; ++c)
    pictures[((size_t)(c / 3) * (size_t)pixel_count + (size_t)pixel) * 3 + (size_t)(c % 3)] = sums[c];
}
