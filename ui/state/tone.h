// SPDX-License-Identifier: Apache-2.0
// Linear pictures as the bytes a display shows, by the tone curve of a look: as image.png has it, filmic, or the
// luminance in false colour.
#pragma once
#include "ui/state/commands.h"

#include <array>
#include <optional>
#include <span>

namespace nephroid::ui {

/// The filmic curve of J. Hable, "Uncharted 2: HDR Lighting" (GDC 2010), f(2 x) / f(11.2) with
/// f(x) = (x (A x + C B) + D E) / (x (A x + B) + D F) - E / F and A .15, B .5, C .1, D .2, E .02, F .3: 0 at 0, 1
/// at 5.6, clipped above. For each channel, before the sRGB encoding.
double filmic(double linear);

/// A look, ready for a picture.
struct Tone {
  ToneCurve curve = ToneCurve::standard;
  double exposure_stops = 0; ///< 0 in false colour
  LuminanceRange range;      ///< of false colour
  double white = 1;          ///< preset::Preset::white: W/m^2/sr of luminance 1; 1 but in false colour
  bool operator==(const Tone&) const = default;
};
/// rgb: the picture, for the automatic range.
Tone tone_of(const ViewSettings& view_settings, double white, std::span<const float> rgb);

/// From the luminance that 1 % of the pixels are below to the one that 99.9 % are, of those above 0, widened to round
/// numbers (1, 2, 5 times a power of ten) and to a decade at least, 8 decades at most. 0.01 .. 1 where no pixel is
/// above 0.
LuminanceRange automatic_range(std::span<const float> rgb, double white);
/// The nearest range that false colour can have: finite, 1e-30 at least, high above low. Nothing where there is none,
/// as with NaN.
std::optional<LuminanceRange> valid_range(const LuminanceRange& range);

/// Colours that the map of false colour does not have, sRGB-encoded.
using Rgb8 = std::array<unsigned char, 3>;
inline constexpr Rgb8 nan_colour{0, 255, 0}, infinite_colour{0, 255, 255}, negative_colour{40, 90, 255};
/// Of a luminance in W/m^2/sr: measure::map_colour, which is perceptually uniform, over its logarithm. 0 is as the low
/// end.
Rgb8 luminance_colour(double luminance, const LuminanceRange& range);

/// rgb: 3 a pixel; rgba8: 4 a pixel, alpha 255. The sizes must match. In false colour a pixel with a channel that is
/// NaN or infinite has that colour, and so has one whose luminance is negative; channels may be negative where a colour
/// lies outside of sRGB.
void toned_pixels(std::span<const float> rgb, const Tone& tone, std::span<unsigned char> rgba8);

/// The same byte as image::shown(linear, 1), by a table. NaN is shown as image::shown shows 0.
unsigned char shown_byte(float linear);

} // namespace nephroid::ui
