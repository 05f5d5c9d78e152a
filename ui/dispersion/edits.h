// SPDX-License-Identifier: Apache-2.0
// What a person does to a dispersion: control points are moved, added and removed, a curve becomes control points, a file is loaded.
// No Dear ImGui here.
#pragma once
#include "optics/wavelength.h"
#include "preset/describe_limits.h"
#include "preset/preset.h"
#include "ui/widgets/sorted_rows.h"

#include <optional>
#include <string>
#include <vector>

namespace nephroid::ui {

using ControlPoint = Row; ///< (nm, n)

/// A curve needs two of them.
inline constexpr RowRules point_rules{"control point", preset::index_bounds, 0.5, 2};

/// The dielectrics of a preset: those that objects are made of, in the order of the objects, then the others by name.
std::vector<std::string> dielectrics(const preset::Preset& preset);

/// The one that is shown where `chosen` was asked for: that, else the first; empty where there is none.
std::string shown_dielectric(const preset::Preset& preset, const std::string& chosen);

/// The preset with another dispersion of one of its materials.
preset::Preset with_dispersion(const preset::Preset& preset, const std::string& material, preset::Dispersion dispersion);

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

/// A dispersion of a refractiveindex.info file: a path, or the name of a shipped material ("N-SF66"), for a preset from `preset_source`.
/// Throws bad_input where it cannot be read or has no n at one of the 401 wavelengths.
preset::Dispersion load_file(const std::string& file, const std::string& preset_source);
/// Whether a file's name ends as dispersion data does.
bool is_dispersion_file(const std::string& file);

} // namespace nephroid::ui
