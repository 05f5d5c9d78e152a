// SPDX-License-Identifier: Apache-2.0
// From linear light to the bytes that a display shows: the one way for image.png, frames, reports and the window. In
// this order: white balance, exposure, tone curve, gamut, sRGB encoding. Colours that sRGB has and that are not above 1
// keep their bytes but for a white balance or a filmic curve.
//
// The tone curve is of the largest channel, and the others follow in proportion, which keeps the hue.
//   reinhard: L (1 + L / W^2) / (1 + L) with L = (x - k) / (1 - k) above the knee k = .6 (Reinhard et al. 2002,
//     "Photographic Tone Reproduction for Digital Images", (4)); x below it stays. W is of the picture's peak, which
//     becomes 1; a peak of 1 leaves everything as it is.
//   filmic: f(2 x) / f(11.2), f(x) = (x (A x + C B) + D E) / (x (A x + B) + D F) - E / F with A .15, B .5, C .1, D .2,
//     E .02, F .3 (J. Hable, "Uncharted 2: HDR Lighting", GDC 2010): 0 at 0, 1 at 5.6 and above.
// The gamut mapping oklch makes a colour that has a channel below 0 or above 1 less colourful with the same lightness
// and hue in OKLab (B. Ottosson, "A perceptual color space for image processing", 2020), until sRGB has it, as CSS
// Color 4, 13.2, does, though to the edge itself: no clipping follows.
#pragma once
#include "preset/preset.h"

#include <array>
#include <span>

namespace nephroid::image {

/// How pictures are shown; as it is made: linear sRGB, clipped and encoded.
struct Display {
  preset::Display::Gamut gamut = preset::Display::Gamut::clip;
  preset::Display::Tone tone = preset::Display::Tone::clip;
  /// From linear sRGB to the same, rows one after the other; the identity is left out.
  std::array<float, 9> white_balance{1, 0, 0, 0, 1, 0, 0, 0, 1};
  bool operator==(const Display&) const = default;
};

/// The same, for a picture with its exposure.
struct Showing {
  Display display;
  float scale = 1; ///< the exposure, a factor
  float peak = 1;  ///< reinhard: what becomes 1, of exposed channels; at least 1
  bool operator==(const Showing&) const = default;
};

/// rgb: linear sRGB, 3 a pixel. The peak is the largest channel that a ten-thousandth of the pixels is above.
Showing showing_of(const Display& display, double exposure_stops, std::span<const float> rgb);

/// rgb: linear sRGB, 3 a pixel; bytes: as many pixels, of 3 or, with an alpha of 255, of 4 bytes. NaN is shown as 0.
void show(std::span<const float> rgb, const Showing& showing, std::span<unsigned char> bytes);

/// The same before the encoding: channels of 0..1.
std::array<float, 3> displayed(std::array<float, 3> rgb, const Showing& showing);

/// The byte of one linear channel: clipped to 0..1, sRGB-encoded. NaN is 0.
unsigned char shown(float linear);

} // namespace nephroid::image
