// SPDX-License-Identifier: Apache-2.0
#include "photons/effort/effort.h"

#include "photons/effort/importance.h"
#include "tracing/omissions.h"
#include "tracing/scales.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <string_view>

namespace nephroid::photons {
namespace {

using Choice = Settings::Effort;

/// A way to allocate work: what it goes by, and the plan's sentence for it.
struct Strategy {
  /// light: what the eye makes of it; wavelength: how much each matters; alike: every cluster that has light
  enum class By { light, wavelength, alike };
  Choice choice;
  By by;
  std::string_view reason;
};
constexpr Strategy strategies[] = {
    {Choice::automatic, Strategy::By::light,
     "photons are allocated by the variance that is measured while that gains enough, else by what the eye makes of "
     "each cluster's light"},
    {Choice::power, Strategy::By::light, "photons are allocated by what the eye makes of each cluster's light"},
    {Choice::variance, Strategy::By::light,
     "photons are allocated by the variance that is measured: spectral.effort is variance"},
    {Choice::importance, Strategy::By::wavelength, "clusters matter by light, luminosity and surroundings (4.15)"},
    {Choice::radziszewski, Strategy::By::wavelength, "clusters matter by 1 / cosh^2(0.0072 (lambda - 538))"},
    {Choice::equal, Strategy::By::alike, "every cluster has the same work: spectral.effort is equal"},
    {Choice::random, Strategy::By::alike, "each pass has one cluster, drawn at random: spectral.effort is random"},
};

/// The strategy of the settings. Layers, tiles and progressive photon mapping measure no variance.
const Strategy& strategy_of(const Settings& settings) {
  const bool measures = !settings.relight && settings.estimator != Settings::Estimator::sppm &&
                        settings.estimator != Settings::Estimator::tiles;
  const Choice choice = settings.effort == Choice::automatic && !measures ? Choice::power : settings.effort;
  return *std::ranges::find(strategies, choice, &Strategy::choice);
}

/// Weights by power, [light][cluster] flat.
std::vector<double> by_power(const std::vector<double>& watts, const tracing::WavelengthTables& tables) {
  std::vector<double> weights;
  for (std::size_t l = 0; l < watts.size(); ++l)
    for (std::size_t c = 0; c < tables.clusters.size(); ++c)
      weights.push_back(watts[l] * tracing::worth(tables.seen[l][c], tables.share[l][c]));
  return weights;
}

std::vector<double> watts_in_clusters(const std::vector<double>& watts, const tracing::WavelengthTables& tables) {
  std::vector<double> sums(tables.clusters.size(), 0);
  for (std::size_t l = 0; l < watts.size(); ++l)
    for (std::size_t c = 0; c < sums.size(); ++c) sums[c] += watts[l] * tables.share[l][c];
  return sums;
}

/// Each cluster's importance, shared by the lights in proportion to their watts in it.
std::vector<double> by_importance(const std::vector<double>& importance, const std::vector<double>& watts,
                                  const tracing::WavelengthTables& tables) {
  const std::vector<double> sums = watts_in_clusters(watts, tables);
  std::vector<double> weights;
  for (std::size_t l = 0; l < watts.size(); ++l)
    for (std::size_t c = 0; c < sums.size(); ++c)
      weights.push_back(sums[c] > 0 ? importance[c] * watts[l] * tables.share[l][c] / sums[c] : 0);
  return weights;
}

/// The sum over lights for each cluster, divided by the largest; 1 where all are 0.
std::vector<double> cluster_sums(const std::vector<double>& weights, std::size_t clusters) {
  std::vector<double> sums(clusters, 0);
  for (std::size_t i = 0; i < weights.size(); ++i) sums[i % clusters] += weights[i];
  const double largest = sums.empty() ? 0 : *std::ranges::max_element(sums);
  for (double& sum : sums) sum = largest > 0 ? sum / largest : 1;
  return sums;
}

bool caustics_are_possible(const scene::Scene& scene, const std::vector<double>& watts) {
  const tracing::ObjectCounts objects = tracing::count_objects(scene);
  return objects.diffuse > 0 && !caustic_objects(scene).empty() &&
         std::ranges::any_of(watts, [](double w) { return w > 0; });
}

/// The plan's words for the fraction of equal work that is left.
std::string work_left(const std::vector<double>& importance) {
  const double sum = std::accumulate(importance.begin(), importance.end(), 0.0);
  return fmt::format("{:.0f} % of the iterations of clusters that all matter alike",
                     100 * sum / static_cast<double>(std::max<std::size_t>(importance.size(), 1)));
}

} // namespace

ClusterShares make_cluster_shares(const Settings& settings, const scene::Scene& scene, const scene::Bvh& bvh,
                                  const std::vector<double>& watts, const tracing::WavelengthTables& tables) {
  const std::size_t clusters = tables.clusters.size();
  const Strategy& strategy = strategy_of(settings);
  if (strategy.by == Strategy::By::light) {
    std::vector<double> weights = by_power(watts, tables);
    std::vector<double> importance = cluster_sums(weights, clusters);
    return {std::move(weights), std::move(importance)};
  }
  std::vector<double> importance(clusters, 1);
  if (strategy.by == Strategy::By::wavelength && caustics_are_possible(scene, watts)) {
    const optics::Spectrum u = wavelength_importance(settings, scene, bvh).u;
    importance = cluster_importance(u, tables.clusters, settings.importance.cluster);
    // Caustics may fall on more than the nine points see, so a cluster with light has a photon a pass, or an iteration.
    constexpr double least = 1e-9;
    const std::vector<double> lit = watts_in_clusters(watts, tables);
    for (std::size_t c = 0; c < clusters; ++c)
      if (lit[c] > 0) importance[c] = std::max(importance[c], least);
  }
  return {by_importance(importance, watts, tables), importance};
}

plan::Decision effort_decision(const Settings& settings, const std::vector<double>& importance) {
  const Strategy& strategy = strategy_of(settings);
  const bool matters = strategy.by == Strategy::By::wavelength;
  if (settings.effort == Choice::importance && !settings.importance.geometry)
    return {"importance", true, "clusters matter by light, luminosity and materials (4.15): " + work_left(importance)};
  return {"importance", matters,
          matters ? fmt::format("{}: {}", strategy.reason, work_left(importance)) : std::string(strategy.reason)};
}

} // namespace nephroid::photons
