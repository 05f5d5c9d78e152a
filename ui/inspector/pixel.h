// SPDX-License-Identifier: Apache-2.0
// What there is to say of one pixel: its values in the run's picture, in each of its layers, in what it is compared with, and how far off
// the reference is; and its spectrum as text.
#pragma once
#include "job/spectrum.h"
#include "ui/state/context.h"

namespace nephroid::ui {

struct PixelRow {
  std::string name;            ///< "this run", "caustic", ...
  std::array<float, 3> rgb{};  ///< linear, over the preset's white
  double luminance = 0;        ///< W/m^2/sr
  std::array<double, 3> lab{}; ///< 1 is white
  bool is_colour = true;       ///< false of a difference or an error, which has no Lab
};

/// Empty where there is no picture or the pixel is not in it.
std::vector<PixelRow> pixel_rows(const Context& context, const std::array<int, 2>& pixel);
/// With tabs between, under a line of names.
std::string pixel_as_text(const Context& context, const std::array<int, 2>& pixel);
/// A wavelength a row, a layer a column, then their sum.
std::string spectrum_as_csv(const job::PixelSpectrum& spectrum);
/// The sum of the layers, one a wavelength.
std::vector<double> total_radiance(const job::PixelSpectrum& spectrum);

} // namespace nephroid::ui
