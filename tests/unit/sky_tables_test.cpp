// SPDX-License-Identifier: Apache-2.0
// The environment as a light, on the host: its flux, its spectrum, and the tables that photons are drawn by.
#include "optics/colour.h"
#include "scene/environment.h"
#include "tests/support/test.h"
#include "tracing/scene_tables.h"

namespace nephroid::sky_tables_test {

scene::Environment map_of(int width, std::vector<float> rgb)
{
  scene::Environment map;
  map.width = width;
  map.height = static_cast<int>(rgb.size() / 3) / width;
  map.rgb = std::move(rgb);
  return map;
}

/// Faint and strong, coloured, black.
scene::Environment uneven()
{
  std::vector<float> rgb;
  for (int i = 0; i < 64; ++i)
    for (int c = 0; c < 3; ++c) rgb.push_back(i % 5 == 4 ? 0.0f : i == 17 ? 3e4f : static_cast<float>(0.1 + (i + c) % 3));
  return map_of(8, rgb);
}

TEST(EnvironmentFlux, TexelsFillTheSphere)
{
  for (const int width : {1, 2, 8, 4096}) {
    const scene::Environment map = map_of(width, std::vector<float>(static_cast<std::size_t>(3 * width * std::max(1, width / 2)), 1.0f));
    double sum = 0;
    for (int row = 0; row < map.height; ++row) sum += width * scene::texel_steradians(map, row);
    EXPECT_NEAR(sum / (4 * M_PI), 1, 1e-12) << width;
  }
}

TEST(EnvironmentFlux, OneColourHasItsSpectrum)
{
  scene::Environment map = map_of(2, {0.9f, 0.6f, 0.3f, 0.9f, 0.6f, 0.3f});
  map.radiance = 5;
  const scene::EnvironmentFlux flux = scene::flux_of(map);
  EXPECT_NEAR(flux.grey, 0.6 * 4 * M_PI, 1e-6);
  const scene::Light light = scene::make_environment_light(map);
  EXPECT_NEAR(std::accumulate(light.spectrum.begin(), light.spectrum.end(), 0.0), 1, 1e-12);
  double sum = 0;
  for (std::size_t w = 0; w < light.spectrum.size(); ++w) {
    double radiance = 0, carried = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      radiance += 5 * static_cast<double>(map.rgb[c]) * optics::primary_spectra()[c][w];
      carried += flux.mean[c] * light.primaries[c][w];
    }
    sum += std::abs(radiance);
    EXPECT_NEAR(light.irradiance_w_m2 * carried, 4 * M_PI * radiance, 1e-7);
    EXPECT_NEAR(light.spectrum[w], std::abs(carried), 1e-7);
  }
  EXPECT_NEAR(light.irradiance_w_m2, 4 * M_PI * sum, 1e-4);
}

// No photon carries much more than another, and each texel is drawn as often as its flux asks for.
TEST(SkyTables, PhotonsCarryAlike)
{
  const scene::Environment map = uneven();
  const tracing::SkyTables tables = tracing::make_sky_tables(map);
  const double all = scene::flux_of(map).grey;
  ASSERT_EQ(tables.cdf.size(), 8u + 64u);
  ASSERT_EQ(tables.colour.size(), map.rgb.size());
  const auto chance = [&](std::size_t first, std::size_t i) {
    return static_cast<double>(tables.cdf[first + i]) - (i > 0 ? static_cast<double>(tables.cdf[first + i - 1]) : 0.0);
  };
  for (std::size_t row = 0; row < 8; ++row)
    for (std::size_t column = 0; column < 8; ++column) {
      const std::size_t texel = 8 * row + column;
      const double drawn = chance(0, row) * chance(8 + 8 * row, column), grey = scene::grey(map, texel),
                   steradians = scene::texel_steradians(map, static_cast<int>(row));
      EXPECT_NEAR(drawn, grey * steradians / all, 16 * 0x1p-24); // a quantum for each of a row, and of the rows
      for (std::size_t c = 0; c < 3; ++c) {
        const double colour = static_cast<double>(tables.colour[3 * texel + c]);
        EXPECT_NEAR(drawn * colour, static_cast<double>(map.rgb[3 * texel + c]) * steradians / all, 1e-7 * drawn * colour);
        EXPECT_LE(colour, 3 * 1.01);
      }
    }
}

// Half of the light in one texel of 2^40 times the others': these are still drawn, and carry as little as they have.
TEST(SkyTables, NothingIsLostBesideASun)
{
  std::vector<float> rgb(3 * 32 * 16, 1e-6f);
  rgb[0] = rgb[1] = rgb[2] = 1e12f;
  const scene::Environment map = map_of(32, rgb);
  const tracing::SkyTables tables = tracing::make_sky_tables(map);
  for (std::size_t i = 0; i < tables.cdf.size(); ++i)
    EXPECT_GT(tables.cdf[i], i == 0 || (i >= 16 && (i - 16) % 32 == 0) ? 0 : tables.cdf[i - 1]);
  for (std::size_t i = 3; i < tables.colour.size(); ++i) {
    EXPECT_GT(tables.colour[i], 0);
    EXPECT_LT(tables.colour[i], 1e-6f);
  }
}

} // namespace nephroid::sky_tables_test
