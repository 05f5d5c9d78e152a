// SPDX-License-Identifier: Apache-2.0
// A row a field, with what can be done about it.
#include "ui/parameters/panel.h"

#include "base/json_output.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::ui {
namespace {

using preset::Outline;
using Kind = Outline::Kind;

/// Whether a field has one row; the others have rows of their own below.
bool is_leaf(const Outline& o) {
  const bool objects = o.kind == Kind::object || o.kind == Kind::list || o.kind == Kind::map;
  return !objects && o.kind != Kind::table && o.kind != Kind::texts && !(o.kind == Kind::numbers && o.size == 0);
}

/// The value by default. What has none, a list and the type of an object stay as they are.
Json reset(const Outline& o, const Json& value) {
  if (o.optional) return nullptr;
  if (o.kind == Kind::object) {
    Json reset_fields = value;
    for (const Outline& f : o.fields(value))
      if (value.contains(f.field.name)) reset_fields[std::string(f.field.name)] = reset(f, part(value, f));
    return reset_fields;
  }
  return o.field.required || o.kind == Kind::list || o.kind == Kind::map ? value : o.standard;
}

/// What an optional field is when it is given.
Json given(const Outline& o) {
  const double number = o.field.bounds.contain(1) ? 1 : o.field.bounds.low;
  if (o.kind == Kind::number) return number;
  if (o.kind == Kind::integer) return static_cast<std::int64_t>(number);
  if (o.size > 0) return std::vector<double>(o.size, number);
  return o.object ? o.fresh() : o.kind == Kind::boolean ? Json(false) : o.kind == Kind::text ? Json("") : Json::array();
}

std::string help_of(const Outline& o, const std::string& pointer) {
  std::string text = fmt::format("{}: {}", dotted(pointer), o.field.sentence);
  if (o.kind == Kind::object) return text;
  text += fmt::format("\nWanted: {}", o.expected);
  if (o.optional) return text + "; may be left out";
  if (o.field.required || o.chooses || o.standard.size() > 8) return text;
  return text + fmt::format("; by default {}", o.standard.is_string()
                                                   ? fmt::format("\"{}\"", o.standard.get<std::string>())
                                                   : o.standard.dump());
}

} // namespace

void FieldRows::draw_fields(const std::vector<Outline>& fields, const Json& object, const std::string& pointer) {
  for (const Outline& o : fields) {
    if (o.chooses && !pointer.empty()) continue; // in the row of its object
    const std::string at = child_of(pointer, o.field.name);
    const Json& value = part(object, o);
    if (form_.wants(o, value, at)) draw_field(o, value, at);
  }
}

void FieldRows::draw_field(const Outline& o, const Json& value, const std::string& pointer) {
  const bool leaf = is_leaf(o), changed = is_changed(o, value);
  const bool open = draw_label(std::string(o.field.name), pointer, leaf, changed);
  draw_menu(o, value, pointer);
  ImGui::TableNextColumn();
  if (o.optional) draw_given(o, value, pointer);
  if (value.is_null())
    ImGui::TextDisabled("not given");
  else if (leaf)
    values_.draw_value(o, value, pointer);
  else if (o.kind == Kind::object)
    values_.draw_type(o, value, pointer);
  else
    draw_add(o, value, pointer);
  if (changed && !value.is_null()) draw_reset(o, value, pointer);
  draw_problem(pointer, leaf || !open);
  if (o.field.names == preset::Names::material && !form_.selected.empty() && is_inside(pointer, form_.selected))
    draw_picture(value.get<std::string>(), pointer);
  if (leaf || !open) return;
  if (value.is_null())
    ;
  else if (o.kind == Kind::object)
    draw_fields(o.fields(value), value, pointer);
  else if (o.kind == Kind::list || o.kind == Kind::map)
    draw_items(o, value, pointer);
  else
    draw_rows(o, value, pointer);
  ImGui::TreePop();
}

bool FieldRows::draw_label(const std::string& label, const std::string& pointer, bool leaf, bool changed) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_SpanAvailWidth;
  if (leaf) flags |= ImGuiTreeNodeFlags_Leaf | ImGuiTreeNodeFlags_NoTreePushOnOpen;
  if (leaf && changed) flags |= ImGuiTreeNodeFlags_Bullet;
  const bool revealed = !form_.reveal.empty() && is_inside(form_.reveal, pointer);
  if (!leaf && (revealed || form_.searching())) ImGui::SetNextItemOpen(true);
  const bool wrong = std::any_of(form_.draft.problems().begin(), form_.draft.problems().end(),
                                 [&](const auto& problem) { return is_inside(shown_at(problem.second), pointer); });
  ImGui::PushStyleColor(ImGuiCol_Text, wrong ? colour::error : changed ? colour::text : colour::quiet_text);
  const bool open = ImGui::TreeNodeEx(pointer.c_str(), flags, "%s", label.c_str());
  ImGui::PopStyleColor();
  form_.note(pointer + ":label");
  if (revealed && (leaf || form_.reveal == pointer)) ImGui::SetScrollHereY();
  return open;
}

void FieldRows::draw_menu(const Outline& o, const Json& value, const std::string& pointer) {
  if (ImGui::IsItemHovered()) help_ = help_of(o, pointer);
  tooltip(std::string(o.field.sentence));
  if (!ImGui::BeginPopupContextItem((pointer + ":menu").c_str())) return;
  if (ImGui::MenuItem("Reset", nullptr, false, reset(o, value) != value))
    form_.ask("reset " + dotted(pointer), pointer, reset(o, value));
  form_.note(pointer + ":menu reset");
  const std::string setting = fmt::format("--set '{}={}'", dotted(pointer), json_text(value));
  if (is_leaf(o) && ImGui::MenuItem("Copy as --set")) ImGui::SetClipboardText(setting.c_str());
  ImGui::EndPopup();
}

void FieldRows::draw_given(const Outline& o, const Json& value, const std::string& pointer) {
  bool on = !value.is_null();
  if (ImGui::Checkbox(("##given" + pointer).c_str(), &on)) {
    form_.ask(fmt::format("{} {}", on ? "give" : "leave out", dotted(pointer)), pointer, on ? given(o) : Json());
    if (on) form_.reveal = pointer;
  }
  form_.note(pointer + ":given", "Given or not");
  ImGui::SameLine();
}

void FieldRows::draw_reset(const Outline& o, const Json& value, const std::string& pointer) {
  const Json standard = reset(o, value);
  if (o.optional || standard == value) return;
  ImGui::SameLine();
  if (ImGui::ArrowButton(("##reset" + pointer).c_str(), ImGuiDir_Left))
    form_.ask("reset " + dotted(pointer), pointer, standard);
  form_.note(pointer + ":reset", "Reset: as it is by default");
}

void FieldRows::draw_problem(const std::string& pointer, bool with_inner) {
  const auto draw = [&](const Problem& problem) {
    const std::string place = shown_at(problem);
    if (with_inner ? !is_inside(place, pointer) : place != pointer) return;
    draw_wrapped(colour::error, (problem.place == place ? "" : dotted(problem.place) + ": ") + problem.text);
    form_.note(pointer + ":problem");
  };
  const bool typing = !values_.typed_at().empty() && is_inside(values_.typed_at(), pointer) && with_inner;
  if (typing && values_.wrong()) draw(*values_.wrong());
  for (const auto& [edit, problem] : form_.draft.problems())
    if (!typing || !is_inside(edit, pointer)) draw(problem);
  if (form_.refused) draw(*form_.refused);
}

/// Draws what the material looks like. Where an edit of it waits nobody knows.
void FieldRows::draw_picture(const std::string& material, const std::string& pointer) {
  const std::string at = child_of(materials_pointer, material);
  const auto is_of_it = [&](const auto& problem) {
    return is_inside(problem.first, at) || is_inside(shown_at(problem.second), at);
  };
  if (std::ranges::none_of(form_.draft.problems(), is_of_it))
    pictures_.draw(*form_.balls, material, 8 * em(), form_.places(), pointer + ":picture");
}

} // namespace nephroid::ui
