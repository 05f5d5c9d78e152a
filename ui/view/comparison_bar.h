// SPDX-License-Identifier: Apache-2.0
// The View's row of comparison: what is compared with, flip, difference and its metric; and the colour scale of a map of differences.
#pragma once
#include "measure/difference.h"
#include "ui/state/commands.h"
#include "ui/view/placement.h"

#include <string>

namespace nephroid::ui {

class Workbench;
struct ShownDifference;

/// "CIELAB distance"
const char* metric_name(measure::DifferenceMetric metric);
/// "Reference", or the pinned run's name in quotes.
std::string other_name(const Workbench& workbench);
/// "CIELAB distance to the reference"
std::string difference_label(const Workbench& workbench);

void draw_comparison_bar(const Workbench& workbench, Commands& commands);
/// Along the canvas' right edge, numbers at its left.
void draw_colour_scale(const ShownDifference& map, const Canvas& canvas);

} // namespace nephroid::ui
