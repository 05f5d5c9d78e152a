// SPDX-License-Identifier: Apache-2.0
// kernels/guide.h: numbers go to each cell as often as its table says, stay in it, spread evenly there, and come with the density that
// keeps every mean as it was.
#include "compute/compute.h"
#include "kernels/shared_types.h"
#include "spectral/emission_guide.h"
#include "tests/support/statistics.h"
#include "tests/support/test_kernels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace {

using namespace nephroid;
using shared::float4;

const char* const source = R"(
#include "random.h"
#include "guide.h"
__kernel void guided(__global const float* guide, uint2 seed, __global float4* out, uint count)
{
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  float4 numbers = random4(seed, 0u, i, 0u, STREAM_PHOTONS);
  const Guided guided = guide_numbers(guide, &numbers);
  out[2 * i] = numbers;
  out[2 * i + 1] = (float4)(guided.density, (float)guided.cell, 0.0f, 0.0f);
}
)";

struct Seed {
  std::uint32_t x, y;
};

constexpr std::uint32_t count = 1 << 20;

/// A guide that has learned from uneven light.
std::vector<float> uneven_guide()
{
  std::mt19937 random(5);
  std::vector<std::int64_t> moments(GUIDE_CELLS);
  for (std::int64_t& m : moments) m = 1000 + static_cast<std::int64_t>(random() % 100000);
  spectral::EmissionGuide guide(1);
  const double photons = 1 << 20;
  guide.learn(moments, std::vector<double>{photons}, 4);
  return guide.table();
}

/// The chance of bin i of a cdf.
double chance(const float* cdf, int i) { return double(cdf[i]) - (i > 0 ? double(cdf[i - 1]) : 0.0); }

TEST(Guide, DrawsEachCellWithItsChanceAndSaysIt)
{
  const std::vector<float> table = uneven_guide();
  std::vector<double> chances;
  for (int i = 0; i < GUIDE_BINS_X; ++i)
    for (int j = 0; j < GUIDE_BINS_Y; ++j)
      for (int k = 0; k < GUIDE_BINS_Z; ++k) {
        const float* second = table.data() + GUIDE_BINS_X + i * GUIDE_BINS_Y;
        const float* third = table.data() + GUIDE_BINS_X + GUIDE_BINS_X * GUIDE_BINS_Y + (i * GUIDE_BINS_Y + j) * GUIDE_BINS_Z;
        chances.push_back(chance(table.data(), i) * chance(second, j) * chance(third, k));
      }

  const test::TestKernels kernels(source);
  const compute::Buffer<float> guide(kernels.context(), "guide", std::span<const float>(table));
  const compute::Buffer<float4> out(kernels.context(), "out", 2 * std::size_t(count));
  kernels.kernel("guided").run(count, 64, guide, Seed{20, 26}, out, count);
  const std::vector<float4> drawn = out.read();

  std::vector<double> counts(GUIDE_CELLS), halves(2); // halves: of the cell, along the third number
  for (std::size_t n = 0; n < drawn.size(); n += 2) {
    const float4 at = drawn[n];
    const auto cell = static_cast<std::size_t>(drawn[n + 1].y);
    ASSERT_LT(cell, counts.size());
    ++counts[cell];
    const int i = int(at.x * GUIDE_BINS_X), j = int(at.y * GUIDE_BINS_Y), k = int(at.z * GUIDE_BINS_Z);
    ASSERT_TRUE(at.x >= 0 && at.x < 1 && at.y >= 0 && at.y < 1 && at.z >= 0 && at.z < 1);
    // A place on a cell's very edge may come out beyond it by rounding, one in some million.
    const std::size_t there = std::size_t((i * GUIDE_BINS_Y + j) * GUIDE_BINS_Z + k);
    if (there != cell) {
      const auto to_edge = [](float u, int bins) { return std::abs(u * bins - std::round(u * bins)); };
      ASSERT_LT(std::min({to_edge(at.x, GUIDE_BINS_X), to_edge(at.y, GUIDE_BINS_Y), to_edge(at.z, GUIDE_BINS_Z)}), 1e-5f);
    }
    ASSERT_NEAR(drawn[n + 1].x, chances[cell] * GUIDE_CELLS, 1e-4 * chances[cell] * GUIDE_CELLS);
    ++halves[at.z * GUIDE_BINS_Z - std::floor(at.z * GUIDE_BINS_Z) < 0.5f ? 0 : 1];
  }
  EXPECT_GT(test::chi_square_test(counts, chances).p, test::false_alarm);
  EXPECT_LT(test::chi_square_test(counts, std::vector<double>(GUIDE_CELLS, 1)).p, test::false_alarm) << "the guide is even";
  EXPECT_GT(test::chi_square_test(halves, std::vector<double>{1, 1}).p, test::false_alarm);
}

} // namespace
