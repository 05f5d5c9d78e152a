// SPDX-License-Identifier: Apache-2.0
#include "environment/white_light.h"

#include "optics/colour.h"

#include <glm/glm.hpp>

namespace nephroid::environment {

std::vector<shared::float4> white_light()
{
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
  for (int w = 0; w < optics::wavelength_count; ++w) {
    const glm::dvec3 rgb = colour_of(w) / sum;
    light.push_back({static_cast<float>(rgb.x), static_cast<float>(rgb.y), static_cast<float>(rgb.z), 0});
  }
  return light;
}

} // namespace nephroid::environment
