// SPDX-License-Identifier: Apache-2.0
// The View's rows of widgets above its picture. places: of widgets, for tests.
#pragma once
#include "measure/difference.h"
#include "ui/state/context.h"
#include "ui/state/tone.h"
#include "ui/widgets/widgets.h"

namespace nephroid::ui {

/// "CIELAB distance"
const char* metric_name(measure::DifferenceMetric metric);
/// "Reference", or the pinned run's name in quotes.
std::string other_name(const Context& context);

/// What is shown and how: layer, tone curve, the range of false colour. tone: that of the picture that is shown.
void draw_look_bar(const Context& context, const Tone& tone, WidgetPlaces& places);
/// What is compared with, flip, difference and its metric.
void draw_comparison_bar(const Context& context);
/// What is selected: its name and a list to choose from, the tools that move it, and the list of camera bookmarks. Nothing where the preset
/// has no scene. places: "selected", "cameras" and, in the list of bookmarks, "go 0", "name 0", "delete 0" and so on.
void draw_selection_bar(const Context& context, WidgetPlaces& places);
/// An edit of the preset that is open, where its camera is another. index: of Chosen::bookmarks.
void go_to_bookmark(const Context& context, std::size_t index);

} // namespace nephroid::ui
