// SPDX-License-Identifier: Apache-2.0
#include "ui/environment/lights.h"

#include "ui/state/tone.h"

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace nephroid::ui {
namespace {

Colour colour_of(const glm::dvec3& flux)
{
  const double most = std::max({flux.x, flux.y, flux.z});
  if (!(most > 0)) return {};
  const auto byte = [&](double value) { return shown_byte(static_cast<float>(value / most)); };
  return {byte(flux.x), byte(flux.y), byte(flux.z)};
}

} // namespace

std::vector<RegionFigures> figures_of(const environment::Segmentation& segmentation, double radiance, double rotate_deg,
                                      const std::vector<double>& visible)
{
  const double total = environment::luminance(segmentation.total_flux);
  std::vector<RegionFigures> figures;
  for (const auto* regions : {&segmentation.lights, &segmentation.dropped})
    for (const environment::Region& region : *regions) {
      const glm::dvec3 d = environment::turned(region.direction, rotate_deg);
      const double flux = environment::luminance(region.flux);
      RegionFigures of_region;
      of_region.flux = radiance * flux;
      of_region.share = total > 0 ? flux / total : 0;
      of_region.azimuth_deg = glm::degrees(std::atan2(d.x, -d.z));
      of_region.elevation_deg = glm::degrees(std::asin(std::clamp(d.y, -1.0, 1.0)));
      of_region.solid_angle_sr = region.solid_angle_sr;
      of_region.colour = colour_of(region.flux);
      if (figures.size() < visible.size()) of_region.occluded = 1 - visible[figures.size()];
      figures.push_back(of_region);
    }
  return figures;
}

std::vector<double> visible_shares(const job::Snapshot& snapshot, std::size_t lights)
{
  for (const job::Curve& curve : snapshot.curves) {
    if (curve.name != "lights" || curve.rows.size() != lights) continue;
    const auto column = std::find(curve.columns.begin(), curve.columns.end(), "visible");
    if (column == curve.columns.end()) continue;
    std::vector<double> shares;
    for (const std::vector<double>& row : curve.rows) {
      const double share = row.at(static_cast<std::size_t>(column - curve.columns.begin()));
      if (!(share >= 0 && share <= 1)) return {};
      shares.push_back(share);
    }
    return shares;
  }
  return {};
}

double dragged_rotation(double start_deg, double across, MapLayout layout)
{
  const double turned_deg = start_deg + (layout == MapLayout::cube ? 360 : -360) * across;
  return std::round(10 * std::remainder(turned_deg, 360.0)) / 10;
}

} // namespace nephroid::ui
