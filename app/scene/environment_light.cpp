// SPDX-License-Identifier: Apache-2.0
#include "scene/environment_light.h"

#include "optics/primary_spectra.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace nephroid::scene {
namespace {

using Moments = std::array<std::array<double, 3>, 3>;

/// Adds a texel's flux, and by that weight its colour over grey and the colour's products.
void add_texel(const Environment& environment, std::size_t texel, double steradians, EnvironmentFlux& flux, Moments& products)
{
  const double value = grey(environment, texel);
  if (!(value > 0)) return;
  const double weight = value * steradians;
  std::array<double, 3> colour{};
  for (std::size_t c = 0; c < 3; ++c) colour[c] = environment.rgb[3 * texel + c] / value;
  flux.grey += weight;
  for (std::size_t c = 0; c < 3; ++c) {
    flux.mean[c] += weight * colour[c];
    for (std::size_t d = 0; d < 3; ++d) products[c][d] += weight * colour[c] * colour[d];
  }
}

} // namespace

double grey(const Environment& environment, std::size_t texel)
{
  const float* rgb = environment.rgb.data() + 3 * texel;
  return (double(rgb[0]) + rgb[1] + rgb[2]) / 3;
}

// cos a - cos b as a product, which stays exact for thin rows and at the poles.
double texel_steradians(const Environment& environment, int row)
{
  using std::numbers::pi;
  const double step = pi / environment.height;
  return 2 * pi / environment.width * 2 * std::sin((row + 0.5) * step) * std::sin(0.5 * step);
}

EnvironmentFlux flux_of(const Environment& environment)
{
  EnvironmentFlux flux;
  Moments products{};
  const auto width = static_cast<std::size_t>(environment.width);
  for (int row = 0; row < environment.height; ++row) {
    const double steradians = texel_steradians(environment, row);
    for (std::size_t column = 0; column < width; ++column)
      add_texel(environment, static_cast<std::size_t>(row) * width + column, steradians, flux, products);
  }
  for (double& channel : flux.mean) channel /= flux.grey;
  const std::array<optics::Spectrum, 3>& primaries = optics::primary_spectra();
  for (std::size_t w = 0; w < flux.spectrum.size(); ++w) {
    double square = 0;
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t d = 0; d < 3; ++d) square += products[c][d] / flux.grey * primaries[c][w] * primaries[d][w];
    flux.spectrum[w] = std::sqrt(std::max(square, 0.0));
  }
  flux.power = std::accumulate(flux.spectrum.begin(), flux.spectrum.end(), 0.0);
  for (double& value : flux.spectrum) value /= flux.power;
  return flux;
}

Light make_environment_light(const Environment& environment)
{
  const EnvironmentFlux flux = flux_of(environment);
  Light light;
  light.type = preset::Light::Type::directional;
  light.irradiance_w_m2 = environment.radiance * flux.grey * flux.power;
  light.spectrum = flux.spectrum;
  light.primaries.assign(optics::primary_spectra().begin(), optics::primary_spectra().end());
  for (optics::Spectrum& primary : light.primaries)
    for (double& value : primary) value /= flux.power;
  return light;
}

} // namespace nephroid::scene
