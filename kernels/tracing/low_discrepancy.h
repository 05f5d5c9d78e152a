// SPDX-License-Identifier: Apache-2.0
// Low-discrepancy numbers: a Sobol sequence of four dimensions, scrambled as Owen (1995) has it by hashing (Burley
// 2020, "Practical hash-based Owen scrambling"). Sequences with different keys are independent.
#include "kernels/tracing/random.h"

#ifndef NEPHROID_LOW_DISCREPANCY
#define NEPHROID_LOW_DISCREPANCY 1
#endif

// Direction numbers of the dimensions 2, 3 and 4 for each bit of the index (Joe and Kuo 2008, new-joe-kuo-6:
// polynomials x + 1, x^2 + x + 1, x^3 + x + 1, initial numbers 1; 1, 3; 1, 3, 1). Dimension 1 is the reversed index.
// Plain numbers: on an H200 (driver 580.159) a constant array of uint3 gave points that were not stratified.
__constant uint sobol_directions[32 * 3] = {
    0x80000000u, 0x80000000u, 0x80000000u, 0xc0000000u, 0xc0000000u, 0xc0000000u, 0xa0000000u, 0x60000000u, 0x20000000u,
    0xf0000000u, 0x90000000u, 0x50000000u, 0x88000000u, 0xe8000000u, 0xf8000000u, 0xcc000000u, 0x5c000000u, 0x74000000u,
    0xaa000000u, 0x8e000000u, 0xa2000000u, 0xff000000u, 0xc5000000u, 0x93000000u, 0x80800000u, 0x68800000u, 0xd8800000u,
    0xc0c00000u, 0x9cc00000u, 0x25400000u, 0xa0a00000u, 0xee600000u, 0x59e00000u, 0xf0f00000u, 0x55900000u, 0xe6d00000u,
    0x88880000u, 0x80680000u, 0x78080000u, 0xcccc0000u, 0xc09c0000u, 0xb40c0000u, 0xaaaa0000u, 0x60ee0000u, 0x82020000u,
    0xffff0000u, 0x90550000u, 0xc3050000u, 0x80008000u, 0xe8808000u, 0x208f8000u, 0xc000c000u, 0x5cc0c000u, 0x51474000u,
    0xa000a000u, 0x8e606000u, 0xfbea2000u, 0xf000f000u, 0xc5909000u, 0x75d93000u, 0x88008800u, 0x6868e800u, 0xa0858800u,
    0xcc00cc00u, 0x9c9c5c00u, 0x914e5400u, 0xaa00aa00u, 0xeeee8e00u, 0xdbe79e00u, 0xff00ff00u, 0x5555c500u, 0x25db6d00u,
    0x80808080u, 0x8000e880u, 0x58800080u, 0xc0c0c0c0u, 0xc0005cc0u, 0xe54000c0u, 0xa0a0a0a0u, 0x60008e60u, 0x79e00020u,
    0xf0f0f0f0u, 0x9000c590u, 0xb6d00050u, 0x88888888u, 0xe8006868u, 0x800800f8u, 0xccccccccu, 0x5c009c9cu, 0xc00c0074u,
    0xaaaaaaaau, 0x8e00eeeeu, 0x200200a2u, 0xffffffffu, 0xc5005555u, 0x50050093u,
};

static inline uint reverse_bits(uint x) {
  x = (x >> 16) | (x << 16);
  x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
  return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

// A random permutation in which every bit depends on the lower bits only (Laine and Karras 2011; constants of Vegdahl
// 2021). Applied to a number with its bits in reverse it is Owen's scrambling, by the higher bits.
static inline uint4 permute_by_lower_bits(uint4 x, uint4 key) {
  x ^= x * 0x3d20adeau;
  x += key;
  x *= (key >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

static inline uint4 reverse_bits4(uint4 x) {
  return (uint4)(reverse_bits(x.x), reverse_bits(x.y), reverse_bits(x.z), reverse_bits(x.w));
}

// Point `index` of four dimensions, in units of 2^-32. sequence: its purpose. Sets of one sequence are independent.
COMPILED_ONCE uint4 sobol4_bits(uint2 seed, uint3 sequence, uint set, uint index) {
  const uint4 key = philox4x32((uint4)(sequence, set << 16 | STREAM_SOBOL), seed);
  // Every set but the first shuffles the order of its points by a key of its own, so that sets are not paired alike.
  uint shuffled = index;
  if (set != 0u)
    shuffled =
        reverse_bits(permute_by_lower_bits((uint4)(reverse_bits(index)), (uint4)(key.x ^ key.w * 0x9e3779b9u)).x);
  uint3 bits = (uint3)(0u);
  ROLLED
  for (int i = 0; i < 32; ++i) bits ^= vload3(i, sobol_directions) & (uint3)(0u - (shuffled >> i & 1u));
  // Dimension 1 is the reversed index, so its own reversal, where scrambling happens, is the index.
  const uint4 reversed = (uint4)(shuffled, reverse_bits(bits.x), reverse_bits(bits.y), reverse_bits(bits.z));
  return reverse_bits4(permute_by_lower_bits(reversed, key));
}

static inline float4 sobol4(uint2 seed, uint3 sequence, uint set, uint index) {
  return convert_float4(sobol4_bits(seed, sequence, set, index) >> 8) * 0x1p-24f;
}
