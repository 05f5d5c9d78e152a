// SPDX-License-Identifier: Apache-2.0
#include "spectral/tables/indirect_tables.h"

#include "spectral/effort/emitters.h"
#include "tracing/exact_cdf.h"
#include "tracing/scales.h"
#include "tracing/targets.h"
#include "tracing/worth.h"

#include <numeric>

namespace nephroid::spectral {
namespace {

/// Of each wavelength of a light.
std::vector<double> wavelength_worth(const tracing::WavelengthTables& tables, std::size_t light)
{
  std::vector<double> weights;
  for (const int w : tables.cluster_wavelengths) {
    const shared::float4& xyz = tables.light_xyz[light * WAVELENGTH_COUNT + static_cast<std::size_t>(w)];
    weights.push_back(tracing::worth((double(xyz.x) + xyz.y + xyz.z) / 3, xyz.w));
  }
  return weights;
}

} // namespace

IndirectTables make_indirect_tables(const scene::Scene& scene, const RunTables& tables, unsigned photons)
{
  IndirectTables result;
  const scene::Sphere all = tracing::everything(scene);
  result.everything.centre_radius = {all.centre.x, all.centre.y, all.centre.z, all.radius};
  result.outside_distance = 2.5f * all.radius;
  std::vector<PhotonSource> sources;
  for (std::size_t l = 0; l < tables.lights.size(); ++l) {
    const scene::Light& light = scene.lights[static_cast<std::size_t>(tables.lights[l].number)];
    const double watts = tracing::towards_targets_w(light, {all}, scene.metres_per_unit);
    const std::vector<double> weights = wavelength_worth(tables.wavelengths, l);
    sources.push_back({watts * std::accumulate(weights.begin(), weights.end(), 0.0), static_cast<int>(l), 0, 0});
    result.emitted_w += watts;
    const std::vector<float> cdf = tracing::exact_cdf(weights);
    result.spectrum_cdf.insert(result.spectrum_cdf.end(), cdf.begin(), cdf.end());
  }
  result.emitters = make_emitters(sources, photons);
  result.photons_per_pass = count_photons(result.emitters);
  result.film_scale = tracing::splat_scale(scene, result.photons_per_pass, result.emitted_w);
  result.energy_scale = tracing::energy_scale(result.emitted_w);
  return result;
}

} // namespace nephroid::spectral
