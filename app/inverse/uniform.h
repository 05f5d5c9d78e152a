// SPDX-License-Identifier: Apache-2.0
// Numbers that are the same with every standard library, whose own distributions differ.
#pragma once
#include <cstdint>
#include <random>

namespace nephroid::inverse {

/// A random number in 0..1, without 1.
inline double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

/// The random numbers of one facet, or of one step, of a run.
inline std::mt19937_64 numbers_of(std::uint64_t seed, std::uint64_t item) {
  return std::mt19937_64(seed * 0x9e3779b97f4a7c15u + item + 1);
}

} // namespace nephroid::inverse
