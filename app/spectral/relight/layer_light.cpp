// SPDX-License-Identifier: Apache-2.0
#include "spectral/relight/layer_light.h"

#include "scene/materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace nephroid::spectral {
namespace {

using optics::Colour;

std::size_t reflectors(const tracing::WavelengthTables& tables) { return static_cast<std::size_t>(tables.reflector_count); }

double reflectance(const tracing::WavelengthTables& tables, std::size_t reflector, int wavelength)
{
  return static_cast<double>(tables.reflectance[reflector * optics::wavelength_count + static_cast<std::size_t>(wavelength)]);
}

} // namespace

double LayerLight::strongest() const
{
  const double most = power.empty() ? 0 : *std::max_element(power.begin(), power.end());
  return most > 0 ? most : 1;
}

LayerLight layer_light(const scene::Scene& scene, double white)
{
  LayerLight light;
  for (const scene::Light& l : scene.lights) {
    light.spectra.push_back(l.spectrum);
    light.power.push_back(l.power_w + l.irradiance_w_m2); // the one that its type does not have is 0
  }
  light.white = white;
  return light;
}

LayerLight layer_light(const preset::Preset& preset)
{
  LayerLight light;
  for (std::size_t i = 0; i < preset.scene.lights.size(); ++i) {
    const preset::Light& l = preset.scene.lights[i];
    light.spectra.push_back(scene::make_light_spectrum(l.spectrum, Place(preset.source) / "scene" / "lights" / i / "spectrum"));
    light.power.push_back(l.type == preset::Light::Type::directional ? l.irradiance_w_m2 : l.power_w);
  }
  light.white = preset.white;
  return light;
}

LayerWeights layer_weights(const LayerLight& light, const tracing::WavelengthTables& tables)
{
  const optics::ColourMatching& eye = optics::cie_1931();
  LayerWeights weights;
  for (std::size_t l = 0; l < light.spectra.size(); ++l) {
    std::vector<Colour> all(reflectors(tables), Colour{});
    for (const std::vector<int>& cluster : tables.clusters)
      for (std::size_t r = 0; r < reflectors(tables); ++r) {
        Colour xyz{};
        for (const int index : cluster) {
          const auto w = static_cast<std::size_t>(index);
          const double power = light.power[l] / light.white * light.spectra[l][w] * reflectance(tables, r, index);
          xyz[0] += power * eye.x[w];
          xyz[1] += power * eye.y[w];
          xyz[2] += power * eye.z[w];
        }
        weights.clusters.push_back(optics::xyz_to_linear_srgb(xyz));
        for (std::size_t k = 0; k < 3; ++k) all[r][k] += weights.clusters.back()[k];
      }
    weights.all.insert(weights.all.end(), all.begin(), all.end());
  }
  return weights;
}

FlatLight flat_light(const tracing::WavelengthTables& tables)
{
  const optics::ColourMatching& eye = optics::cie_1931();
  const double luminance = std::accumulate(eye.y.begin(), eye.y.end(), 0.0);
  FlatLight flat;
  for (const std::vector<int>& cluster : tables.clusters) {
    double share = 0;
    for (const int w : cluster) share += eye.y[static_cast<std::size_t>(w)];
    flat.luminance_share.push_back(static_cast<float>(share / luminance));
    for (std::size_t r = 0; r < reflectors(tables); ++r) {
      double sum = 0;
      for (const int w : cluster) sum += reflectance(tables, r, w);
      flat.mean_reflectance.push_back(static_cast<float>(sum / static_cast<double>(cluster.size())));
    }
  }
  for (std::size_t r = 0; r < reflectors(tables); ++r) {
    double sum = 0;
    for (int w = 0; w < optics::wavelength_count; ++w) sum += reflectance(tables, r, w) * eye.y[static_cast<std::size_t>(w)];
    flat.mean_reflectance.push_back(static_cast<float>(sum / luminance));
  }
  return flat;
}

} // namespace nephroid::spectral
