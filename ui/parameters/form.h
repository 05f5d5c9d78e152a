// SPDX-License-Identifier: Apache-2.0
// What the rows of the panel "Parameters" are made of: the draft that they draw, the edits that they ask for, which
// fields are looked for, and the widgets of single values.
#pragma once
#include "preset/outline.h"
#include "ui/parameters/draft.h"
#include "ui/state/context.h"
#include "ui/widgets/file_list.h"
#include "ui/widgets/material_choice.h"

namespace nephroid::ui {

/// The field's value in its object; null where it has none.
const Json& part(const Json& object, const preset::Outline& field);
bool is_changed(const preset::Outline& field, const Json& value);

/// Edits are made once everything is drawn, as what is drawn is the draft.
class Form {
public:
  /// places outlives it.
  Form(const char* panel, WidgetPlaces& places) : gestures(panel), places_(places) {}

  /// live: as command::Edit.
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
  /// Whether any field of the preset is.
  bool finds_any() const;
  /// Whether a field of an object is, which may be an item of `field`.
  bool wants_any(const preset::Outline& field, const Json& object, const std::string& pointer) const;

  /// What has the words that are looked for and is not in the preset: an object of a type that would be made.
  struct Offer {
    std::string name;            ///< "scene.environment: sky"
    std::string help;            ///< a sentence: of the type, or of the field that was looked for
    std::string pointer, made;   ///< where a value is put, and where in it the new object is
    std::function<Json()> value; ///< asked for where it is put
  };
  std::vector<Offer> offers() const;
  /// A line for each field of the sections of other engines that has the words: "environment.extinction, of the engine
  /// environment:
  /// ...".
  std::vector<std::string> of_other_engines() const;

  std::string search; ///< words
  bool only_changed = false;
  Draft draft;
  Gestures gestures;
  TaskQueue* tasks = nullptr;     ///< this frame's, as is
  MaterialBalls* balls = nullptr; ///< this,
  std::string selected;           ///< and the pointer of what is selected
  std::string reveal;             ///< the pointer of a field that is to be brought into sight
  std::optional<Problem> refused; ///< by the run

private:
  /// Adds what there is in an object of these fields.
  void offer_in(const std::vector<preset::Outline>& fields, const Json& object, const std::string& pointer,
                std::vector<Offer>& offers) const;

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

class ValueWidgets {
public:
  /// form outlives it.
  explicit ValueWidgets(Form& form) : form_(form) {}

  /// What a number may be, and how wide its widget is.
  struct Number {
    preset::Bounds bounds;
    bool whole = false;
    float width = 0;
  };
  /// The widget of a leaf, then its unit.
  void draw_value(const preset::Outline& o, const Json& value, const std::string& pointer);
  /// Dragged, or typed after a click. What is no number is a text.
  void draw_number(const Number& number, const Json& value, const std::string& pointer);
  /// A text that is a field's value.
  void draw_text(const std::string& pointer, const Json& value, float width, Json (*read)(const std::string&));
  /// In the row of an object: which type it is, where there are several.
  void draw_type(const preset::Outline& o, const Json& object, const std::string& pointer);
  /// While a text is typed `problem` of it is said. What was typed is there at Enter, or where the keyboard goes
  /// elsewhere.
  std::optional<std::string> type_text(const std::string& id, const std::string& before, float width,
                                       const std::function<std::optional<Problem>(const std::string&)>& problem);
  /// Whose text is being typed, a type_text() id; empty: none. And what is wrong with it.
  const std::string& typed_at() const { return typed_at_; }
  const std::optional<Problem>& wrong() const { return wrong_; }
  const FileList& files() const { return files_; }

private:
  void draw_choice(const std::string& pointer, const std::string& now, const std::vector<preset::Outline::Word>& words,
                   const std::function<void(std::string_view)>& choose, float width);
  void draw_file_choice(const std::string& pointer);
  void draw_shipped_choice(preset::Names names, const Json& value, const std::string& pointer);
  std::string unit_of(const preset::Field& field) const;

  Form& form_;
  FileList files_;
  MaterialChoice shipped_;
  std::string number_typed_;    ///< the number that is a text field in place of one to drag,
  bool number_focused_ = false; ///< and has the keyboard
  std::string typed_at_, typed_;
  std::optional<Problem> wrong_;
};

} // namespace nephroid::ui
