// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/dialogs.h"

#include "base/error.h"
#include "ui/state/workbench.h"
#include "ui/widgets/widgets.h"

#include <fmt/format.h>
#include <imgui.h>

#include <filesystem>

namespace nephroid::ui {
namespace {

const char* title(Question question)
{
  switch (question) {
  case Question::open:
    return "Open a preset";
  case Question::open_history:
    return "Open the history of a run";
  case Question::save_preset:
    return "Save the preset as";
  case Question::save_picture:
    return "Save the picture as";
  case Question::unsaved:
    return "Unsaved changes";
  case Question::none:
    break;
  }
  return "";
}

/// True when Enter was pressed.
bool entered_text(const char* hint, std::string& text) { return input_text("##file", hint, text, ImGuiInputTextFlags_EnterReturnsTrue); }

bool exists(const std::string& file)
{
  std::error_code ignored;
  return std::filesystem::exists(file, ignored);
}

} // namespace

void Dialogs::begin(const Workbench& workbench)
{
  shown_ = workbench.question();
  name_ = shown_ == Question::open || shown_ == Question::open_history ? std::string() : workbench.proposed_name(shown_);
  shipped_.clear();
  ImGui::OpenPopup(title(shown_));
  if (shown_ == Question::open) shipped_ = preset::shipped_presets();
}

void Dialogs::draw(const Workbench& workbench, Commands& commands)
{
  if (workbench.question() == Question::none) {
    shown_ = Question::none;
    return;
  }
  if (shown_ != workbench.question()) begin(workbench);
  const ImGuiViewport* viewport = ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(viewport->GetWorkCenter(), ImGuiCond_Always, {0.5f, 0.5f});
  bool open = true;
  if (!ImGui::BeginPopupModal(title(shown_), &open, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings)) {
    commands.push_back(command::Ask{Question::none}); // closed by its cross
    return;
  }
  if (ImGui::IsKeyPressed(ImGuiKey_Escape, false)) open = false;
  if (shown_ == Question::open)
    draw_open(commands);
  else if (shown_ == Question::open_history)
    draw_open_history(commands);
  else if (shown_ == Question::unsaved)
    draw_unsaved(workbench, commands);
  else
    draw_save(commands);
  if (!open) commands.push_back(command::Ask{Question::none});
  ImGui::EndPopup();
}

void Dialogs::draw_open(Commands& commands)
{
  const float em = ImGui::GetFontSize();
  ImGui::SetNextItemWidth(em * 41);
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  const bool entered = entered_text("path of a preset file, or its name", name_);
  ImGui::SameLine();
  ImGui::BeginDisabled(name_.empty());
  if (ImGui::Button("Open") || (entered && !name_.empty())) commands.push_back(command::Open{name_});
  ImGui::EndDisabled();
  ImGui::SeparatorText("Shipped presets");
  if (ImGui::BeginChild("shipped", {em * 46, em * 14})) {
    for (const preset::ShippedPreset& shipped : shipped_) {
      if (ImGui::Selectable(shipped.name.c_str())) commands.push_back(command::Open{shipped.file.string()});
      ImGui::SameLine(em * 11);
      ImGui::TextDisabled("%s", shipped.description.c_str());
    }
  }
  ImGui::EndChild();
}

void Dialogs::draw_open_history(Commands& commands)
{
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 30);
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  const bool entered = entered_text("folder of a run, or its history.csv", name_);
  ImGui::SameLine();
  ImGui::BeginDisabled(name_.empty());
  if (ImGui::Button("Open") || (entered && !name_.empty())) commands.push_back(command::PinFile{name_});
  ImGui::EndDisabled();
  ImGui::TextDisabled("Of a folder the picture is kept too. Dropping it on the window does the same.");
}

void Dialogs::draw_save(Commands& commands)
{
  ImGui::SetNextItemWidth(ImGui::GetFontSize() * 30);
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  const bool entered = entered_text("file", name_);
  ImGui::SameLine();
  ImGui::BeginDisabled(name_.empty());
  const bool there = !name_.empty() && exists(name_);
  if (ImGui::Button(there ? "Replace" : "Save") || (entered && !name_.empty())) {
    if (shown_ == Question::save_picture)
      commands.push_back(command::SavePicture{name_});
    else
      commands.push_back(command::SavePreset{name_});
  }
  ImGui::EndDisabled();
  if (shown_ == Question::save_picture) ImGui::TextDisabled(".png: as shown, with this exposure; .exr: linear, with every layer");
  if (there) ImGui::TextDisabled("This file is there already.");
}

void Dialogs::draw_unsaved(const Workbench& workbench, Commands& commands)
{
  const std::string then = std::holds_alternative<command::Quit>(*workbench.waiting()) ? "quit" : "open";
  ImGui::TextUnformatted("The preset was changed and is not saved.");
  const std::filesystem::path target = workbench.save_target();
  // What waits is carried out once the preset is saved; where saving fails the question stays.
  if (ImGui::Button(target.empty() ? "Save as..." : ("Save and " + then).c_str())) {
    if (target.empty())
      commands.push_back(command::Ask{Question::save_preset});
    else
      commands.push_back(command::SavePreset{target});
  }
  ImGui::SameLine();
  if (ImGui::Button(then == "quit" ? "Quit without saving" : "Open without saving")) commands.push_back(*workbench.waiting());
  ImGui::SameLine();
  if (ImGui::Button("Go on")) commands.push_back(command::Ask{Question::none});
}

} // namespace nephroid::ui
