// SPDX-License-Identifier: Apache-2.0
// Converts linear pictures to a display's bytes: as image.png shows them (image/display.h), or the luminance in false
// colour.
#pragma once
#include "image/display.h"
#include "ui/state/commands.h"

namespace nephroid::ui {

/// As run::display_of; of D65 where the lamp has no spectrum: its run says why.
image::Display display_of(const preset::Preset& preset);

struct Tone {
  image::Showing showing;
  std::optional<LuminanceRange> false_colour = {}; ///< its range, where it is shown
  double white = 1; ///< preset::Preset::white: W/m^2/sr of luminance 1; 1 but in false colour
  bool operator==(const Tone&) const = default;
};
/// display: the preset's. rgb: the picture, which gives the peak and the automatic range.
Tone tone_of(const ViewSettings& view_settings, const image::Display& display, double white,
             std::span<const float> rgb);

/// The range from the 1 % quantile of the luminances above 0 to the 99.9 % quantile, widened to round numbers (1, 2, 5
/// times a power of ten); a decade at least, 8 decades at most. 0.01 .. 1 where no pixel is above 0.
LuminanceRange automatic_range(std::span<const float> rgb, double white);
/// The nearest valid range of false colour: finite, 1e-30 at least, high above low. Nothing where there is none, as
/// with NaN.
std::optional<LuminanceRange> valid_range(const LuminanceRange& range);

/// Colours that the map of false colour does not have, sRGB-encoded.
using Rgb8 = std::array<unsigned char, 3>;
inline constexpr Rgb8 nan_colour{0, 255, 0}, infinite_colour{0, 255, 255}, negative_colour{40, 90, 255};
/// The colour of a luminance in W/m^2/sr: measure::map_colour, which is perceptually uniform, over its logarithm. 0 has
/// the low end's colour.
Rgb8 luminance_colour(double luminance, const LuminanceRange& range);

/// rgb: 3 values per pixel; rgba8: 4 bytes per pixel, alpha 255. The sizes must match. In false colour a pixel with a
/// NaN or infinite channel has its own colour, and so has one with a negative luminance. Single channels may be
/// negative where a colour lies outside of sRGB.
void toned_pixels(std::span<const float> rgb, const Tone& tone, std::span<unsigned char> rgba8);

} // namespace nephroid::ui
