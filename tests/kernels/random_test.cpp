// SPDX-License-Identifier: Apache-2.0
// kernels/random.h against the published test vectors of its generator, and its uniforms against their distribution.
#include "base/error.h"
#include "compute/compute.h"
#include "tests/support/test_kernels.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

namespace {

using namespace nephroid;
using Block = std::array<std::uint32_t, 4>;

const char* source = R"(
#include "random.h"
kernel void philox(global const uint4* counters, global const uint2* keys, global uint4* results, uint count)
{
  const uint i = get_global_id(0);
  if (i < count) results[i] = philox4x32(counters[i], keys[i]);
}
kernel void uniforms(uint2 seed, uint pass, uint block, uint stream, global float4* results, uint count)
{
  const uint i = get_global_id(0);
  if (i < count) results[i] = random4(seed, pass, i, block, stream);
}
)";

TEST(Random, PhiloxGivesThePublishedVectors)
{
  // Random123's tests/kat_vectors, the lines "philox4x32 10": counter, key, result.
  const std::vector<Block> counters{
      {0, 0, 0, 0}, {0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}};
  const std::vector<std::array<std::uint32_t, 2>> keys{{0, 0}, {0xffffffff, 0xffffffff}, {0xa4093822, 0x299f31d0}};
  const std::vector<Block> published{{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8},
                                     {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd},
                                     {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}};
  const test::TestKernels kernels(source);
  const compute::Buffer<Block> in(kernels.context(), "counters", std::span(counters)), out(kernels.context(), "results", counters.size());
  const compute::Buffer<std::array<std::uint32_t, 2>> key(kernels.context(), "keys", std::span(keys));
  kernels.kernel("philox").run(counters.size(), 1, in, key, out, static_cast<std::uint32_t>(counters.size()));
  EXPECT_EQ(out.read(), published);
}

class Uniforms : public testing::Test {
protected:
  static constexpr std::uint32_t count = 1 << 16;

  std::vector<std::array<float, 4>> draw(std::array<std::uint32_t, 2> seed, std::uint32_t pass, std::uint32_t block, std::uint32_t stream)
  {
    const compute::Buffer<std::array<float, 4>> results(kernels_.context(), "results", count);
    kernels_.kernel("uniforms").run(count, 64, seed, pass, block, stream, results, count);
    return results.read();
  }

private:
  test::TestKernels kernels_{source};
};

TEST_F(Uniforms, FillTheUnitIntervalEvenly)
{
  // Pearson's chi-square over 256 bins a dimension has 255 degrees of freedom: mean 255, deviation sqrt(510); 5 deviations.
  const auto numbers = draw({1, 2}, 3, 4, 5);
  for (std::size_t dimension = 0; dimension < 4; ++dimension) {
    std::array<int, 256> bins{};
    for (const auto& number : numbers) {
      ASSERT_GE(number[dimension], 0.0f);
      ASSERT_LT(number[dimension], 1.0f);
      ++bins[static_cast<std::size_t>(number[dimension] * 256)];
    }
    double chi_square = 0;
    for (const int n : bins) chi_square += std::pow(n - count / 256.0, 2) / (count / 256.0);
    EXPECT_NEAR(chi_square, 255, 5 * std::sqrt(510.0)) << "dimension " << dimension;
  }
}

TEST_F(Uniforms, EveryKeyGivesOtherNumbers)
{
  const std::vector<std::vector<std::array<float, 4>>> draws{draw({1, 0}, 0, 0, 0), draw({0, 1}, 0, 0, 0), draw({0, 0}, 1, 0, 0),
                                                             draw({0, 0}, 0, 1, 0), draw({0, 0}, 0, 0, 1)};
  for (std::size_t a = 0; a < draws.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      // The mean product of independent uniforms is 1/4 with a deviation of sqrt(7 / 144 / count).
      double product = 0;
      for (std::size_t i = 0; i < count; ++i) product += static_cast<double>(draws[a][i][0]) * draws[b][i][0] / count;
      EXPECT_NEAR(product, 0.25, 5 * std::sqrt(7.0 / 144 / count)) << a << " and " << b;
    }
  EXPECT_EQ(draws[0], draw({1, 0}, 0, 0, 0));
}

} // namespace
