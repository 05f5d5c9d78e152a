// SPDX-License-Identifier: Apache-2.0
#include "photons/relight/layer_light.h"

#include "photons/effort/emitters.h"
#include "scatter/spectra.h"
#include "tracing/scales.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace nephroid::photons {
namespace {

using optics::Colour;

std::size_t reflectors(const tracing::WavelengthTables& tables) {
  return static_cast<std::size_t>(tables.reflector_count);
}

double reflectance(const tracing::WavelengthTables& tables, std::size_t reflector, int wavelength) {
  return static_cast<double>(
      tables.reflectance[reflector * optics::wavelength_count + static_cast<std::size_t>(wavelength)]);
}

/// What the eye makes of each cluster of a light of 1 W.
std::vector<double> cluster_worth(const optics::Spectrum& spectrum, const tracing::WavelengthTables& tables) {
  const optics::ColourMatching& eye = optics::cie_1931();
  std::vector<double> sums;
  for (const std::vector<int>& cluster : tables.clusters) {
    double& sum = sums.emplace_back(0);
    for (const int index : cluster) {
      const auto w = static_cast<std::size_t>(index);
      sum += tracing::worth(spectrum[w] * (eye.x[w] + eye.y[w] + eye.z[w]) / 3, spectrum[w]);
    }
  }
  return sums;
}

/// Divides half of the work by the parts and half evenly. Parts that are `never` get nothing.
std::vector<double> half_evenly(std::vector<double> parts, const std::vector<bool>& never) {
  const double total = std::accumulate(parts.begin(), parts.end(), 0.0);
  const auto count = static_cast<double>(std::ranges::count(never, false));
  for (std::size_t i = 0; i < parts.size(); ++i)
    parts[i] = never[i] ? 0 : (total > 0 ? parts[i] / total : 0) + 1 / count;
  return parts;
}

scene::Scene with_unit_lights(const scene::Scene& scene) {
  scene::Scene unit = scene;
  for (scene::Light& light : unit.lights)
    (preset::has(light.type, LIGHT_HAS_IRRADIANCE) ? light.irradiance_w_m2 : light.power_w) = 1;
  return unit;
}

} // namespace

double LayerLight::strongest() const {
  const double most = power.empty() ? 0 : *std::ranges::max_element(power);
  return most > 0 ? most : 1;
}

LayerLight layer_light(const scene::Scene& scene, double white) {
  LayerLight light;
  for (const scene::Light& l : scene.lights) {
    light.spectra.push_back(l.spectrum);
    light.power.push_back(scene::radiometric(l));
  }
  light.white = white;
  return light;
}

LayerLight layer_light(const preset::Preset& preset) {
  LayerLight light;
  for (std::size_t i = 0; i < preset.scene.lights.size(); ++i) {
    const preset::Light& l = preset.scene.lights[i];
    light.spectra.push_back(
        scatter::make_light_spectrum(l.spectrum, Location(preset.source) / "scene" / "lights" / i / "spectrum"));
    light.power.push_back(preset::radiometric(l));
  }
  if (preset.scene.environment)
    if (const auto sun = scene::make_sun(*preset.scene.environment)) {
      light.spectra.push_back(sun->spectrum);
      light.power.push_back(sun->irradiance_w_m2);
    }
  light.white = preset.white.value_or(1);
  return light;
}

LayerWeights layer_weights(const LayerLight& light, const tracing::WavelengthTables& tables) {
  const optics::ColourMatching& eye = optics::cie_1931();
  LayerWeights weights;
  for (std::size_t l = 0; l < light.spectra.size(); ++l) {
    std::vector<Colour> whole(reflectors(tables), Colour{});
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
        for (std::size_t k = 0; k < 3; ++k) whole[r][k] += weights.clusters.back()[k];
      }
    weights.whole.insert(weights.whole.end(), whole.begin(), whole.end());
  }
  return weights;
}

void add_radiance(const LayerLight& light, const tracing::WavelengthTables& tables, std::size_t light_index,
                  int cluster, int reflector, double value, std::vector<double>& radiance) {
  const auto add = [&](int index) {
    const auto w = static_cast<std::size_t>(index); // the grid has one wavelength a nanometre
    radiance[w] += value * light.power[light_index] * light.spectra[light_index][w] *
                   reflectance(tables, static_cast<std::size_t>(reflector), index);
  };
  if (cluster >= 0)
    for (const int w : tables.clusters[static_cast<std::size_t>(cluster)]) add(w);
  else
    for (int w = 0; w < optics::wavelength_count; ++w) add(w);
}

FlatLight flat_light(const tracing::WavelengthTables& tables) {
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
    for (int w = 0; w < optics::wavelength_count; ++w)
      sum += reflectance(tables, r, w) * eye.y[static_cast<std::size_t>(w)];
    flat.mean_reflectance.push_back(static_cast<float>(sum / luminance));
  }
  return flat;
}

std::vector<shared::DeviceEmitter> layer_emitters(const LayerLight& light, const RunTables& tables, unsigned photons) {
  const std::vector<std::vector<int>>& clusters = tables.wavelengths.clusters;
  std::vector<PhotonSource> sources;
  std::vector<double> parts;
  std::vector<bool> never;
  for (std::size_t l = 0; l < light.spectra.size(); ++l) {
    const std::vector<double> worth = cluster_worth(light.spectra[l], tables.wavelengths);
    for (std::size_t c = 0; c < clusters.size(); ++c) {
      double share = 0;
      for (const int w : clusters[c]) share += light.spectra[l][static_cast<std::size_t>(w)];
      sources.push_back({0, static_cast<int>(l), static_cast<int>(c), share * light.power[l] / light.strongest()});
      parts.push_back(tables.towards_targets_w[l] * light.power[l] * worth[c]);
      never.push_back(!(tables.towards_targets_w[l] > 0));
    }
  }
  parts = half_evenly(std::move(parts), never);
  for (std::size_t i = 0; i < sources.size(); ++i) sources[i].weight = parts[i];
  return make_emitters(sources, photons);
}

std::vector<float> layer_cluster_cdf(const LayerLight& light, const tracing::WavelengthTables& tables) {
  std::vector<double> parts(tables.clusters.size(), 0);
  for (std::size_t l = 0; l < light.spectra.size(); ++l) {
    const std::vector<double> worth = cluster_worth(light.spectra[l], tables);
    for (std::size_t c = 0; c < parts.size(); ++c) parts[c] += light.power[l] * worth[c];
  }
  parts = half_evenly(std::move(parts), std::vector<bool>(tables.clusters.size(), false));
  return exact_cdf_from_zero(parts);
}

double layer_energy_scale(const LayerLight& light, const RunTables& tables) {
  double watts = 0;
  for (std::size_t l = 0; l < light.power.size(); ++l) watts += tables.towards_targets_w[l] * light.power[l];
  return tracing::energy_scale(watts);
}

RunTables make_run_tables(const preset::Preset& preset, const Settings& settings, const scene::Scene& scene,
                          const scene::Bvh& bvh, tracing::LeaveOut leave_out) {
  if (!settings.relight) return make_lit_tables(settings, scene, bvh, leave_out);
  leave_out.dark_lights = leave_out.unlit_wavelengths = false;
  RunTables tables = make_lit_tables(settings, with_unit_lights(scene), bvh, leave_out);
  const LayerLight light = layer_light(scene, preset.white.value_or(1));
  tables.emitters = layer_emitters(light, tables, static_cast<unsigned>(settings.photons_per_pass));
  tables.photons_per_batch = count_photons(tables.emitters);
  tables.scene.emitter_count = static_cast<int>(tables.emitters.size());
  tables.wavelengths.cluster_cdf = layer_cluster_cdf(light, tables.wavelengths);
  tables.energy_scale = layer_energy_scale(light, tables);
  return tables;
}

} // namespace nephroid::photons
