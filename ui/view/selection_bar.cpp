// SPDX-License-Identifier: Apache-2.0
#include "ui/view/selection_bar.h"

#include "ui/widgets/action.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <string>

namespace nephroid::ui {
namespace {

void draw_choice(const Context& context, WidgetPlaces& places)
{
  const preset::Preset& preset = *context.preset();
  const Selection now = context.selection();
  const std::string name = now == Selection{} ? "nothing" : name_of(preset, now);
  const float em = ImGui::GetFontSize();
  ImGui::SetNextItemWidth(std::clamp(ImGui::GetContentRegionAvail().x - 26 * em, 5 * em, 12 * em)); // the buttons have the rest
  const bool open = ImGui::BeginCombo("##selected", name.c_str());
  places.note("selected");
  if (!open) return;
  const auto choice = [&](const std::string& label, const Selection& selection) {
    if (ImGui::Selectable(fmt::format("{}##{}", label, pointer_of(selection)).c_str(), selection == now))
      context.push(command::Select{selection});
    places.note("select " + label);
  };
  choice("nothing", {});
  for (const Selection& selection : selectable(preset)) choice(name_of(preset, selection), selection);
  ImGui::EndCombo();
}

/// A button that stays down while what it does is on.
void draw_toggle(const char* name, const Context& context, WidgetPlaces& places)
{
  const bool on = action(name).checked(context);
  ImGui::SameLine();
  if (on) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
  action_button(name, context);
  if (on) ImGui::PopStyleColor();
  places.note(name);
}

void draw_bookmarks(const Context& context, WidgetPlaces& places)
{
  const std::vector<Bookmark>& bookmarks = context.chosen.bookmarks;
  for (std::size_t i = 0; i < bookmarks.size(); ++i) {
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::Button("Go")) {
      context.push(command::GoToBookmark{i});
      ImGui::CloseCurrentPopup();
    }
    if (i < 9) ImGui::SetItemTooltip("Ctrl+%d", static_cast<int>(i) + 1);
    places.note(fmt::format("go {}", i));
    ImGui::SameLine();
    std::string name = bookmarks[i].name;
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 14);
    if (input_text("##name", "", name)) context.push(command::RenameBookmark{i, name});
    places.note(fmt::format("name {}", i));
    ImGui::SameLine();
    if (ImGui::Button("x")) context.push(command::DeleteBookmark{i});
    ImGui::SetItemTooltip("Delete this bookmark");
    places.note(fmt::format("delete {}", i));
    ImGui::PopID();
  }
  if (bookmarks.empty()) ImGui::TextDisabled("No camera is bookmarked yet.");
  action_button("Bookmark this camera", context);
  places.note("bookmark");
}

} // namespace

void draw_selection_bar(const Context& context, WidgetPlaces& places)
{
  if (!context.preset() || !has_scene(*context.preset())) return;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Selected");
  ImGui::SameLine();
  draw_choice(context, places);
  for (const char* tool : {"Move", "Turn", "Scale", "Own axes", "Snap"}) draw_toggle(tool, context, places);
  ImGui::SameLine();
  if (ImGui::Button("Cameras")) ImGui::OpenPopup("cameras");
  ImGui::SetItemTooltip("Bookmarks of cameras");
  places.note("cameras");
  if (!ImGui::BeginPopup("cameras")) return;
  draw_bookmarks(context, places);
  ImGui::EndPopup();
}

} // namespace nephroid::ui
