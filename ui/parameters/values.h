// SPDX-License-Identifier: Apache-2.0
// The widgets of single values in the panel "Parameters".
#pragma once
#include "ui/parameters/form.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid::ui {

/// A list of the files beside the preset, from where other folders are reached.
class FileChoice {
public:
  /// A button in the line of what was drawn last.
  void draw(Form& form, const std::string& pointer);

private:
  void enter(const std::filesystem::path& folder);

  std::string folder_;             ///< that is shown,
  std::vector<std::string> files_; ///< and what is in it
};

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

private:
  void draw_choice(const std::string& pointer, const std::string& now, const std::vector<preset::Outline::Word>& words,
                   const std::function<void(std::string_view)>& choose, float width);
  std::string unit_of(const preset::Field& field) const;

  Form& form_;
  FileChoice file_choice_;
  std::string number_typed_;    ///< the number that is a text field in place of one to drag,
  bool number_focused_ = false; ///< and has the keyboard
  std::string typed_at_, typed_;
  std::optional<Problem> wrong_;
};

} // namespace nephroid::ui
