// SPDX-License-Identifier: Apache-2.0
// The shipped metals or glasses, to choose from by words. The keyboard alone is enough: type, up and down, Enter.
#pragma once
#include "scatter/spectra.h"
#include "ui/state/tasks.h"
#include "ui/widgets/widgets.h"

namespace nephroid::ui {

class MaterialChoice {
public:
  enum class Kind { metal, glass };

  /// Draws a button that opens the list. Returns the name that is chosen in this frame. now: what is
  /// chosen already. places has "WIDGET:shipped", and of the open list "WIDGET:words" and "WIDGET:NAME".
  std::optional<std::string> draw(const std::string& widget, Kind kind, const std::string& now, TaskQueue& tasks,
                                  WidgetPlaces& places);

private:
  void begin(TaskQueue& tasks);
  std::optional<std::string> draw_list(const std::string& widget, Kind kind, const std::string& now,
                                       WidgetPlaces& places);

  std::string words_;
  std::size_t marked_ = 0; ///< among those that have the words
  std::vector<scatter::ShippedMaterial> shipped_;
  bool was_read_ = false;
  TaskKey reading_;
};

} // namespace nephroid::ui
