// SPDX-License-Identifier: Apache-2.0
#include "environment/colours.h"

#include "tracing/scales.h"
#include "tracing/scene_tables.h"

#include <glm/glm.hpp>

#include <algorithm>

namespace nephroid::environment {
namespace {

shared::float4 to_rgb(const optics::Colour& xyz) {
  const optics::Colour rgb = optics::xyz_to_linear_srgb(xyz);
  return tracing::to_float4({rgb[0], rgb[1], rgb[2]});
}

} // namespace

std::vector<shared::float4> white_light() {
  std::vector<shared::float4> light;
  glm::dvec3 sum(0);
  const auto colour_of = [](int w) {
    optics::Spectrum one{};
    const auto i = static_cast<std::size_t>(w);
    for (const optics::Spectrum& primary : optics::primary_spectra()) one[i] += primary[i];
    const optics::Colour rgb = optics::xyz_to_linear_srgb(optics::to_xyz(one));
    return glm::dvec3(rgb[0], rgb[1], rgb[2]);
  };
  for (int w = 0; w < optics::wavelength_count; ++w) sum += colour_of(w);
  for (int w = 0; w < optics::wavelength_count; ++w) light.push_back(tracing::to_float4(colour_of(w) / sum));
  return light;
}

std::vector<shared::float4> lit_colours(const tracing::WavelengthTables& tables) {
  std::vector<shared::float4> colours;
  for (const shared::float4& xyz : tables.reflected_xyz_all) colours.push_back(to_rgb({xyz.x, xyz.y, xyz.z}));
  return colours;
}

std::vector<shared::float4> reflected_primaries(const tracing::WavelengthTables& tables) {
  std::vector<shared::float4> colours;
  for (std::size_t r = 0; r < static_cast<std::size_t>(tables.reflector_count); ++r)
    for (optics::Spectrum primary : optics::primary_spectra()) {
      for (std::size_t w = 0; w < primary.size(); ++w) primary[w] *= tables.reflectance[r * primary.size() + w];
      colours.push_back(to_rgb(optics::to_xyz(primary)));
    }
  return colours;
}

std::vector<float> channel_cdf() {
  const std::vector<shared::float4> light = white_light();
  std::vector<float> cdf;
  for (const auto channel : {&shared::float4::x, &shared::float4::y, &shared::float4::z}) {
    std::vector<double> chances;
    for (const shared::float4& rgb : light) chances.push_back(std::max(rgb.*channel, 0.0F));
    const std::vector<float> own = exact_cdf(chances);
    cdf.insert(cdf.end(), own.begin(), own.end());
  }
  return cdf;
}

} // namespace nephroid::environment
