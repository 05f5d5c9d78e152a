// SPDX-License-Identifier: Apache-2.0
#include "spectral/clusters/scene_clusters.h"

#include "spectral/clusters/clusters.h"
#include "spectral/clusters/losses.h"
#include "tracing/stretch.h"

#include <algorithm>
#include <utility>

namespace nephroid::spectral {
namespace {

/// Neighbouring wavelengths, `step` in a group, the last group with what is left.
std::vector<std::vector<int>> neighbours(int step)
{
  std::vector<std::vector<int>> groups;
  for (int w = 0; w < optics::wavelength_count; ++w) {
    if (w % step == 0) groups.emplace_back();
    groups.back().push_back(w);
  }
  return groups;
}

/// As scene_clusters, by refraction alone.
std::vector<std::vector<int>> refraction_clusters(const Settings& settings, const scene::Scene& scene)
{
  std::vector<optics::Spectrum> curves;
  for (const scene::Object& object : scene.objects) {
    const scene::Material& material = material_of(scene, object);
    if (material.type != scene::Material::Type::dielectric) continue;
    if (std::find(curves.begin(), curves.end(), material.n) == curves.end()) curves.push_back(material.n);
  }
  if (!curves.empty() && settings.method == ClusterMethod::brute_force) return neighbours(settings.step_nm);
  std::vector<Clustering> clusterings;
  for (const optics::Spectrum& curve : curves) clusterings.push_back(cluster_wavelengths(curve, settings.threshold_deg, settings.method));
  return common_refinement(clusterings);
}

} // namespace

std::vector<std::vector<int>> scene_clusters(const Settings& settings, const scene::Scene& scene)
{
  std::vector<std::vector<int>> clusters = refraction_clusters(settings, scene);
  if (settings.relight) return split_by_losses(std::move(clusters), scene, settings.max_surfaces, largest_loss_difference);
  if (settings.differentials && tracing::stretch_parameter(scene) == tracing::StretchParameter::wavelength)
    clusters = tracing::split_into_runs(clusters);
  return clusters;
}

} // namespace nephroid::spectral
