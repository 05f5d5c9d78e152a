// SPDX-License-Identifier: Apache-2.0
// The rows of the panel "Parameters": a row a field, with what can be done about it; and of what has any number of
// items.
#pragma once
#include "ui/parameters/values.h"

#include <string>
#include <vector>

namespace nephroid::ui {

class FieldRows;

/// Lists and maps of objects, tables, lists of numbers and of texts.
class ItemRows {
public:
  /// All outlive it.
  ItemRows(Form& form, ValueWidgets& values, FieldRows& rows) : form_(form), values_(values), rows_(rows) {}
  /// In the row of a list: how many it has, and one more.
  void draw_add(const preset::Outline& o, const Json& value, const std::string& pointer);
  /// The objects of a list or a map, a branch each.
  void draw_items(const preset::Outline& o, const Json& value, const std::string& pointer);
  /// A table's rows, or the numbers or texts of a list.
  void draw_rows(const preset::Outline& o, const Json& value, const std::string& pointer);

private:
  void draw_name(const Json& items, const std::string& name, const std::string& pointer);
  void draw_item_buttons(const Json& items, const std::string& key, const std::string& pointer);
  void rename(const std::string& map, const std::string& name, const std::string& to);

  Form& form_;
  ValueWidgets& values_;
  FieldRows& rows_;
};

class FieldRows {
public:
  /// form outlives it.
  explicit FieldRows(Form& form) : form_(form) {}

  /// Inside of a table of two columns.
  void draw_fields(const std::vector<preset::Outline>& fields, const Json& object, const std::string& pointer);
  /// The left cell of a new row. True where a branch is open: TreePop() after its rows.
  bool draw_label(const std::string& label, const std::string& pointer, bool leaf, bool changed);
  /// with_inner: also what is wrong further inside.
  void draw_problem(const std::string& pointer, bool with_inner);
  /// The help of the field that was under the mouse last; empty: none was.
  const std::string& help() const { return help_; }

private:
  void draw_field(const preset::Outline& o, const Json& value, const std::string& pointer);
  void draw_menu(const preset::Outline& o, const Json& value, const std::string& pointer);
  void draw_given(const preset::Outline& o, const Json& value, const std::string& pointer);
  void draw_reset(const preset::Outline& o, const Json& value, const std::string& pointer);

  Form& form_;
  ValueWidgets values_{form_};
  ItemRows items_{form_, values_, *this};
  std::string help_;
};

} // namespace nephroid::ui
