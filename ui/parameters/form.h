// SPDX-License-Identifier: Apache-2.0
// What the rows and the widgets of the panel "Parameters" share: the draft that they draw, the edits that they ask for,
// which fields are looked for, and what a field of the description is to a person.
#pragma once
#include "preset/outline.h"
#include "ui/parameters/draft.h"
#include "ui/state/context.h"
#include "ui/widgets/widgets.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::ui {

/// The field's value in its object; null where it has none.
const Json& part(const Json& object, const preset::Outline& field);
/// Whether it is not as it is by default.
bool is_changed(const preset::Outline& field, const Json& value);

/// Edits are made once everything is drawn, as what is drawn is the draft.
class Form {
public:
  /// places outlives it.
  Form(const char* panel, WidgetPlaces& places) : gestures(panel), places_(places) {}

  /// Asks for a value at a pointer. live: as command::Edit.
  void ask(std::string label, const std::string& pointer, Json value, bool live = false) {
    asked_.push_back({std::move(label), pointer, std::move(value), live});
  }
  void end_gesture() { gesture_ended_ = true; }
  void push_edits(const Context& context);
  void note(const std::string& widget, const std::string& help = {}) { places_.note(widget, help); }
  WidgetPlaces& places() { return places_; }

  bool searching() const { return !search.empty() || only_changed; }
  /// Whether a field is drawn: what is looked for is in it or, in an object, in a field of it.
  bool wants(const preset::Outline& field, const Json& value, const std::string& pointer) const;
  /// Whether a field of an object is, which may be an item of `field`.
  bool wants_any(const preset::Outline& field, const Json& object, const std::string& pointer) const;

  std::string search; ///< words
  bool only_changed = false;
  Draft draft;
  Gestures gestures;
  std::string reveal;             ///< the pointer of a field that is to be brought into sight
  std::optional<Problem> refused; ///< by the run

private:
  struct PendingEdit {
    std::string label, pointer;
    Json value;
    bool live = false;
  };
  WidgetPlaces& places_;
  std::vector<PendingEdit> asked_;
  bool gesture_ended_ = false;
};

/// What is wrong elsewhere because of an edit is said where the edit was made.
const std::string& shown_at(const Problem& problem);

} // namespace nephroid::ui
