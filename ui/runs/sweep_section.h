// SPDX-License-Identifier: Apache-2.0
// The part of the panel "Runs" that edits the preset's sweep and shows its runs as they are worked off: which fields
// can be swept, and the values that a person gives them, a range or a list that is typed.
#pragma once
#include "preset/field.h"
#include "preset/preset.h"
#include "ui/state/context.h"
#include "ui/widgets/widgets.h"

namespace nephroid::ui {

struct NumberField {
  std::string key; ///< as for --set
  bool whole = false;
  preset::Bounds bounds;
  std::string sentence; ///< for a person
  std::string expected; ///< "a number from 0 to 1 W"
  double value = 0;     ///< now; of a field that is left out the lowest it may be, or 0
};

/// Every field of the preset that holds one number and that --set can name, in the order of the file.
std::vector<NumberField> number_fields(const preset::Preset& preset);

struct SweepRange {
  double from = 0, to = 1;
  int count = 5; ///< values, both ends among them
  bool logarithmic = false;
};

/// Each as JSON. Throws bad_input at the field's key: no value or more than 10000, an end that the field may not have
/// or that is no number, ends that a logarithm has not, values that are equal.
std::vector<std::string> range_values(const NumberField& field, const SweepRange& range);
/// Reads numbers with commas or spaces between, typed as for --set. Throws as range_values.
std::vector<std::string> typed_values(const NumberField& field, const std::string& text);

class SweepSection {
public:
  /// Notes widgets as "sweep field", "field KEY" of the open list, "sweep from", "sweep to", "sweep count", "sweep
  /// log", "sweep range", "sweep list" (the choice), "sweep values" (the text), "sweep set", "edit KEY", "remove KEY",
  /// "sweep run".
  void draw(const Context& context, WidgetPlaces& places);
  /// For tests: why what was typed cannot be swept.
  const std::string& problem() const { return problem_; }

private:
  void draw_fields(const Context& context, WidgetPlaces& places);
  void draw_choice(WidgetPlaces& places);
  void draw_values(const Context& context, WidgetPlaces& places);
  void draw_queue(const Context& context);
  void choose(const NumberField& field);
  void set(const Context& context);
  const NumberField* chosen() const;

  std::shared_ptr<const preset::Preset> of_; ///< the preset of fields_
  std::vector<NumberField> fields_;
  std::string filter_, key_; ///< words that filter the fields; the chosen key
  SweepRange range_;
  bool typed_ = false; ///< values are a list that is typed, else a range
  std::string text_;   ///< that list
  std::string problem_;
  std::string in_sight_;  ///< the run of the queue that was scrolled to
  bool was_empty_ = true; ///< in the last frame there was nothing to show
};

} // namespace nephroid::ui
