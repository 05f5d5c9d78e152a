// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/palette.h"

#include "base/error.h"
#include "base/lower_case.h"
#include "preset/read.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/widgets.h"

#include <fmt/format.h>
#include <imcmd_fuzzy_search.h>
#include <imgui.h>

#include <algorithm>
#include <limits>

namespace nephroid::ui {
namespace {

constexpr const char* palette_title = "Commands";

/// Whether the whole name is typed: then no other is meant, whatever its letters score.
bool is_name(const std::string& typed, const Palette::Entry& entry) { return lower_case(typed) == lower_case(entry.name); }

bool is_enabled(const Palette::Entry& entry, const Context& context) { return !entry.action || entry.action->enabled(context); }

} // namespace

void Palette::begin()
{
  typed_.clear();
  entries_.clear();
  for (const Action& action : actions())
    entries_.push_back({action.name, action.menu + ": " + action.help, keys_of(action), &action, action.run});
  for (const preset::ShippedPreset& shipped : preset::shipped_presets())
    entries_.push_back({"Open " + shipped.name, shipped.description, "", nullptr,
                        [file = shipped.file.string()](const Context& c) { c.push(command::Open{file}); }});
  search();
  ImGui::OpenPopup(palette_title);
}

void Palette::search()
{
  std::vector<std::pair<int, const Entry*>> scored;
  for (const Entry& entry : entries_) {
    int score = 0;
    if (typed_.empty() || ImCmd::FuzzySearch(typed_.c_str(), entry.name.c_str(), score))
      scored.emplace_back(is_name(typed_, entry) ? std::numeric_limits<int>::max() : score, &entry);
  }
  std::stable_sort(scored.begin(), scored.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  matches_.clear();
  for (const auto& [score, entry] : scored) matches_.push_back(entry);
  selected_ = 0;
}

void Palette::choose(const Entry& entry, const Context& context) const
{
  context.push(command::Ask{Question::none}); // first: what is chosen may ask something itself
  if (is_enabled(entry, context))
    entry.run(context);
  else
    context.note(fmt::format("{}: {}", entry.name, entry.action->why_not ? entry.action->why_not(context) : "not now"));
}

void Palette::draw(const Context& context, bool shown)
{
  if (shown && !std::exchange(shown_, shown)) begin();
  if (!(shown_ = shown)) return;
  const float em = ImGui::GetFontSize();
  const ImGuiViewport& viewport = *ImGui::GetMainViewport();
  ImGui::SetNextWindowPos({viewport.GetWorkCenter().x, viewport.WorkPos.y + 2 * em}, ImGuiCond_Always, {0.5f, 0});
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoSavedSettings;
  // Not modal: a click beside it closes it.
  if (!ImGui::BeginPopup(palette_title, flags)) return context.push(command::Ask{Question::none});
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(em * 38);
  const std::string before = typed_;
  const bool entered = input_text("##typed", "what to do", typed_, ImGuiInputTextFlags_EnterReturnsTrue);
  if (typed_ != before) search();
  draw_entries(context);
  if (entered && selected_ < matches_.size()) choose(*matches_[selected_], context);
  if (ImGui::IsKeyPressed(ImGuiKey_Escape, false)) context.push(command::Ask{Question::none});
  ImGui::EndPopup();
}

void Palette::draw_entries(const Context& context)
{
  const float em = ImGui::GetFontSize();
  bool moved = false;
  if (ImGui::IsKeyPressed(ImGuiKey_DownArrow) && selected_ + 1 < matches_.size()) moved = ++selected_ > 0;
  if (ImGui::IsKeyPressed(ImGuiKey_UpArrow) && selected_ > 0) moved = --selected_ + 1 > 0;
  // The arrows move in the list while the text field has the keyboard.
  if (ImGui::BeginChild("found", {em * 38, em * 20}, ImGuiChildFlags_None, ImGuiWindowFlags_NoNav)) {
    for (std::size_t i = 0; i < matches_.size(); ++i) {
      const Entry& entry = *matches_[i];
      ImGui::PushID(static_cast<int>(i));
      const bool enabled = is_enabled(entry, context);
      ImGui::PushStyleColor(ImGuiCol_Text, enabled ? colour::text : colour::quiet_text);
      if (ImGui::Selectable(entry.name.c_str(), i == selected_)) choose(entry, context);
      ImGui::PopStyleColor();
      if (i == selected_ && moved) ImGui::SetScrollHereY();
      ImGui::SetItemTooltip("%s", entry.help.c_str());
      if (!entry.keys.empty()) {
        ImGui::SameLine(em * 37 - ImGui::CalcTextSize(entry.keys.c_str()).x);
        ImGui::TextDisabled("%s", entry.keys.c_str());
      }
      ImGui::PopID();
    }
  }
  ImGui::EndChild();
  if (selected_ < matches_.size()) draw_wrapped(colour::quiet_text, matches_[selected_]->help);
  if (matches_.empty()) draw_wrapped(colour::quiet_text, "Nothing has these letters in this order");
}

} // namespace nephroid::ui
