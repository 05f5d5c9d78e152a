// SPDX-License-Identifier: Apache-2.0
// The panel "Parameters": every field of the preset, drawn and edited by its description (preset/outline.h), so that a
// new field is here by itself. What is impossible is said at its field and waits (draft.h), while the run goes on as it
// was.
#pragma once
#include "ui/parameters/form.h"
#include "ui/widgets/material_picture.h"
#include "ui/widgets/panel.h"

namespace nephroid::ui {

/// Where a preset has its materials.
inline constexpr const char* materials_pointer = "/scene/materials";

/// A row a field (rows.cpp), and the rows of what has any number of items: lists, maps and tables (items.cpp).
class FieldRows {
public:
  /// form outlives it.
  explicit FieldRows(Form& form) : form_(form) {}

  /// Inside of a table of two columns.
  void draw_fields(const std::vector<preset::Outline>& fields, const Json& object, const std::string& pointer);
  /// The help of the field that was under the mouse last; empty: none was.
  const std::string& help() const { return help_; }
  const FileList& files() const { return values_.files(); }

private:
  void draw_field(const preset::Outline& o, const Json& value, const std::string& pointer);
  /// The left cell of a new row. True where a branch is open: TreePop() after its rows.
  bool draw_label(const std::string& label, const std::string& pointer, bool leaf, bool changed);
  void draw_menu(const preset::Outline& o, const Json& value, const std::string& pointer);
  void draw_given(const preset::Outline& o, const Json& value, const std::string& pointer);
  void draw_reset(const preset::Outline& o, const Json& value, const std::string& pointer);
  /// with_inner: also what is wrong further inside.
  void draw_problem(const std::string& pointer, bool with_inner);
  void draw_picture(const std::string& material, const std::string& pointer);

  void draw_add(const preset::Outline& o, const Json& value, const std::string& pointer);
  void draw_items(const preset::Outline& o, const Json& value, const std::string& pointer);
  void draw_rows(const preset::Outline& o, const Json& value, const std::string& pointer);
  void draw_name(const Json& items, const std::string& name, const std::string& pointer);
  void draw_item_buttons(const Json& items, const std::string& key, const std::string& pointer);
  void rename(const std::string& map, const std::string& name, const std::string& to);

  Form& form_;
  ValueWidgets values_{form_};
  MaterialPictures pictures_;
  std::string help_;
};

class ParametersPanel : public Panel {
public:
  static constexpr const char* title = "Parameters";
  void draw(const Context& context) override;

  /// For tests: what waits. Widgets have places: "/scene/camera/fov_deg" is a field's own, "/scene/lights:add",
  /// "/white:reset" and so on are buttons, "search" is the box at the top.
  const Draft& draft() const { return form_.draft; }
  const FileList& files() const { return rows_.files(); }

private:
  void follow_run(const Context& context);
  void draw_top();
  void draw_offers(const Context& context, const std::vector<Form::Offer>& offers);

  Form form_{title, places_};
  FieldRows rows_{form_};
  std::shared_ptr<const preset::Preset> opened_; ///< last; with another one the search is over
  Selection revealed_;                           ///< what was selected when its fields were brought into sight last
};

} // namespace nephroid::ui
