// SPDX-License-Identifier: Apache-2.0
// The directions of a goniometer's cells. make_meter (meter.cpp) makes them.
#include "scene/meter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::scene {

GammaC direction_of(const MeterSurface& goniometer, std::size_t cell) {
  const glm::dvec3 way = glm::normalize(goniometer.centres[cell] - goniometer.middle) * goniometer.directions;
  constexpr double degrees = 180 / std::numbers::pi;
  const double c = std::atan2(way.y, way.x) * degrees;
  return {std::acos(std::clamp(way.z, -1.0, 1.0)) * degrees, c < 0 ? c + 360 : c};
}

double at_direction(const MeterSurface& goniometer, const std::vector<double>& values, const GammaC& direction) {
  const double gamma = direction.gamma_deg * std::numbers::pi / 180, c = direction.c_deg * std::numbers::pi / 180;
  const glm::dvec3 way =
      goniometer.directions * glm::dvec3(std::sin(gamma) * std::cos(c), std::sin(gamma) * std::sin(c), std::cos(gamma));
  const MeterChart& chart = *std::ranges::max_element(
      goniometer.charts, {}, [&](const MeterChart& of) { return -glm::dot(of.normal(), way); });
  const glm::dvec3 place = goniometer.middle + way * ((chart.height - glm::dot(goniometer.middle, chart.normal())) /
                                                      glm::dot(way, chart.normal()));
  // At a face's edge it goes on straight for half a cell.
  const double x = (glm::dot(place, chart.right) - chart.left) / chart.cell_width - 0.5,
               y = (chart.top - glm::dot(place, chart.up)) / chart.cell_height - 0.5;
  const int column = std::clamp(static_cast<int>(std::floor(x)), 0, std::max(chart.columns - 2, 0)),
            row = std::clamp(static_cast<int>(std::floor(y)), 0, std::max(chart.rows - 2, 0));
  double sum = 0;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      const int to_row = std::min(row + i, chart.rows - 1), to_column = std::min(column + j, chart.columns - 1);
      const int cell = goniometer.cells[chart.first + chart.place(to_row, to_column)];
      sum += (i == 0 ? 1 - (y - row) : y - row) * (j == 0 ? 1 - (x - column) : x - column) *
             values[static_cast<std::size_t>(cell)];
    }
  return std::max(sum, 0.0);
}

} // namespace nephroid::scene
