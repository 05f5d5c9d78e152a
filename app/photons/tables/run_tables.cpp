// SPDX-License-Identifier: Apache-2.0
#include "photons/tables/run_tables.h"

#include "lights/lights.h"
#include "photons/clusters/scene_clusters.h"
#include "photons/effort/effort.h"
#include "photons/effort/emitters.h"
#include "scene/meter.h"
#include "tracing/omissions.h"
#include "tracing/scales.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace nephroid::photons {
namespace {

using std::numbers::pi;

/// Two batches make the halves of a preview, so they are short: some 15 ms on two cores.
unsigned batches_per_pass(const Settings& settings) {
  constexpr int photons_a_batch = 1 << 13, most = 32;
  if (settings.relight || settings.estimator == Settings::Estimator::sppm) return 1;
  const auto batches = static_cast<unsigned>(std::clamp(settings.photons_per_pass / photons_a_batch, 1, most));
  // Rounds of 2, 2, 4, 8, ... batches end with passes.
  return settings.estimator == Settings::Estimator::tiles ? std::max(std::bit_floor(batches), 4u) : batches;
}

/// weights is ClusterShares::photons.
std::vector<PhotonSource> photon_sources(const std::vector<double>& weights, const tracing::WavelengthTables& tables) {
  std::vector<PhotonSource> sources;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const std::size_t l = i / tables.clusters.size(), c = i % tables.clusters.size();
    sources.push_back({weights[i], static_cast<int>(l), static_cast<int>(c), tables.share[l][c]});
  }
  return sources;
}

/// From a light to the nearest cell of a meter, which may be far outside of the scene; 0 without a meter.
double nearest_cell(const scene::Scene& scene, const scene::Light& light) {
  if (!scene.camera.meter) return 0;
  double nearest = std::numeric_limits<double>::max();
  for (const glm::dvec3& centre : scene.camera.meter->centres)
    nearest = std::min(nearest, glm::distance(centre, glm::dvec3(light.position)));
  return nearest;
}

/// A surface that the light reaches from the scene's radius, or a meter outside of it, gets 2^24 quanta of the direct
/// film, and a lamp's own surface 2^40 at most, which no sample of it exceeds. The limit is one that the samples of a
/// pixel cannot exceed together: with 64 of them 2^56, which a lamp at 1 / 65000 of the radius reaches.
void set_scales(const scene::Scene& scene, int samples, RunTables& tables) {
  const double metres = scene.metres_per_unit, radius = tracing::scene_bounds(scene).radius;
  tables.caustic_scale = tracing::splat_scale(scene, tables.photons_per_batch, tables.light_towards_targets_w);
  double irradiance = 0;
  for (const scene::Light& light : scene.lights) {
    const double distance = std::max<double>(radius, nearest_cell(scene, light));
    irradiance += light.irradiance_w_m2 + light.power_w / (4 * pi * std::pow(distance * metres, 2));
  }
  for (const shared::DeviceLight& light : tables.lights)
    if (light.type == LIGHT_MESH && !(scene.camera.meter && scene.camera.meter->is_goniometer())) // its cells are far
      irradiance = std::max(irradiance,
                            light.radiometric * tables.power_unit / (light.as.mesh.area * metres * metres) * 0x1p-16);
  tables.direct_scale = tracing::power_of_two_below(std::exp2(24) * pi / irradiance);
  tables.direct_limit = std::exp2(62) / samples;
  tables.energy_scale = tracing::energy_scale(tables.light_towards_targets_w);
}

/// Whether paths from the eye bring the environment's even light, where it is not too little for its own rays.
bool takes_even_sky(const Settings& settings, const scene::Scene& scene, const tracing::SceneTables& tables) {
  constexpr double least_part = 0.05;
  return (settings.caustic || settings.indirect.value_or(false)) && !settings.relight &&
         settings.estimator != Settings::Estimator::sppm && tables.sky && 1 - tables.sky->peak_part >= least_part &&
         !tables.spheres.empty() && tracing::count_objects(scene).diffuse > 0;
}

void leave_peaks_to_photons(RunTables& tables) {
  tables.has_even_sky = true;
  const auto light = tables.lights.end() - 1; // the environment
  light->as.environment.mean_colour = tables.sky->peak_colour;
  tables.towards_targets_w[static_cast<std::size_t>(light - tables.lights.begin())] *=
      tables.sky->size.has_peaks ? tables.sky->peak_part : 0;
  tables.light_towards_targets_w =
      std::accumulate(tables.towards_targets_w.begin(), tables.towards_targets_w.end(), 0.0);
}

} // namespace

int pixel_samples(const Settings& settings, const scene::Scene& scene) {
  const bool all_points =
      std::ranges::none_of(scene.lights, [](const scene::Light& light) { return lights::has_places(light); });
  return settings.pixel_samples.value_or(all_points ? 64 : 4096);
}

RunTables make_lit_tables(const Settings& settings, const scene::Scene& scene, const scene::Bvh& bvh,
                          const tracing::LeaveOut& leave_out) {
  RunTables tables;
  static_cast<tracing::SceneTables&>(tables) =
      tracing::make_scene_tables(scene, scene_clusters(settings, scene), leave_out);
  if (takes_even_sky(settings, scene, tables)) leave_peaks_to_photons(tables);
  ClusterShares shares = make_cluster_shares(settings, scene, bvh, tables.towards_targets_w, tables.wavelengths);
  tables.batches = batches_per_pass(settings);
  tables.emitters = make_emitters(photon_sources(shares.photons, tables.wavelengths),
                                  static_cast<unsigned>(settings.photons_per_pass) / tables.batches);
  tables.importance = std::move(shares.importance);
  tables.photons_per_batch = count_photons(tables.emitters);
  tables.scene.max_surfaces = settings.max_surfaces;
  tables.scene.emitter_count = static_cast<int>(tables.emitters.size());
  set_scales(scene, pixel_samples(settings, scene), tables);
  return tables;
}

} // namespace nephroid::photons
