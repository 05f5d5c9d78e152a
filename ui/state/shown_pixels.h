// SPDX-License-Identifier: Apache-2.0
// A linear picture as the bytes a display shows: the same bytes as image::shown, by a table instead of a search a channel, because
// the window does this for every snapshot and for every move of the exposure slider.
#pragma once
#include <span>

namespace nephroid::ui {

/// The same byte as image::shown(linear, exposure_scale). NaN is shown as image::shown shows 0.
unsigned char shown_byte(float linear, float exposure_scale);

/// rgb: 3 a pixel; rgba8: 4 a pixel, alpha 255. The sizes must match.
void shown_pixels(std::span<const float> rgb, double exposure_stops, std::span<unsigned char> rgba8);

} // namespace nephroid::ui
