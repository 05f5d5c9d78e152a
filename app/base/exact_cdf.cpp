// SPDX-License-Identifier: Apache-2.0
#include "base/exact_cdf.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nephroid {

std::vector<float> exact_cdf(const std::vector<double>& weights) {
  constexpr double quanta = 0x1p24;
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (!weights.empty() && !(total > 0)) return exact_cdf(std::vector<double>(weights.size(), 1.0));
  // Each weight gets one quantum, so that rounding leaves none out, and the rest in proportion.
  const auto positive = static_cast<double>(std::ranges::count_if(weights, [](double w) { return w > 0; }));
  std::vector<float> cdf;
  double sum = 0, ones = 0;
  for (const double weight : weights) {
    sum += weight;
    ones += weight > 0 ? 1 : 0;
    cdf.push_back(static_cast<float>((ones + std::round((quanta - positive) * std::min(sum / total, 1.0))) / quanta));
  }
  return cdf;
}

std::vector<float> exact_cdf_from_zero(const std::vector<double>& weights) {
  std::vector<float> cdf = exact_cdf(weights);
  cdf.insert(cdf.begin(), 0.0f);
  return cdf;
}

} // namespace nephroid
