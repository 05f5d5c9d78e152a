// SPDX-License-Identifier: Apache-2.0
// The View's row of what is selected: its name and a list to choose from, the tools that move it, and the list of camera bookmarks.
#pragma once
#include "ui/state/context.h"
#include "ui/widgets/widgets.h"

namespace nephroid::ui {

/// Nothing where the preset has no scene. places: of the widgets, for tests: "selected", "cameras" and, in the list of bookmarks,
/// "go 0", "name 0", "delete 0" and so on.
void draw_selection_bar(const Context& context, WidgetPlaces& places);

} // namespace nephroid::ui
