// SPDX-License-Identifier: Apache-2.0
#include "photons/mixture.h"

#include "base/parallel.h"
#include "base/summed_area.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nephroid::photons {
namespace {

/// How far around a pixel its errors are asked for, and its light, in pixels.
constexpr int error_reach = 8, light_reach = 7;
constexpr double dark = 0.01; ///< below which light counts as if it were that: of white
constexpr std::size_t most_estimates = 2, most_weights = most_estimates + 1;

/// Of a mixture of a base and estimates: half of the squared error is w product w / 2 + w slope, up to a constant.
struct Errors {
  std::size_t count = 0;
  std::array<std::array<double, most_weights>, most_weights> product{};
  std::array<double, most_weights> slope{};
};

/// That make it smallest, 0..1 and 1 together, the first of them the base's: light is moved between two of them at a time.
std::array<double, most_weights> best_weights(const Errors& errors)
{
  constexpr int sweeps = 12;
  std::array<double, most_weights> w{1};
  const auto slope = [&](std::size_t i) {
    double sum = errors.slope[i];
    for (std::size_t k = 0; k < errors.count; ++k) sum += errors.product[i][k] * w[k];
    return sum;
  };
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (std::size_t i = 0; i < errors.count; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const double bend = errors.product[i][i] + errors.product[j][j] - 2 * errors.product[i][j];
        if (bend <= 0) continue;
        const double moved = std::clamp((slope(j) - slope(i)) / bend, -w[i], w[j]);
        w[i] += moved;
        w[j] -= moved;
      }
  return w;
}

} // namespace

void mix(std::span<const float> picture, std::span<const float> picture_draw, std::span<const Estimate> estimates,
         std::span<const double> light, int width, int height, std::vector<float>& rgb, std::vector<float>& error_draw)
{
  const SummedArea lights(width, height, [&](std::size_t i) { return light[i]; });
  // term(c): of a channel of a pixel. power: of their sum.
  const auto around = [&](const auto& term, int power) {
    return SummedArea(width, height, [&](std::size_t i) {
      double sum = 0;
      for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) sum += term(c);
      sum /= dark + lights.mean(static_cast<int>(i) % width, static_cast<int>(i) / width, light_reach);
      return power == 2 ? sum * sum : sum;
    });
  };
  std::vector<SummedArea> products, slopes, scatters;
  for (std::size_t k = 0; k < estimates.size(); ++k) {
    const std::vector<float>&r = estimates[k].change, &q = estimates[k].draw;
    const auto slope = [&](std::size_t c) {
      return r[c] * (static_cast<double>(rgb[c]) - picture[c]) + static_cast<double>(q[c]) * picture_draw[c];
    };
    slopes.push_back(around(slope, 1));
    scatters.push_back(around(slope, 2));
    for (std::size_t l = 0; l <= k; ++l)
      products.push_back(around([&](std::size_t c) { return static_cast<double>(r[c]) * estimates[l].change[c]; }, 1));
  }
  for_ranges(light.size(), std::size_t{1} << 12, [&](std::size_t, Range range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const int x = static_cast<int>(i) % width, y = static_cast<int>(i) / width;
      Errors errors{estimates.size() + 1};
      for (std::size_t k = 1, product = 0; k < errors.count; ++k) {
        const double scatter = std::sqrt(std::max(scatters[k - 1].sum(x, y, error_reach), 0.0));
        errors.slope[k] = std::min(slopes[k - 1].sum(x, y, error_reach) + scatter, 0.0);
        for (std::size_t l = 1; l <= k; ++l) errors.product[k][l] = errors.product[l][k] = products[product++].sum(x, y, error_reach);
      }
      const std::array<double, most_weights> weights = best_weights(errors);
      for (std::size_t k = 1; k < errors.count; ++k)
        for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
          rgb[c] += static_cast<float>(weights[k]) * estimates[k - 1].change[c];
          error_draw[c] += static_cast<float>(weights[k]) * estimates[k - 1].draw[c];
        }
    }
  });
}

} // namespace nephroid::photons
