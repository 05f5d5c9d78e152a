// SPDX-License-Identifier: Apache-2.0
#include "photons/clusters/scene_clusters.h"

#include "photons/clusters/clusters.h"
#include "tracing/wavelength_tables.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nephroid::photons {
namespace {

/// Groups of `step` neighbouring wavelengths; the last group has the rest.
std::vector<std::vector<int>> neighbours(int step) {
  std::vector<std::vector<int>> groups;
  for (int w = 0; w < optics::wavelength_count; ++w) {
    if (w % step == 0) groups.emplace_back();
    groups.back().push_back(w);
  }
  return groups;
}

/// The clusters of scene_clusters by refraction alone.
std::vector<std::vector<int>> refraction_clusters(const Settings& settings, const scene::Scene& scene) {
  std::vector<optics::Spectrum> curves;
  for (const scene::Object& object : scene.objects) {
    const scatter::Material& material = material_of(scene, object);
    if (!is_refractive(material.type)) continue;
    if (std::ranges::find(curves, material.n) == curves.end()) curves.push_back(material.n);
  }
  if (!curves.empty() && settings.method == ClusterMethod::brute_force) return neighbours(settings.step_nm);
  std::vector<Clustering> clusterings;
  for (const optics::Spectrum& curve : curves)
    clusterings.push_back(cluster_wavelengths(curve, settings.threshold_deg, settings.method));
  return common_refinement(clusterings);
}

/// The diagonal of the box about all objects of a material, in metres.
double diagonal_m(const scene::Scene& scene, std::size_t material) {
  scene::Bounds bounds;
  for (const scene::Object& object : scene.objects)
    if (static_cast<std::size_t>(object.material) == material)
      bounds = scene::enclosing(bounds, scene::bounds_of(scene, object));
  return bounds.low.x <= bounds.high.x ? glm::length(bounds.high - bounds.low) * scene.metres_per_unit : 0;
}

/// Splits a cluster by rising coefficient: a new part begins where the difference to the first of the part gets too
/// large. No split has fewer parts (packed_from_the_left in clusters.cpp says why).
void split(std::vector<int> cluster, const std::vector<double>& coefficients, double longest, double most,
           std::vector<std::vector<int>>& parts) {
  const auto a = [&](int w) { return coefficients[static_cast<std::size_t>(w)]; };
  std::ranges::stable_sort(cluster, [&](int v, int w) { return a(v) < a(w); });
  auto first = cluster.begin();
  while (first != cluster.end()) {
    const auto end =
        std::find_if(first, cluster.end(), [&](int w) { return largest_difference(a(*first), a(w), longest) > most; });
    parts.emplace_back(first, end);
    std::sort(parts.back().begin(), parts.back().end());
    first = end;
  }
}

} // namespace

std::vector<std::vector<int>> scene_clusters(const Settings& settings, const scene::Scene& scene) {
  std::vector<std::vector<int>> clusters = refraction_clusters(settings, scene);
  if (settings.relight)
    return split_by_losses(std::move(clusters), scene, settings.max_surfaces, largest_loss_difference);
  const bool stretches = settings.estimator == Settings::Estimator::tiles ||
                         (settings.jitter && settings.estimator != Settings::Estimator::sppm);
  if (stretches && tracing::stretch_parameter(scene) == tracing::StretchParameter::wavelength)
    clusters = tracing::split_into_runs(clusters);
  return clusters;
}

double largest_difference(double a, double b, double longest) {
  if (a == b) return 0;
  // The difference rises up to the s where its derivative is 0: a exp(-a s) = b exp(-b s).
  const double s = a > 0 && b > 0 ? std::min(std::log(b / a) / (b - a), longest) : longest;
  return std::abs(std::exp(-a * s) - std::exp(-b * s));
}

std::vector<std::vector<int>> split_by_losses(std::vector<std::vector<int>> clusters, const scene::Scene& scene,
                                              int reflections, double most) {
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    const bool used = std::ranges::any_of(
        scene.objects, [&](const scene::Object& object) { return static_cast<std::size_t>(object.material) == m; });
    if (!used) continue;
    for (const auto& [coefficients, longest] :
         {std::pair(scatter::loss_inside(scene.materials[m]), 2 * diagonal_m(scene, m)),
          std::pair(scatter::loss_at_surface(scene.materials[m]), double(reflections))}) {
      if (coefficients.empty()) continue;
      std::vector<std::vector<int>> parts;
      for (std::vector<int>& cluster : clusters) split(std::move(cluster), coefficients, longest, most, parts);
      clusters = std::move(parts);
    }
  }
  return clusters;
}

} // namespace nephroid::photons
