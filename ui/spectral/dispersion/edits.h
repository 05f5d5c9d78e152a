// SPDX-License-Identifier: Apache-2.0
// What a person does to a dispersion: control points are moved, added and removed, a curve becomes control points.
// No Dear ImGui here.
#pragma once
#include "optics/wavelength.h"
#include "preset/field.h"
#include "preset/preset.h"
#include "ui/widgets/rows.h"

#include <vector>

namespace nephroid::ui {

using ControlPoint = Row; ///< (nm, n)

/// In figures that a person can read in the preset, finer than a pixel.
ControlPoint readable_point(const ControlPoint& point);
/// A curve needs two of them.
inline constexpr RowRules point_rules{"control point", preset::index_bounds, 0.5, 2, readable_point};

/// By rising wavelength, as the functions below have them.
std::vector<ControlPoint> sorted_points(const preset::Dispersion& dispersion);
/// Control points, nothing else of `before` but its rule for wavelengths outside.
preset::Dispersion with_points(const preset::Dispersion& before, std::vector<ControlPoint> points);
/// The nearest place on a grid.
ControlPoint snapped(ControlPoint point, ControlPoint step);

struct FittedPoints {
  std::vector<ControlPoint> points;
  double greatest_deviation = 0; ///< of n at the 401 wavelengths
};
/// Few control points whose monotone cubic comes to within `tolerance` of n, at most `most` (>= 2): from both ends on, one more where
/// the deviation is greatest.
FittedPoints fit_points(const optics::Spectrum& n, double tolerance = 1e-4, std::size_t most = 40);

} // namespace nephroid::ui
