// SPDX-License-Identifier: Apache-2.0
// kernels/scatter/microfacet.h: microfacets are met as often as a direction sees them.
#include "check/check.h"
#include "check/device_arrays.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::check {
namespace {

using std::numbers::pi;

constexpr std::size_t rows = 12, columns = 16; // of cells; [row][column] below

/// The chance of each cell. A cell is a range of t = tan^2 / (alpha^2 + tan^2) of the facet's angle to the normal, and
/// one of azimuth: D(h) cos(h) dh = dt dphi / (2 pi), so the density of facets h that `view` sees is
/// max(view . h, 0) / (cos(h) view . n (1 + Lambda)).
std::vector<double> chances(double cos_view, double alpha) {
  const double sin_view = std::sqrt(1 - cos_view * cos_view), tangent = sin_view / cos_view,
               lambda = (std::sqrt(1 + alpha * alpha * tangent * tangent) - 1) / 2;
  constexpr std::size_t steps = 48; // a cell and side
  std::vector<double> chance(rows * columns, 0);
  for (std::size_t i = 0; i < rows * steps; ++i)
    for (std::size_t j = 0; j < columns * steps; ++j) {
      // By s = sqrt(1 - t), as 1 / cos(h) goes with 1 / s.
      const std::size_t row = i / steps;
      const double from = std::sqrt(1 - static_cast<double>(row) / rows),
                   to = std::sqrt(1 - static_cast<double>(row + 1) / rows);
      const double s = std::lerp(from, to, (static_cast<double>(i % steps) + 0.5) / steps), t = 1 - s * s;
      const double phi = 2 * pi * (static_cast<double>(j) + 0.5) / (columns * steps);
      const double cosine = std::sqrt((1 - t) / (1 - t + alpha * alpha * t)), sine = std::sqrt(1 - cosine * cosine);
      const double seen = std::max(sin_view * sine * std::cos(phi) + cos_view * cosine, 0.0);
      chance[row * columns + j / steps] +=
          seen / (cosine * cos_view * (1 + lambda)) * 2 * s * (from - to) / (columns * steps * steps);
    }
  return chance;
}

/// How far chi-square is from its mean, in standard deviations of it.
double z_of_facets(const compute::Context& context, double cos_view, double alpha, std::uint64_t seed) {
  constexpr std::size_t samples = 1 << 18;
  const compute::Buffer<float4> out(context, "out", samples);
  const float4 view{static_cast<float>(std::sqrt(1 - cos_view * cos_view)), 0, static_cast<float>(cos_view),
                    static_cast<float>(alpha)};
  run_kernel(context, "visible_microfacets", samples,
             {{"view", compute::Buffer(context, "view", std::vector{view})},
              {"seed", shared::uint2{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}},
              {"out", out}});
  std::vector<double> counts(rows * columns, 0);
  for (const float4& facet : out.read()) {
    const double tangent2 = (double(facet.x) * facet.x + double(facet.y) * facet.y) / (double(facet.z) * facet.z);
    const double turn = std::atan2(facet.y, facet.x) / (2 * pi) + 1; // above .5
    const auto row = std::min(static_cast<std::size_t>(rows * tangent2 / (alpha * alpha + tangent2)), rows - 1),
               column = static_cast<std::size_t>(columns * turn) % columns;
    ++counts[row * columns + column];
  }
  const std::vector<double> chance = chances(cos_view, alpha);
  double chi_square = 0, freedom = -1, rare = 0, rare_counts = 0; // cells with few facets count as one
  for (std::size_t i = 0; i < chance.size(); ++i) {
    const double expected = chance[i] * samples;
    if (expected < 10) {
      rare += expected;
      rare_counts += counts[i];
      continue;
    }
    chi_square += (counts[i] - expected) * (counts[i] - expected) / expected;
    ++freedom;
  }
  if (rare >= 10) chi_square += (rare_counts - rare) * (rare_counts - rare) / rare, ++freedom;
  return (chi_square - freedom) / std::sqrt(2 * freedom);
}

Result facets(const compute::Context& context, std::uint64_t seed) {
  double worst = 0;
  for (const double alpha : {0.04, 0.25, 1.0})
    for (const double angle_deg : {0.0, 45.0, 80.0})
      worst = worse(worst, z_of_facets(context, std::cos(angle_deg * pi / 180), alpha, seed));
  return judged(worst, 6, "sigma",
                "facets of GGX with alpha .04, .25 and 1 that are seen from 0, 45 and 80 degrees, in 192 cells: "
                "chi-square about its mean");
}

} // namespace

Checks roughness_checks() { return {{"rough: facets that a direction sees", facets}}; }

} // namespace nephroid::check
