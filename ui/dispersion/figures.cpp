// SPDX-License-Identifier: Apache-2.0
#include "ui/dispersion/figures.h"

#include "spectral/clusters/clusters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::ui {
namespace {

/// theta2 = asin(sin theta1 / n) at theta1 = 45 degrees; 90 degrees beyond the critical angle.
double angle_at_45_deg(double n) { return std::asin(std::min(1.0, std::numbers::sqrt2 / 2 / n)) * 180 / std::numbers::pi; }

double mean_angle_deg(double n) { return spectral::refraction_integral_deg2(n) / spectral::last_angle_deg; }

/// angle: of refraction, as a function of n, falling.
template <class Angle>
Spread spread_of(const spectral::Clustering& clustering, const optics::Spectrum& n, Angle angle)
{
  Spread spread;
  for (const spectral::Cluster& cluster : clustering.clusters) {
    const double highest = n[static_cast<std::size_t>(cluster.wavelengths.front())];
    const double lowest = n[static_cast<std::size_t>(cluster.wavelengths.back())];
    if (highest == lowest) continue;
    const double inside = std::max(0.0, angle(lowest) - angle(highest));
    spread.greatest_deg = std::max(spread.greatest_deg, inside);
    spread.mean_deg += inside * static_cast<double>(cluster.wavelengths.size()) / optics::wavelength_count;
  }
  return spread;
}

} // namespace

ClusterFigures figures_of(spectral::Clustering clustering, const optics::Spectrum& n)
{
  ClusterFigures figures;
  figures.saving = static_cast<double>(optics::wavelength_count) / static_cast<double>(clustering.clusters.size());
  figures.at_45 = spread_of(clustering, n, angle_at_45_deg);
  figures.over_angles = spread_of(clustering, n, mean_angle_deg);
  figures.clustering = std::move(clustering);
  return figures;
}

std::array<std::size_t, optics::wavelength_count> cluster_of_wavelengths(const spectral::Clustering& clustering)
{
  std::array<std::size_t, optics::wavelength_count> cluster_of{};
  for (std::size_t c = 0; c < clustering.clusters.size(); ++c)
    for (const int index : clustering.clusters[c].wavelengths) cluster_of[static_cast<std::size_t>(index)] = c;
  return cluster_of;
}

std::vector<Band> bands_of(const spectral::Clustering& clustering)
{
  const auto cluster_of = cluster_of_wavelengths(clustering);
  std::vector<Band> bands;
  for (int i = 0; i < optics::wavelength_count; ++i) {
    const std::size_t cluster = cluster_of[static_cast<std::size_t>(i)];
    if (bands.empty() || bands.back().cluster != cluster) bands.push_back({i, i, cluster});
    bands.back().last = i;
  }
  return bands;
}

} // namespace nephroid::ui
