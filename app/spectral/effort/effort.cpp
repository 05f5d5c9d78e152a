// SPDX-License-Identifier: Apache-2.0
#include "spectral/effort/effort.h"

#include "spectral/effort/importance.h"
#include "tracing/omissions.h"
#include "tracing/worth.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace nephroid::spectral {
namespace {

using Choice = Settings::Effort;

/// [light][cluster] flat.
std::vector<double> by_power(const std::vector<double>& watts, const tracing::WavelengthTables& tables)
{
  std::vector<double> weights;
  for (std::size_t l = 0; l < watts.size(); ++l)
    for (std::size_t c = 0; c < tables.clusters.size(); ++c)
      weights.push_back(watts[l] * tracing::worth(tables.seen[l][c], tables.share[l][c]));
  return weights;
}

/// Of each cluster.
std::vector<double> watts_in_clusters(const std::vector<double>& watts, const tracing::WavelengthTables& tables)
{
  std::vector<double> sums(tables.clusters.size(), 0);
  for (std::size_t l = 0; l < watts.size(); ++l)
    for (std::size_t c = 0; c < sums.size(); ++c) sums[c] += watts[l] * tables.share[l][c];
  return sums;
}

/// Each cluster's importance, shared by the lights in proportion to their watts in it.
std::vector<double> by_importance(const std::vector<double>& importance, const std::vector<double>& watts,
                                  const tracing::WavelengthTables& tables)
{
  const std::vector<double> all = watts_in_clusters(watts, tables);
  std::vector<double> weights;
  for (std::size_t l = 0; l < watts.size(); ++l)
    for (std::size_t c = 0; c < all.size(); ++c) weights.push_back(all[c] > 0 ? importance[c] * watts[l] * tables.share[l][c] / all[c] : 0);
  return weights;
}

/// Of each cluster the sum over lights, divided by the largest; 1 where all are 0.
std::vector<double> cluster_sums(const std::vector<double>& weights, std::size_t clusters)
{
  std::vector<double> sums(clusters, 0);
  for (std::size_t i = 0; i < weights.size(); ++i) sums[i % clusters] += weights[i];
  const double largest = sums.empty() ? 0 : *std::max_element(sums.begin(), sums.end());
  for (double& sum : sums) sum = largest > 0 ? sum / largest : 1;
  return sums;
}

bool caustics_are_possible(const scene::Scene& scene, const std::vector<double>& watts)
{
  const tracing::ObjectCounts objects = tracing::count_objects(scene);
  return objects.diffuse > 0 && !caustic_objects(scene).empty() && std::any_of(watts.begin(), watts.end(), [](double w) { return w > 0; });
}

/// What of the work of equal clusters is done.
std::string work_left(const std::vector<double>& importance)
{
  const double sum = std::accumulate(importance.begin(), importance.end(), 0.0);
  return fmt::format("{:.0f} % of the iterations of clusters that all matter alike",
                     100 * sum / static_cast<double>(std::max<std::size_t>(importance.size(), 1)));
}

} // namespace

Effort make_effort(const Settings& settings, const scene::Scene& scene, const scene::Bvh& bvh, const std::vector<double>& watts,
                   const tracing::WavelengthTables& tables)
{
  const std::size_t clusters = tables.clusters.size();
  if (settings.effort == Choice::power || settings.effort == Choice::variance) {
    std::vector<double> weights = by_power(watts, tables);
    std::vector<double> importance = cluster_sums(weights, clusters);
    return {std::move(weights), std::move(importance)};
  }
  std::vector<double> importance(clusters, 1);
  if ((settings.effort == Choice::importance || settings.effort == Choice::radziszewski) && caustics_are_possible(scene, watts)) {
    const optics::Spectrum u = wavelength_importance(settings, scene, bvh).u;
    importance = cluster_importance(u, tables.clusters, settings.importance.cluster);
    // What the nine points see is not all that caustics fall on. So that the picture is right on average, a cluster with light has at
    // least one photon a pass, or one iteration of all.
    constexpr double least = 1e-9;
    const std::vector<double> lit = watts_in_clusters(watts, tables);
    for (std::size_t c = 0; c < clusters; ++c)
      if (lit[c] > 0) importance[c] = std::max(importance[c], least);
  }
  return {by_importance(importance, watts, tables), importance};
}

plan::Pass effort_pass(const Settings& settings, const std::vector<double>& importance)
{
  switch (settings.effort) {
  case Choice::importance:
    return {"importance", true,
            fmt::format("clusters matter by light, luminosity{} (4.15): {}",
                        settings.importance.geometry ? " and surroundings" : " and materials", work_left(importance))};
  case Choice::radziszewski:
    return {"importance", true, "clusters matter by 1 / cosh^2(0.0072 (lambda - 538)): " + work_left(importance)};
  case Choice::power:
    return {"importance", false, "photons are dealt out by what the eye makes of each cluster's light: spectral.effort is power"};
  case Choice::variance:
    return {"importance", false, "photons are dealt out by the variance that is measured: spectral.effort is variance"};
  case Choice::equal:
    return {"importance", false, "every cluster has the same work: spectral.effort is equal"};
  case Choice::random:
    break;
  }
  return {"importance", false, "each pass has one cluster, drawn at random: spectral.effort is random"};
}

} // namespace nephroid::spectral
