// SPDX-License-Identifier: Apache-2.0
// The Inspector's tables and its histogram.
#pragma once
#include "ui/inspector/pixel.h"
#include "ui/inspector/region.h"

namespace nephroid::ui {

void draw_pixel_table(const std::vector<PixelRow>& rows);
/// A table a picture, and how many pixels are no ordinary ones.
void draw_region_tables(const RegionStatistics& statistics);
/// Pixels over their luminance, both logarithmic.
void draw_histogram(const RegionStatistics& statistics);

} // namespace nephroid::ui
