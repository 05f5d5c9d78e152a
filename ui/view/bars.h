// SPDX-License-Identifier: Apache-2.0
// What stands about the View's picture: rows of widgets above it (places: of widgets, for tests), and over it a few
// words, and scales of colours with their numbers along its right edge.
#pragma once
#include "measure/difference.h"
#include "ui/state/comparing.h"
#include "ui/state/context.h"
#include "ui/state/tone.h"
#include "ui/view/placement.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/widgets.h"

namespace nephroid::ui {

/// "CIELAB distance"
const char* metric_name(measure::DifferenceMetric metric);

/// Which pictures are compared, how they were read, and every metric with its meaning, a line each with tabs between;
/// "-" where there is none (yet). Empty where nothing is measured.
std::string metrics_as_text(const Context& context);

/// What is shown and how: layer, tone curve, the range of false colour. tone: that of the picture that is shown.
void draw_view_bar(const Context& context, const Tone& tone, WidgetPlaces& places);
/// What is shown, what it is compared with, and how: flip, split, side by side, difference and its metric. places:
/// "shown" and "other".
void draw_comparison_bar(const Context& context, WidgetPlaces& places);
/// How far the two pictures are from each other, where that is wanted: a line; all metrics under the mouse. places:
/// "metrics".
void draw_metrics(const Context& context, WidgetPlaces& places);
/// What is selected: its name and a list to choose from, the tools that move it, and the list of camera bookmarks.
/// Nothing where the preset has no scene. places: "selected", "cameras" and, in the list of bookmarks, "go 0", "name
/// 0", "delete 0" and so on.
void draw_selection_bar(const Context& context, WidgetPlaces& places);
/// An edit of the preset that is open, where its camera is another. index: of ViewState::bookmarks.
void go_to_bookmark(const Context& context, std::size_t index);

/// Lines of text on a dark ground, its upper left corner at `at`.
void draw_overlay(const ImVec2& at, const std::string& text);
/// Luminance in W/m^2/sr, and the colours of what is no luminance.
void draw_luminance_scale(const LuminanceRange& range, const Canvas& canvas);
/// Of a map of differences.
void draw_difference_scale(const ShownDifference& map, const Canvas& canvas);

} // namespace nephroid::ui
