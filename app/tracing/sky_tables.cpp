// SPDX-License-Identifier: Apache-2.0
#include "tracing/sky_tables.h"

#include "scene/environment_light.h"
#include "tracing/exact_cdf.h"

#include <cmath>

namespace nephroid::tracing {
namespace {

double chance(const std::vector<float>& cdf, std::size_t i) { return double(cdf[i]) - (i > 0 ? double(cdf[i - 1]) : 0.0); }

/// The chance of each row in `rows`, of its texels after them.
struct Flux {
  std::vector<double> rows;               ///< [row] grey times steradians
  std::vector<std::vector<float>> texels; ///< [row] exact_cdf
};

Flux flux_by_rows(const scene::Environment& environment)
{
  const auto width = static_cast<std::size_t>(environment.width), height = static_cast<std::size_t>(environment.height);
  Flux flux;
  for (std::size_t row = 0; row < height; ++row) {
    std::vector<double> values(width);
    double sum = 0;
    for (std::size_t column = 0; column < width; ++column) sum += values[column] = scene::grey(environment, row * width + column);
    flux.rows.push_back(sum * scene::texel_steradians(environment, static_cast<int>(row)));
    flux.texels.push_back(exact_cdf(values));
  }
  return flux;
}

} // namespace

shared::DeviceBackground picture_size(const scene::Environment& environment)
{
  return {environment.width, environment.height, static_cast<float>(std::fmod(environment.rotate_deg, 360.0) / 360), 0};
}

SkyTables make_sky_tables(const scene::Environment& environment)
{
  const scene::EnvironmentFlux whole = scene::flux_of(environment);
  const Flux flux = flux_by_rows(environment);
  const auto width = static_cast<std::size_t>(environment.width);
  SkyTables tables;
  tables.size = picture_size(environment);
  tables.cdf = exact_cdf(flux.rows);
  tables.mean_colour = {static_cast<float>(whole.mean[0]), static_cast<float>(whole.mean[1]), static_cast<float>(whole.mean[2]), 0};
  tables.colour.reserve(environment.rgb.size());
  for (std::size_t row = 0; row < flux.rows.size(); ++row) {
    const double steradians = scene::texel_steradians(environment, static_cast<int>(row)), of_row = chance(tables.cdf, row);
    for (std::size_t column = 0; column < width; ++column) {
      const double drawn = of_row * chance(flux.texels[row], column);
      for (std::size_t c = 0; c < 3; ++c) {
        const double value = environment.rgb[3 * (row * width + column) + c];
        tables.colour.push_back(drawn > 0 ? static_cast<float>(value * steradians / (whole.grey * drawn)) : 0.0f);
      }
    }
  }
  for (const std::vector<float>& row : flux.texels) tables.cdf.insert(tables.cdf.end(), row.begin(), row.end());
  return tables;
}

std::uint64_t bytes_of(const SkyTables& tables) { return (tables.cdf.size() + tables.colour.size()) * sizeof(float); }

} // namespace nephroid::tracing
