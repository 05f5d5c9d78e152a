// SPDX-License-Identifier: Apache-2.0
// A cdf in single precision whose differences are the chances to the bit.
#include "tests/support/test.h"
#include "tracing/scales.h"

namespace nephroid::exact_cdf_test {

using nephroid::tracing::exact_cdf;
using nephroid::tracing::exact_cdf_from_zero;

TEST(ExactCdf, IsInProportion)
{
  EXPECT_THAT(exact_cdf({1}), ElementsAre(1));
  const std::vector<float> cdf = exact_cdf({1, 3, 4});
  EXPECT_NEAR(cdf[0], 0.125, 0x1p-22); // a quantum each off, at most
  EXPECT_NEAR(cdf[1], 0.5, 0x1p-22);
  EXPECT_EQ(cdf[2], 1);
}

// Weights over 24 orders of magnitude: every difference is a whole number of 2^-24, 0 only where the weight is.
TEST(ExactCdf, LosesNothingInRounding)
{
  std::vector<double> weights(401);
  for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = i % 7 == 3 ? 0 : std::pow(10.0, -static_cast<double>(i % 25));
  const std::vector<float> cdf = exact_cdf(weights);
  ASSERT_EQ(cdf.size(), weights.size());
  float before = 0;
  for (std::size_t i = 0; i < cdf.size(); ++i) {
    const double quanta = std::ldexp(static_cast<double>(cdf[i]), 24);
    EXPECT_EQ(quanta, std::round(quanta)) << i;
    if (weights[i] > 0)
      EXPECT_GE(cdf[i] - before, 0x1p-24f) << i;
    else
      EXPECT_EQ(cdf[i], before) << i;
    before = cdf[i];
  }
  EXPECT_EQ(cdf.back(), 1);
}

TEST(ExactCdf, OfNothingIsEven)
{
  EXPECT_THAT(exact_cdf({0, 0, 0, 0}), ElementsAre(0.25, 0.5, 0.75, 1));
  EXPECT_TRUE(exact_cdf({}).empty());
}

TEST(ExactCdf, FromZeroHasOneMore)
{
  EXPECT_THAT(exact_cdf_from_zero({0, 2}), ElementsAre(0, 0, 1));
  EXPECT_THAT(exact_cdf_from_zero({}), ElementsAre(0));
}

} // namespace nephroid::exact_cdf_test
