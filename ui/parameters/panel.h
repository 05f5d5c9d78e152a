// SPDX-License-Identifier: Apache-2.0
// The panel "Parameters": every field of the preset, drawn and edited by its description (preset/outline.h), so that a new field is here
// by itself. What is impossible is said at its field and waits (draft.h), while the run goes on as it was.
#pragma once
#include "preset/outline.h"
#include "ui/parameters/draft.h"
#include "ui/widgets/panel.h"

namespace nephroid::ui {

class ParametersPanel : public Panel {
public:
  static constexpr const char* title = "Parameters";
  void draw(const Context& context) override;

  /// For tests: what waits, and the middle of a widget on the screen: "/scene/camera/fov_deg" is a field's own, "/scene/lights:add",
  /// "/white:reset" and so on are buttons, "search" is the box at the top. Nothing where it is not drawn.
  const Draft& draft() const { return draft_; }

private:
  using Outline = preset::Outline;
  using Fields = std::vector<Outline>;
  using Problems = std::map<std::string, Problem>;

  /// An edit that a widget asks for; made once everything is drawn, as what is drawn is the draft.
  struct PendingEdit {
    std::string label, pointer;
    Json value;
    bool live = false;
  };
  /// What a number may be, and how wide its widget is.
  struct Number {
    preset::Bounds bounds;
    bool whole = false;
    float width = 0;
  };

  // panel.cpp: the panel and its rows
  void follow_run(const Context& context);
  void draw_top();
  void draw_fields(const Fields& fields, const Json& object, const std::string& pointer);
  void draw_field(const Outline& o, const Json& value, const std::string& pointer);
  bool draw_label(const std::string& label, const std::string& pointer, bool leaf, bool changed);
  void draw_menu(const Outline& o, const Json& value, const std::string& pointer);
  void draw_given(const Outline& o, const Json& value, const std::string& pointer);
  void draw_reset(const Outline& o, const Json& value, const std::string& pointer);
  void draw_problem(const std::string& pointer, bool all);
  bool is_wanted(const Outline& o, const Json& value, const std::string& pointer) const;
  bool any_wanted(const Outline& o, const Json& object, const std::string& pointer) const;
  bool is_searching() const { return !search_.empty() || only_changed_; }
  static std::string shown_at(const Problem& problem);
  void ask(std::string label, const std::string& pointer, Json value, bool live = false);
  void carry_out(const Context& context);
  void note(const std::string& widget, const std::string& help = {}) { places_.note(widget, help); }

  // values.cpp: a field's own widget
  void draw_value(const Outline& o, const Json& value, const std::string& pointer);
  void draw_number(const Number& number, const Json& value, const std::string& pointer);
  void draw_choice(const std::string& pointer, const std::string& now, const std::vector<Outline::Word>& words,
                   const std::function<void(std::string_view)>& choose, float width);
  void draw_type(const Outline& o, const Json& object, const std::string& pointer);
  void draw_file_choice(const std::string& pointer);
  std::optional<std::string> type_text(const std::string& id, const std::string& before, float width,
                                       const std::function<std::optional<Problem>(const std::string&)>& problem);
  void draw_text(const std::string& pointer, const Json& value, float width, Json (*read)(const std::string&));
  std::string unit_of(const preset::Field& field) const;

  // items.cpp: lists, maps and tables
  void draw_items(const Outline& o, const Json& value, const std::string& pointer);
  void draw_rows(const Outline& o, const Json& value, const std::string& pointer);
  void draw_item_buttons(const Json& items, const std::string& key, const std::string& pointer);
  void draw_add(const Outline& o, const Json& value, const std::string& pointer);
  void rename(const std::string& map, const std::string& name, const std::string& to);

  Gestures gestures_{title};
  Draft draft_;
  std::string search_;
  bool only_changed_ = false;
  std::vector<PendingEdit> asked_;
  bool ended_ = false;         ///< a drag ended in this frame
  std::string number_typed_;    ///< the number that is a text field in place of one to drag,
  bool number_focused_ = false; ///< and has the keyboard
  std::string typed_at_;        ///< the field whose text is being typed,
  std::string typed_;           ///< that text, and what is wrong with it
  std::optional<Problem> wrong_;
  std::optional<Problem> run_problem_;    ///< the error of the run
  std::string reveal_;             ///< the pointer of a field that is to be brought into sight
  Selection revealed_;             ///< what was selected when its fields were brought into sight last
  std::string help_;               ///< of the field under the mouse
  std::string folder_;             ///< that the choice of a file shows,
  std::vector<std::string> files_; ///< and what is in it
};

} // namespace nephroid::ui
