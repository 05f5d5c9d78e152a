// SPDX-License-Identifier: Apache-2.0
#include "ui/parameters/panel.h"

#include "base/lower_case.h"
#include "preset/origins.h"
#include "ui/widgets/theme.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>

namespace nephroid::ui {
namespace {

using preset::Outline;
using Kind = Outline::Kind;

bool is_leaf(const Outline& o)
{
  const bool objects = o.kind == Kind::object || o.kind == Kind::list || o.kind == Kind::map;
  return !objects && o.kind != Kind::table && o.kind != Kind::texts && !(o.kind == Kind::numbers && o.size == 0);
}

const Json& part(const Json& object, const Outline& o)
{
  static const Json none;
  const auto found = object.find(o.field.name);
  return found == object.end() ? none : *found;
}

bool is_changed(const Outline& o, const Json& value)
{
  if (o.kind != Kind::object || o.optional) return !o.field.required && value != o.standard;
  const auto fields = o.fields(value);
  return std::any_of(fields.begin(), fields.end(), [&](const Outline& f) { return is_changed(f, part(value, f)); });
}

/// By default. What has no default, a list and the type of an object stay as they are.
Json reset(const Outline& o, const Json& value)
{
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
Json given(const Outline& o)
{
  const double number = o.field.bounds.contain(1) ? 1 : o.field.bounds.low;
  if (o.kind == Kind::number) return number;
  if (o.kind == Kind::integer) return static_cast<std::int64_t>(number);
  if (o.size > 0) return std::vector<double>(o.size, number);
  return o.object ? o.fresh() : o.kind == Kind::boolean ? Json(false) : o.kind == Kind::text ? Json("") : Json::array();
}

std::string help_of(const Outline& o, const std::string& pointer)
{
  std::string text = fmt::format("{}: {}", dotted(pointer), o.field.sentence);
  if (o.kind == Kind::object) return text;
  text += fmt::format("\nWanted: {}", o.expected);
  if (o.optional) return text + "; may be left out";
  if (o.field.required || o.chooses || o.standard.size() > 8) return text;
  return text +
         fmt::format("; by default {}", o.standard.is_string() ? fmt::format("\"{}\"", o.standard.get<std::string>()) : o.standard.dump());
}

} // namespace

void ParametersPanel::draw(const Context& context)
{
  draft_.follow(*context.preset());
  places_.clear();
  if (const Selection selection = context.selection(); selection != revealed_) {
    revealed_ = selection;
    if (const std::string pointer = pointer_of(selection); !pointer.empty()) reveal_ = pointer;
  }
  const std::string revealing = reveal_;
  follow_run(context);
  draw_top();
  const float room = ImGui::GetContentRegionAvail().y,
              help = room > 24 * ImGui::GetFontSize() ? 3.5f * ImGui::GetTextLineHeightWithSpacing() : 0;
  if (ImGui::BeginChild("fields", {0, room - help})) {
    ImGui::PushID(is_searching() ? "found" : "all"); // what a search opens is closed again after it
    if (ImGui::BeginTable("fields", 2, ImGuiTableFlags_Resizable | ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerV)) {
      ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 2);
      ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 3);
      draw_fields(preset::outline(draft_.value()), draft_.value(), "");
      ImGui::EndTable();
    }
    ImGui::PopID();
  }
  ImGui::EndChild();
  if (help > 0)
    draw_wrapped(colour::quiet_text, help_.empty() ? "Drag a number, or click on it and type. A right click on a name: its menu." : help_);
  if (reveal_ == revealing) reveal_.clear(); // in sight, or nowhere
  carry_out(context);
}

void ParametersPanel::carry_out(const Context& context)
{
  for (PendingEdit& asked : std::exchange(asked_, {})) {
    if (auto edited = draft_.edit(asked.pointer, std::move(asked.value)))
      context.push(command::Edit{std::move(asked.label), *std::move(edited), asked.live ? gestures_.number() : 0, asked.live});
    else if (!asked.live)
      for (const auto& [edit, problem] : draft_.problems())
        if (is_inside(asked.pointer, edit)) reveal_ = shown_at(problem);
  }
  if (std::exchange(ended_, false)) context.push(command::EndGesture{});
}

void ParametersPanel::ask(std::string label, const std::string& pointer, Json value, bool live)
{
  asked_.push_back({std::move(label), pointer, std::move(value), live});
}

/// What the run found wrong with the preset is said at its field, too.
void ParametersPanel::follow_run(const Context& context)
{
  run_problem_.reset();
  const std::optional<Error>& error = context.run.status().error;
  if (!error) return;
  const std::string field = preset::field_of(*context.preset(), error->place());
  if (!field.empty()) run_problem_ = {field, field, error->text()};
}

void ParametersPanel::draw_top()
{
  const float changed = ImGui::CalcTextSize("Changed").x + ImGui::GetFrameHeight() + 3 * ImGui::GetStyle().ItemSpacing.x;
  ImGui::SetNextItemWidth(-changed);
  input_text("##search", "Search names, units and help", search_, ImGuiInputTextFlags_EscapeClearsAll);
  note("search");
  ImGui::SameLine();
  places_.checkbox("Changed", &only_changed_, "changed", "Only fields that are not as they are by default");
  for (const auto& [edit, problem] : Problems(draft_.problems())) {
    ImGui::PushID(edit.c_str());
    if (places_.small_button("Take back", edit + ":drop")) draft_.drop(edit);
    ImGui::SameLine();
    if (ImGui::SmallButton(("Show " + dotted(shown_at(problem))).c_str())) {
      search_.clear();
      only_changed_ = false;
      reveal_ = shown_at(problem);
    }
    ImGui::PopID();
  }
  if (!draft_.problems().empty()) draw_wrapped(colour::error, "The run goes on without this, until it is mended.");
}

void ParametersPanel::draw_fields(const Fields& fields, const Json& object, const std::string& pointer)
{
  for (const Outline& o : fields) {
    if (o.chooses && !pointer.empty()) continue; // in the row of its object
    const std::string at = child_of(pointer, o.field.name);
    const Json& value = part(object, o);
    if (is_wanted(o, value, at)) draw_field(o, value, at);
  }
}

void ParametersPanel::draw_field(const Outline& o, const Json& value, const std::string& pointer)
{
  const bool leaf = is_leaf(o), changed = is_changed(o, value);
  const bool open = draw_label(std::string(o.field.name), pointer, leaf, changed);
  draw_menu(o, value, pointer);
  ImGui::TableNextColumn();
  if (o.optional) draw_given(o, value, pointer);
  if (value.is_null())
    ImGui::TextDisabled("not given");
  else if (leaf)
    draw_value(o, value, pointer);
  else if (o.kind == Kind::object)
    draw_type(o, value, pointer);
  else
    draw_add(o, value, pointer);
  if (changed && !value.is_null()) draw_reset(o, value, pointer);
  draw_problem(pointer, leaf || !open);
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

/// The left cell of a new row. True where a branch is open: TreePop() after its rows.
bool ParametersPanel::draw_label(const std::string& label, const std::string& pointer, bool leaf, bool changed)
{
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::AlignTextToFramePadding();
  ImGuiTreeNodeFlags flags = ImGuiTreeNodeFlags_SpanAvailWidth;
  if (leaf) flags |= ImGuiTreeNodeFlags_Leaf | ImGuiTreeNodeFlags_NoTreePushOnOpen;
  if (leaf && changed) flags |= ImGuiTreeNodeFlags_Bullet;
  const bool revealed = !reveal_.empty() && is_inside(reveal_, pointer);
  if (!leaf && (revealed || is_searching())) ImGui::SetNextItemOpen(true);
  const bool wrong = std::any_of(draft_.problems().begin(), draft_.problems().end(),
                                 [&](const auto& problem) { return is_inside(shown_at(problem.second), pointer); });
  ImGui::PushStyleColor(ImGuiCol_Text, wrong ? colour::error : changed ? colour::text : colour::quiet_text);
  const bool open = ImGui::TreeNodeEx(pointer.c_str(), flags, "%s", label.c_str());
  ImGui::PopStyleColor();
  note(pointer + ":label");
  if (revealed && (leaf || reveal_ == pointer)) ImGui::SetScrollHereY();
  return open;
}

void ParametersPanel::draw_menu(const Outline& o, const Json& value, const std::string& pointer)
{
  if (ImGui::IsItemHovered()) help_ = help_of(o, pointer);
  tooltip(std::string(o.field.sentence));
  if (!ImGui::BeginPopupContextItem((pointer + ":menu").c_str())) return;
  if (ImGui::MenuItem("Reset", nullptr, false, reset(o, value) != value)) ask("reset " + dotted(pointer), pointer, reset(o, value));
  note(pointer + ":menu reset");
  const std::string setting = fmt::format("--set '{}={}'", dotted(pointer), value.dump());
  if (is_leaf(o) && ImGui::MenuItem("Copy as --set")) ImGui::SetClipboardText(setting.c_str());
  ImGui::EndPopup();
}

void ParametersPanel::draw_given(const Outline& o, const Json& value, const std::string& pointer)
{
  bool on = !value.is_null();
  if (ImGui::Checkbox(("##given" + pointer).c_str(), &on)) {
    ask(fmt::format("{} {}", on ? "give" : "leave out", dotted(pointer)), pointer, on ? given(o) : Json());
    if (on) reveal_ = pointer;
  }
  note(pointer + ":given", "Given or not");
  ImGui::SameLine();
}

void ParametersPanel::draw_reset(const Outline& o, const Json& value, const std::string& pointer)
{
  const Json standard = reset(o, value);
  if (o.optional || standard == value) return;
  ImGui::SameLine();
  if (ImGui::ArrowButton(("##reset" + pointer).c_str(), ImGuiDir_Left)) ask("reset " + dotted(pointer), pointer, standard);
  note(pointer + ":reset", "Reset: as it is by default");
}

/// all: with what is wrong further inside.
void ParametersPanel::draw_problem(const std::string& pointer, bool all)
{
  const auto draw = [&](const Problem& problem) {
    const std::string place = shown_at(problem);
    if (all ? !is_inside(place, pointer) : place != pointer) return;
    draw_wrapped(colour::error, (problem.place == place ? "" : dotted(problem.place) + ": ") + problem.text);
    note(pointer + ":problem");
  };
  const bool typing = !typed_at_.empty() && is_inside(typed_at_, pointer) && all;
  if (typing && wrong_) draw(*wrong_);
  for (const auto& [edit, problem] : draft_.problems())
    if (!typing || !is_inside(edit, pointer)) draw(problem);
  if (run_problem_) draw(*run_problem_);
}

/// What is wrong elsewhere because of an edit is said where the edit was made.
std::string ParametersPanel::shown_at(const Problem& problem)
{
  return is_inside(problem.place, problem.pointer) ? problem.place : problem.pointer;
}

bool ParametersPanel::is_wanted(const Outline& o, const Json& value, const std::string& pointer) const
{
  if (o.is_engine_settings && draft_.value()["engine"] != o.field.name) return false;
  if (!is_searching()) return true;
  if (only_changed_ && !is_changed(o, value)) return false;
  if (has_words(fmt::format("{} {} {}", dotted(pointer), o.field.sentence, o.field.unit), search_)) return true;
  if (!o.object && lower_case(search_).starts_with(lower_case(dotted(pointer)) + ".")) return true; // a number of it
  if (value.is_null() || !o.object) return false;
  if (o.kind == Kind::object) return any_wanted(o, value, pointer);
  const auto items = value.items();
  return std::any_of(items.begin(), items.end(),
                     [&](const auto& item) { return any_wanted(o, item.value(), child_of(pointer, item.key())); });
}

/// Of the fields of an object, which may be an item of o.
bool ParametersPanel::any_wanted(const Outline& o, const Json& object, const std::string& pointer) const
{
  const auto fields = o.fields(object);
  return std::any_of(fields.begin(), fields.end(),
                     [&](const Outline& f) { return is_wanted(f, part(object, f), child_of(pointer, f.field.name)); });
}

} // namespace nephroid::ui
