// SPDX-License-Identifier: Apache-2.0
// kernels/tracing/random.h against the published test vectors of its generator. samplers_test.cpp tests the distribution of its uniforms.
#include "tests/support/test.h"
#include "tests/support/test_kernels.h"

namespace nephroid::random_test {

using Block = std::array<std::uint32_t, 4>;

TEST(Random, PhiloxGivesThePublishedVectors)
{
  // Random123's tests/kat_vectors, the lines "philox4x32 10": counter, key, result.
  const std::vector<Block> counters{
      {0, 0, 0, 0}, {0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, {0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}};
  const std::vector<std::array<std::uint32_t, 2>> keys{{0, 0}, {0xffffffff, 0xffffffff}, {0xa4093822, 0x299f31d0}};
  const std::vector<Block> published{{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8},
                                     {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd},
                                     {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}};
  const compute::Context context = compute::Context::open(test::device_options());
  const compute::Buffer<Block> in(context, "counters", std::span(counters)), out(context, "results", counters.size());
  const compute::Buffer<std::array<std::uint32_t, 2>> key(context, "keys", std::span(keys));
  compute::Program(context, "check/check.cl")
      .kernel("philox")
      .run(counters.size(), 1, {{"counters", in}, {"keys", key}, {"results", out}, {"count", static_cast<std::uint32_t>(counters.size())}});
  EXPECT_EQ(out.read(), published);
}

} // namespace nephroid::random_test
