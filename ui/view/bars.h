// SPDX-License-Identifier: Apache-2.0
// What surrounds the View's picture: rows of widgets above it (places: theirs, for tests), a few words over it, and
// colour scales with numbers along its right edge.
#pragma once
#include "measure/difference.h"
#include "ui/state/context.h"
#include "ui/view/placement.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/widgets.h"

namespace nephroid::ui {

/// The metric's name: "CIELAB distance".
const char* metric_name(measure::DifferenceMetric metric);

/// Which pictures are compared, how they were read, and a line per metric with its meaning, separated by tabs; "-"
/// where it has no value (yet). Empty where nothing is measured.
std::string metrics_as_text(const Context& context);

/// Draws the choice of layer, the preset's `display`, and false colour with its range. tone: the shown picture's.
void draw_view_bar(const Context& context, const Tone& tone, WidgetPlaces& places);
/// Draws what is shown, what it is compared with, and how. places: "shown" and "other".
void draw_comparison_bar(const Context& context, WidgetPlaces& places);
/// Draws the distances between the two in a line, where they are wanted; all metrics are under the mouse. places:
/// "metrics".
void draw_metrics(const Context& context, WidgetPlaces& places);
/// Draws what is selected, the tools that move it, and bookmarks of cameras, where the preset has a scene. places:
/// "selected", "cameras" and, in the list of bookmarks, "go 0", "name 0", "delete 0" and so on.
void draw_selection_bar(const Context& context, WidgetPlaces& places);
/// Draws which frame is shown, and what plays and records the film, where the preset has an animation. places: "frame",
/// "frame number".
void draw_time_bar(const Context& context, WidgetPlaces& places);
/// Edits the preset in hand, where its camera differs from the bookmark. index: into ViewState::bookmarks.
void go_to_bookmark(const Context& context, std::size_t index);

/// Draws lines of text on a dark ground, with the upper left corner at `at`.
void draw_overlay(const ImVec2& at, const std::string& text);
/// Draws the scale of luminance in W/m^2/sr, and the colours of values that are no luminance.
void draw_luminance_scale(const LuminanceRange& range, const Canvas& canvas);
void draw_difference_scale(const ShownDifference& map, const Canvas& canvas);

} // namespace nephroid::ui
