// SPDX-License-Identifier: Apache-2.0
#include "ui/spectral/dispersion/edits.h"

#include "optics/dispersion.h"

#include <algorithm>
#include <cmath>

namespace nephroid::ui {

ControlPoint readable_point(const ControlPoint& point) { return {std::round(point[0] * 100) / 100, std::round(point[1] * 1e6) / 1e6}; }

std::vector<ControlPoint> sorted_points(const preset::Dispersion& dispersion)
{
  if (dispersion.type != preset::Dispersion::Type::points) return {};
  return sorted_rows(dispersion.table);
}

preset::Dispersion with_points(const preset::Dispersion& before, std::vector<ControlPoint> points)
{
  preset::Dispersion dispersion;
  dispersion.type = preset::Dispersion::Type::points;
  dispersion.table = std::move(points);
  dispersion.outside = before.outside;
  return dispersion;
}

ControlPoint snapped(ControlPoint point, ControlPoint step)
{
  for (std::size_t i = 0; i < 2; ++i)
    if (step[i] > 0) point[i] = std::round(point[i] / step[i]) * step[i];
  return point;
}

FittedPoints fit_points(const optics::Spectrum& n, double tolerance, std::size_t most)
{
  const auto point = [&](int index) {
    // Seven decimals are as much as any table has.
    const double value = std::round(n[static_cast<std::size_t>(index)] * 1e7) / 1e7;
    return ControlPoint{static_cast<double>(optics::wavelength_nm(index)),
                        std::clamp(value, preset::index_bounds.low, preset::index_bounds.high)};
  };
  FittedPoints fitted;
  fitted.points = {point(0), point(optics::wavelength_count - 1)};
  while (true) {
    const optics::Spectrum fitted_n = optics::sample_n(optics::control_points(fitted.points), optics::Outside::hold);
    int worst = 0;
    fitted.greatest_deviation = 0;
    for (int i = 0; i < optics::wavelength_count; ++i) {
      const double deviation = std::fabs(fitted_n[static_cast<std::size_t>(i)] - n[static_cast<std::size_t>(i)]);
      if (deviation > fitted.greatest_deviation) fitted.greatest_deviation = deviation, worst = i;
    }
    if (fitted.greatest_deviation <= tolerance || fitted.points.size() >= std::max<std::size_t>(most, 2)) return fitted;
    if (!add_row(fitted.points, point(worst), point_rules)) return fitted; // it is a point already: nothing gets better
  }
}

} // namespace nephroid::ui
