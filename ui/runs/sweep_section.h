// SPDX-License-Identifier: Apache-2.0
// The part of the panel "Runs" that edits the preset's sweep and shows its runs as they are worked off.
#pragma once
#include "ui/runs/sweep_values.h"
#include "ui/state/context.h"
#include "ui/widgets/widgets.h"

#include <memory>
#include <string>
#include <vector>

namespace nephroid::ui {

class SweepSection {
public:
  /// Notes widgets as "sweep field", "field KEY" of the open list, "sweep from", "sweep to", "sweep count", "sweep log", "sweep range",
  /// "sweep list" (the choice), "sweep values" (the text), "sweep set", "edit KEY", "remove KEY", "sweep run".
  void draw(const Context& context, WidgetPlaces& places);
  /// For tests: why what was typed cannot be swept.
  const std::string& problem() const { return problem_; }

private:
  void follow(const Context& context);
  void draw_fields(const Context& context, WidgetPlaces& places);
  void draw_choice(WidgetPlaces& places);
  void draw_values(const Context& context, WidgetPlaces& places);
  void draw_queue(const Context& context);
  void choose(const NumberField& field);
  void set(const Context& context);
  const NumberField* chosen() const;

  std::shared_ptr<const preset::Preset> of_; ///< what fields_ are of
  std::vector<NumberField> fields_;
  std::string filter_, key_; ///< of the field that is chosen
  SweepRange range_;
  bool typed_ = false; ///< values are a list that is typed, else a range
  std::string text_;   ///< that list
  std::string problem_;
  std::string in_sight_;  ///< the run of the queue that was scrolled to
  bool was_empty_ = true; ///< in the last frame there was nothing to show
};

} // namespace nephroid::ui
