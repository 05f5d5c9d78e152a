// SPDX-License-Identifier: Apache-2.0
// The View's row of comparison: what is compared with, flip, difference and its metric; and the colour scale of a map of differences.
#pragma once
#include "measure/difference.h"
#include "ui/state/context.h"
#include "ui/view/placement.h"

#include <string>

namespace nephroid::ui {

/// "CIELAB distance"
const char* metric_name(measure::DifferenceMetric metric);
/// "Reference", or the pinned run's name in quotes.
std::string other_name(const Context& context);
/// "CIELAB distance to the reference"
std::string difference_label(const Context& context);

void draw_comparison_bar(const Context& context);
/// Along the canvas' right edge, numbers at its left.
void draw_colour_scale(const ShownDifference& map, const Canvas& canvas);

} // namespace nephroid::ui
