// SPDX-License-Identifier: Apache-2.0
#include "inverse/assign/cost.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nephroid::inverse {

Cost cost_of(const Target& t, std::span<const double> z, double sent)
{
  constexpr double counts = 0.01;
  const double t_max = *std::max_element(t.begin(), t.end()), z_max = *std::max_element(z.begin(), z.end());
  const double t_sum = std::accumulate(t.begin(), t.end(), 0.0), z_sum = std::accumulate(z.begin(), z.end(), 0.0);
  const auto part = [](double value, double of) { return of > 0 ? value / of : 0; };
  double squares = 0, counted_squares = 0, l2 = 0, norm = 0;
  std::size_t counted = 0;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double a = t[i] / t_max, b = part(z[i], z_max), d = (a - b) * (a - b);
    squares += d;
    if (a + b > counts) {
      counted_squares += d;
      ++counted;
    }
    const double wanted = t[i] / t_sum, e = wanted - part(z[i], z_sum);
    l2 += e * e;
    norm += wanted * wanted;
  }
  return {std::sqrt(counted_squares / static_cast<double>(counted)), std::sqrt(squares / static_cast<double>(t.size())),
          std::sqrt(l2 / norm), sent > 0 ? 1 - z_sum / sent : 0};
}

std::vector<Cost> costs_of(const std::vector<Target>& targets, const std::vector<std::vector<double>>& light, double sent)
{
  std::vector<Cost> costs;
  for (std::size_t j = 0; j < targets.size(); ++j) costs.push_back(cost_of(targets[j], light[j], sent));
  return costs;
}

Cost mean(std::span<const Cost> costs)
{
  Cost sum;
  for (const Cost& c : costs) {
    sum.cost += c.cost;
    sum.cost_all += c.cost_all;
    sum.rel_l2 += c.rel_l2;
    sum.missed += c.missed;
  }
  const double count = static_cast<double>(costs.size());
  return {sum.cost / count, sum.cost_all / count, sum.rel_l2 / count, sum.missed / count};
}

} // namespace nephroid::inverse
