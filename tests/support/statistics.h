// SPDX-License-Identifier: Apache-2.0
// Statistical tests that hand back p-values: the chance of a result at least this far off where the code is right. A
// test fails below `false_alarm`, so a few hundred of them raise one false alarm in some million runs with fresh seeds.
#pragma once
#include "tests/support/test.h"

#include <boost/math/special_functions/gamma.hpp>

namespace nephroid::test {

/// The p-value below which a test fails.
inline constexpr double false_alarm = 1e-9;

/// P(X >= chi2) of a chi-square distribution: the regularised upper incomplete gamma function Q(degrees / 2, chi2 / 2).
inline double chi_square_survival(double chi2, double degrees) { return boost::math::gamma_q(degrees / 2, chi2 / 2); }

/// P(|Z| >= |z|) of a standard normal distribution.
inline double two_sided(double z) { return std::erfc(std::abs(z) / std::sqrt(2.0)); }

/// The smallest of `tests` independent p-values, corrected after Sidak (1967): 1 - (1 - p)^tests, the chance that one
/// of them is as small by accident. Where tests are positively dependent, as the channels of a pixel are, this errs on
/// the safe side.
inline double sidak(double smallest_p, double tests) {
  return -std::expm1(tests * std::log1p(-std::min(smallest_p, 1.0)));
}

/// Bernstein's inequality: P(|S - E S| >= |deviation|) for a sum S of independent terms of which none is farther than
/// `largest` from its own mean, with the variance of S. It holds however few terms there are and however skewed, where
/// the normal distribution's tail promises far too little; where there are many, it is that tail without its factor 1 /
/// (z sqrt(2 pi)). degrees: of freedom of the estimate that `variance` is; as in Student's distribution, exp(-x)
/// becomes (1 + 2 x / degrees)^(-degrees / 2).
inline double bernstein(double deviation, double variance, double largest,
                        double degrees = std::numeric_limits<double>::infinity()) {
  const double t = std::abs(deviation);
  if (t == 0) return 1;
  const double z2 = t * t / (variance + largest * t / 3);
  const double exponent = std::isinf(degrees) ? -z2 / 2 : -degrees / 2 * std::log1p(z2 / degrees);
  return std::min(2 * std::exp(exponent), 1.0);
}

struct ChiSquare {
  double chi2 = 0, degrees = 0, p = 1;
};

/// Pearson's test of counts against a distribution, which is scaled to the sum of the counts. From the smallest up,
/// cells run together until they expect fewest_expected, which keeps the statistic's tail that of chi-square; a count
/// where nothing is expected counts against the cell that it ends up in. constraints: how many sums of the counts are
/// fixed (1: the total).
inline ChiSquare chi_square_test(std::span<const double> counts, std::span<const double> distribution,
                                 int constraints = 1, double fewest_expected = 25) {
  if (counts.size() != distribution.size())
    throw std::invalid_argument("chi_square_test: counts and distribution differ in size");
  const double scale = std::accumulate(counts.begin(), counts.end(), 0.0) /
                       std::accumulate(distribution.begin(), distribution.end(), 0.0);
  std::vector<std::size_t> order(counts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return distribution[a] > distribution[b]; });
  struct Cell {
    double count = 0, expected = 0;
  };
  std::vector<Cell> cells{{}};
  for (; !order.empty(); order.pop_back()) {
    if (cells.back().expected >= fewest_expected) cells.emplace_back();
    cells.back().count += counts[order.back()];
    cells.back().expected += distribution[order.back()] * scale;
  }
  if (static_cast<int>(cells.size()) <= constraints || cells.back().expected < fewest_expected)
    throw std::invalid_argument("chi_square_test: too few counts for a test");
  ChiSquare result;
  for (const Cell& cell : cells)
    result.chi2 += (cell.count - cell.expected) * (cell.count - cell.expected) / cell.expected;
  result.degrees = static_cast<double>(cells.size()) - constraints;
  result.p = chi_square_survival(result.chi2, result.degrees);
  return result;
}

/// Sums of weights in cells, for tests that an estimate's expectation is right everywhere.
struct WeightedCells {
  explicit WeightedCells(std::size_t cells) : sum(cells, 0.0), sum_of_squares(cells, 0.0) {}
  void add(std::size_t cell, double weight) {
    sum[cell] += weight;
    sum_of_squares[cell] += weight * weight;
    largest = std::max(largest, std::abs(weight));
  }
  std::vector<double> sum, sum_of_squares;
  double largest = 0;
};

/// Compares the means over `samples` of weights, cell by cell, with their expectations, each of which is off by `error`
/// itself where a quadrature made it. Sidak's p-value of the worst cell and of the total, each after Bernstein.
inline double weights_test(const WeightedCells& cells, std::span<const double> expectation, double samples,
                           double error = 0) {
  if (cells.sum.size() != expectation.size())
    throw std::invalid_argument("weights_test: cells and expectations differ in number");
  double smallest = 1, total = 0, total_squares = 0, total_expected = 0, total_error2 = 0;
  const auto test = [&](double sum, double sum_of_squares, double expected, double variance_of_expected) {
    // One weight more than were seen: a cell that got none by chance has some variance too.
    const double unseen = cells.largest * std::min(cells.largest, expected);
    const double variance = std::max(sum_of_squares - sum * sum / samples, 0.0) + unseen + variance_of_expected;
    if (sum != expected)
      smallest = std::min(smallest, variance > 0 ? bernstein(sum - expected, variance, cells.largest) : 0.0);
  };
  for (std::size_t i = 0; i < expectation.size(); ++i) {
    const double expected = expectation[i] * samples, error2 = error * error * samples * samples;
    test(cells.sum[i], cells.sum_of_squares[i], expected, error2);
    total += cells.sum[i];
    total_squares += cells.sum_of_squares[i];
    total_expected += expected;
    total_error2 += error2;
  }
  test(total, total_squares, total_expected, total_error2);
  return sidak(smallest, static_cast<double>(expectation.size()) + 1);
}

} // namespace nephroid::test
