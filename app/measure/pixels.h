// SPDX-License-Identifier: Apache-2.0
// What every comparison checks of its pictures and its mask before it starts.
#pragma once
#include "measure/metrics.h"

namespace nephroid::measure {

/// Throws bad_input naming the picture and the pixel (column, row; 0, 0 is the top left) where a value is NaN or infinite, and failed
/// where the values do not fit the size.
void check_pixels(const Pixels& picture);
/// Throws bad_input where the sizes differ.
void check_same_size(const Pixels& picture, int width, int height, const std::string& reference_name);
/// Throws bad_input where the mask (its name is for messages) is of another size or no pixel counts.
void check_mask(Mask mask, int width, int height, const std::string& name = "mask");

inline bool counts(Mask mask, std::size_t pixel) { return mask.empty() || mask[pixel] != 0; }

} // namespace nephroid::measure
