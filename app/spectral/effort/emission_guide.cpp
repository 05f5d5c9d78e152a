// SPDX-License-Identifier: Apache-2.0
#include "spectral/effort/emission_guide.h"

#include "tracing/scales.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nephroid::spectral {
namespace {

constexpr std::size_t bins_x = GUIDE_BINS_X, bins_y = GUIDE_BINS_Y, bins_z = GUIDE_BINS_Z, cells = EmissionGuide::cells;

/// The part of the photons that is spread evenly whatever was learned: a cell that looked dark may not be.
constexpr double even_part = 0.15;

/// The mean with the neighbours, weights 1 2 1, over the second and the third number; the third goes round, as it is an angle.
std::vector<double> blurred(std::span<const double> values)
{
  const auto pass = [](std::span<const double> from, std::size_t bins, std::size_t stride, bool wraps) {
    std::vector<double> to(from.size());
    for (std::size_t i = 0; i < from.size(); ++i) {
      const std::size_t bin = i / stride % bins, first = i - bin * stride;
      const std::size_t below = bin > 0 ? bin - 1 : wraps ? bins - 1 : bin, above = bin + 1 < bins ? bin + 1 : wraps ? 0 : bin;
      to[i] = 0.25 * from[first + below * stride] + 0.5 * from[i] + 0.25 * from[first + above * stride];
    }
    return to;
  };
  return pass(pass(values, bins_y, bins_z, false), bins_z, 1, true);
}

/// The sums of groups of `size` values.
std::vector<double> sums(std::span<const double> values, std::size_t size)
{
  std::vector<double> result;
  for (std::size_t i = 0; i < values.size(); i += size)
    result.push_back(std::accumulate(values.begin() + i, values.begin() + i + size, 0.0));
  return result;
}

/// Appends the cdf of each group of `size` values.
void append_cdfs(const std::vector<double>& values, std::size_t size, std::vector<float>& table)
{
  for (std::size_t i = 0; i < values.size(); i += size) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(i);
    const std::vector<float> cdf = tracing::exact_cdf({first, first + static_cast<std::ptrdiff_t>(size)});
    table.insert(table.end(), cdf.begin(), cdf.end());
  }
}

} // namespace

EmissionGuide::EmissionGuide(std::size_t lights) : squares_(lights * cells, 0), samples_(lights * cells, 0)
{
  const std::vector<std::int64_t> dark(lights * cells, 0);
  chance_.assign(lights * cells, 1.0 / cells);
  learn(dark, std::vector<double>(lights, 0), 0);
}

// A photon of a cell that comes `density` times as often as evenly counts 1 / density; of n photons of the light it adds v = f / (n
// density). The cell gets n density / GUIDE_CELLS of them, so a pass' sum of v^2 there is E[f^2] / (n density GUIDE_CELLS), and n density
// times that estimates E[f^2] / GUIDE_CELLS. Deals are weighed by the cell's number of photons.
void EmissionGuide::learn(std::span<const std::int64_t> moments, std::span<const double> photons, double passes)
{
  table_.clear();
  for (std::size_t l = 0; l < photons.size(); ++l) {
    const std::size_t first = l * cells;
    std::vector<double> deviation(cells);
    for (std::size_t c = 0; c < cells; ++c) {
      const double n_density = photons[l] * chance_[first + c] * cells;
      squares_[first + c] += n_density * n_density * static_cast<double>(moments[first + c]);
      samples_[first + c] += n_density * passes;
      deviation[c] = squares_[first + c] > 0 ? std::sqrt(squares_[first + c] / samples_[first + c]) : 0;
    }
    deviation = blurred(deviation);
    const double total = std::accumulate(deviation.begin(), deviation.end(), 0.0);
    std::vector<double> chance(cells, 1.0 / cells);
    if (total > 0)
      for (std::size_t c = 0; c < cells; ++c) chance[c] = even_part / cells + (1 - even_part) * deviation[c] / total;
    std::copy(chance.begin(), chance.end(), chance_.begin() + static_cast<std::ptrdiff_t>(first));
    const std::vector<double> of_xy = sums(chance, bins_z);
    append_cdfs(sums(of_xy, bins_y), bins_x, table_);
    append_cdfs(of_xy, bins_y, table_);
    append_cdfs(chance, bins_z, table_);
  }
}

void EmissionGuide::state(tracing::State& state)
{
  for (std::vector<double>* values : {&chance_, &squares_, &samples_}) state.items(std::span(*values));
  state.items(std::span(table_));
}

} // namespace nephroid::spectral
