// SPDX-License-Identifier: Apache-2.0
// The statistical tests of tests/support/statistics.h: published quantiles, their false-alarm rate, and that they find
// what they are for.
#include "tests/support/statistics.h"

#include <boost/math/distributions/binomial.hpp>

namespace nephroid::statistics_test {

TEST(Statistics, SurvivalFunctionsGiveThePublishedQuantiles) {
  // NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.4: upper critical values of chi-square; 1.3.6.7.1 of the
  // normal distribution.
  EXPECT_NEAR(chi_square_survival(3.841, 1), 0.05, 2e-5);
  EXPECT_NEAR(chi_square_survival(18.307, 10), 0.05, 2e-5);
  EXPECT_NEAR(chi_square_survival(29.588, 10), 0.001, 2e-6);
  EXPECT_NEAR(chi_square_survival(124.342, 100), 0.05, 2e-5);
  EXPECT_NEAR(two_sided(1.959964), 0.05, 1e-7);
  EXPECT_NEAR(two_sided(-3.290527), 0.001, 1e-8);
  EXPECT_NEAR(sidak(0.01, 10), 1 - std::pow(0.99, 10), 1e-15);
  EXPECT_NEAR(sidak(1e-15, 1e5) / 1e-10, 1, 1e-6); // where 1 - p would be 1
}

// Bernstein's bound must lie above the exact tail of a binomial sum, on both sides, for few and for many expected
// events.
TEST(Statistics, BernsteinBoundsExactTails) {
  for (const double expected : {0.01, 1.0, 30.0, 1000.0}) {
    const double trials = 1e6, p = expected / trials;
    const boost::math::binomial_distribution<double> binomial(trials, p);
    for (double z = 1; z < 9; z += 0.5) {
      const double deviation = std::ceil(z * std::sqrt(expected));
      const double above = cdf(complement(binomial, std::ceil(expected + deviation) - 1));
      const double below = expected >= deviation ? cdf(binomial, expected - deviation) : 0;
      EXPECT_GE(bernstein(deviation, trials * p * (1 - p), 1), above + below)
          << expected << " expected, " << deviation << " off";
    }
  }
  // Far from useless: with a thousand events a deviation of 8 sigma is beyond the false-alarm rate.
  EXPECT_LT(bernstein(8 * std::sqrt(1000.0), 1000, 1), false_alarm);
  // And with a variance estimated from few values it takes more.
  EXPECT_GT(bernstein(8 * std::sqrt(1000.0), 1000, 1, 20), false_alarm);
}

std::vector<double> drawn_counts(const std::vector<double>& distribution, int samples, std::mt19937& random) {
  std::discrete_distribution<std::size_t> draw(distribution.begin(), distribution.end());
  std::vector<double> counts(distribution.size(), 0.0);
  for (int i = 0; i < samples; ++i) ++counts[draw(random)];
  return counts;
}

// Of right counts, a hundredth has p below 0.01: of 1000 tests 10 +- sqrt(9.9), and 5 deviations of room. The last
// cells are so small that they have to be pooled.
TEST(Statistics, ChiSquareRaisesAsManyFalseAlarmsAsItSays) {
  std::mt19937 random(11);
  std::vector<double> distribution(50, 1.0);
  for (std::size_t i = 40; i < 50; ++i) distribution[i] = 0.02;
  int alarms = 0;
  for (int test = 0; test < 1000; ++test) {
    const std::vector<double> counts = drawn_counts(distribution, 4000, random);
    const ChiSquare result = chi_square_test(counts, distribution);
    EXPECT_EQ(result.degrees, 39);
    alarms += result.p < 0.01;
  }
  EXPECT_NEAR(alarms, 10, 5 * std::sqrt(9.9));
}

TEST(Statistics, ChiSquareFindsAFewPercentAndImpossibleCounts) {
  std::mt19937 random(12);
  std::vector<double> truth(100, 1.0), wrong = truth;
  for (std::size_t i = 0; i < 100; ++i) wrong[i] = i < 50 ? 1.02 : 0.98;
  truth[99] = wrong[99] = 0;
  std::vector<double> counts = drawn_counts(truth, 1 << 20, random);
  EXPECT_GT(chi_square_test(counts, truth).p, false_alarm);
  EXPECT_LT(chi_square_test(counts, wrong).p, false_alarm);
  counts[99] = 2000;
  EXPECT_LT(chi_square_test(counts, truth).p, false_alarm);
  EXPECT_THROW(chi_square_test(std::vector<double>{1, 2}, std::vector<double>{1, 1}), std::invalid_argument);
}

TEST(Statistics, WeightsTestFindsABiasOfTheTotalAndOfACell) {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> uniform(0, 1);
  constexpr int samples = 1 << 18;
  WeightedCells cells(64);
  for (int i = 0; i < samples; ++i) {
    const double place = uniform(random), weight = uniform(random);
    cells.add(static_cast<std::size_t>(place * 64), weight);
  }
  std::vector<double> expectation(64, 0.5 / 64);
  EXPECT_GT(weights_test(cells, expectation, samples), false_alarm);
  expectation[7] *= 1.2;
  EXPECT_LT(weights_test(cells, expectation, samples), false_alarm);
  std::fill(expectation.begin(), expectation.end(), 0.51 / 64);
  EXPECT_LT(weights_test(cells, expectation, samples), false_alarm);
  EXPECT_GT(weights_test(cells, expectation, samples, 0.1 / 64), false_alarm);
}

} // namespace nephroid::statistics_test
