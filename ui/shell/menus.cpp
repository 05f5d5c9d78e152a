// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/menus.h"

#include "base/error.h"
#include "base/lower_case.h"
#include "preset/read.h"
#include "ui/widgets/theme.h"

#include <fmt/format.h>
#include <imcmd_fuzzy_search.h>
#include <imgui_internal.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace nephroid::ui {
namespace {

void row(const char* how, const std::string& what) {
  ImGui::TableNextRow();
  cell(how);
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", what.c_str());
}

constexpr const char* palette_title = "Commands";

bool is_enabled(const Palette::Entry& entry, const Context& context) {
  return !entry.action || entry.action->enabled(context);
}

} // namespace

std::span<const MouseHabit> mouse_habits() {
  static const MouseHabit habits[] = {
      {"Click", "Select the object or light that is there, or nothing"},
      {"Left drag on a handle", "Move, turn or scale; Ctrl: in steps, or freely with Snap; Esc: take it back"},
      {"Left drag", "Orbit: the scene turns with the mouse"},
      {"Middle or Shift+left drag", "Pan: move the camera sideways and up"},
      {"Wheel, or right drag", "Distance of the camera"},
      {"Ctrl+wheel", "Zoom the picture about the cursor"},
      {"Ctrl+drag", "Move the picture in the panel"},
      {"Alt+click, Alt+drag", "Inspect a pixel; statistics of a rectangle"},
      {"Hover", "Linear values and luminance of the pixel"},
      {"Drop a preset or a glTF file", "Open it; a glTF file becomes a preset first"},
      {"Drop a run's folder or a history.csv", "Pin that run"},
      {"Drop a mesh (.obj, .ply, .stl)", "Make it an object of the scene"},
      {"Drop a picture on the panel Runs", "Open it, to look at and to compare"},
      {"Drop a map (.hdr, .exr) elsewhere", "Put it in place of the environment"},
      {"Drop another picture (.png, .jpg, .tif) elsewhere",
       "Engine inverse: the object casts it, in place of the first drawing; else open it"},
      {"Drop a dispersion file (.yml, .agf)", "Load it into the glass of the panel Dispersion"},
      {"On a plot: wheel, drag, double click", "Zoom, move, show everything"},
  };
  return habits;
}

void draw_menus(const Context& context, WidgetPlaces& places) {
  std::string menu;
  float width = 0;
  for (const Action& action : actions())
    if (std::exchange(menu, action.menu) != action.menu)
      width += ImGui::CalcTextSize(menu.c_str()).x + 2 * ImGui::GetStyle().ItemSpacing.x;
  const bool is_narrow = width > ImGui::GetWindowWidth(); // all of them are in one then
  if (is_narrow && !ImGui::BeginMenu("Menu")) return places.note("menu:Menu");
  menu.clear();
  bool open = false;
  for (const Action& action : actions()) {
    if (menu != action.menu) {
      if (open) ImGui::EndMenu();
      menu = action.menu;
      open = ImGui::BeginMenu(menu.c_str());
      if (!open) places.note("menu:" + menu);
    }
    if (!open) continue;
    action_item(action, context);
    places.note("menu:" + menu + "/" + action.name);
  }
  if (open) ImGui::EndMenu();
  if (is_narrow) ImGui::EndMenu();
}

void draw_toolbar(const Context& context, WidgetPlaces& places) {
  constexpr const char* names[] = {"Undo", "Redo", "Start again", "Pin this run", "Commands..."};
  const ImGuiStyle& style = ImGui::GetStyle();
  float width = style.WindowPadding.x;
  for (const char* name : names) width += ImGui::CalcTextSize(name).x + 2 * style.FramePadding.x + style.ItemSpacing.x;
  const float left = ImGui::GetWindowWidth() - width;
  if (left < ImGui::GetCursorPosX()) return; // a narrow window has its menus
  ImGui::SetCursorPosX(left);
  ImGui::PushStyleColor(ImGuiCol_Button, IM_COL32_BLACK_TRANS);
  for (const char* name : names) {
    action_button(name, context);
    places.note("toolbar:" + std::string(name));
  }
  ImGui::PopStyleColor();
}

void Shortcuts::run(const Context& context, bool dialog, bool help) {
  const ImGuiIO& io = ImGui::GetIO();
  const auto run_or_say_why = [&](const Action& action) {
    if (action.enabled(context)) return action.run(context);
    if (action.why_not) context.note(fmt::format("{}: {}", action.name, action.why_not(context)));
  };
  if (const Action* action = std::exchange(after_typing_, nullptr)) run_or_say_why(*action);
  const bool elsewhere = dialog || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup); // an open list has the keyboard
  int taken = 0; // of actions with the same keys the first that is enabled has them
  if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) taken = ImGuiKey_Escape; // it is for what is dragged
  if (help && taken == 0 && !elsewhere && !io.WantTextInput && ImGui::IsKeyChordPressed(ImGuiKey_Escape)) {
    context.push(command::ToggleHelp{});
    taken = ImGuiKey_Escape;
  }
  for (const Action& action : actions()) {
    if (!action.shortcut) continue;
    // A window that loses the keyboard never hears that the key went up.
    const auto key = static_cast<ImGuiKey>(action.shortcut & ~ImGuiMod_Mask_);
    if (action.let_go && (ImGui::IsKeyReleased(key) || io.AppFocusLost)) action.let_go(context);
    // Not ImGui::Shortcut: the routes it goes by are those of the frame before, so that a key in the first frame would
    // be lost.
    const ImGuiInputFlags flags = action.repeats ? ImGuiInputFlags_Repeat : ImGuiInputFlags_None;
    // Where somebody goes from widget to widget by the keyboard, Space is for the widget that is marked.
    if (io.NavVisible && action.shortcut == ImGuiKey_Space) continue;
    // No text has a function key. The start page begins in its search: there Ctrl+O still opens.
    const bool is_function_key = key >= ImGuiKey_F1 && key <= ImGuiKey_F12,
               types = io.WantTextInput && !is_function_key &&
                       ((context.preset() && !action.ends_typing) || !(action.shortcut & ImGuiMod_Ctrl) ||
                        !action.enabled(context));
    if (elsewhere || types || action.shortcut == taken || !ImGui::IsKeyChordPressed(action.shortcut, flags)) continue;
    if (action.enabled(context)) taken = action.shortcut;
    if (action.ends_typing && io.WantTextInput) { // the field changes the preset in this frame
      ImGui::ClearActiveID();
      after_typing_ = &action;
    } else
      run_or_say_why(action);
  }
}

void draw_help(const Context& context) {
  const ImGuiViewport* viewport = ImGui::GetMainViewport();
  ImGui::SetNextWindowPos(viewport->GetWorkCenter(), ImGuiCond_Appearing, {0.5f, 0.5f});
  bool open = true;
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse |
                                     ImGuiWindowFlags_NoDocking | ImGuiWindowFlags_NoSavedSettings;
  if (ImGui::Begin("Mouse and keys", &open, flags) && ImGui::BeginTable("help", 2, ImGuiTableFlags_RowBg)) {
    for (const MouseHabit& habit : mouse_habits()) row(habit.how, habit.what);
    for (const Action& action : actions())
      if (action.shortcut) row(keys_of(action), action.help);
    ImGui::EndTable();
  }
  ImGui::End();
  if (!open) context.push(command::ToggleHelp{});
}

void Palette::begin() {
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

void Palette::search() {
  std::vector<std::pair<int, const Entry*>> scored;
  for (const Entry& entry : entries_) {
    int score = 0;
    // Where the whole name is typed no other is meant, whatever its letters score.
    if (typed_.empty() || ImCmd::FuzzySearch(typed_.c_str(), entry.name.c_str(), score))
      scored.emplace_back(lower_case(typed_) == lower_case(entry.name) ? std::numeric_limits<int>::max() : score,
                          &entry);
  }
  std::stable_sort(scored.begin(), scored.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  matches_.clear();
  for (const auto& [score, entry] : scored) matches_.push_back(entry);
  selected_ = 0;
}

void Palette::choose(const Entry& entry, const Context& context) const {
  context.push(command::Ask{Question::none}); // first: what is chosen may ask something itself
  if (is_enabled(entry, context))
    entry.run(context);
  else
    context.note(fmt::format("{}: {}", entry.name, entry.action->why_not ? entry.action->why_not(context) : "not now"));
}

void Palette::draw(const Context& context, bool shown) {
  if (shown && !std::exchange(shown_, shown)) begin();
  if (!(shown_ = shown)) return;
  const ImGuiViewport& viewport = *ImGui::GetMainViewport();
  ImGui::SetNextWindowPos({viewport.GetWorkCenter().x, viewport.WorkPos.y + 2 * em()}, ImGuiCond_Always, {0.5f, 0});
  constexpr ImGuiWindowFlags flags =
      ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoSavedSettings;
  // Not modal: a click beside it closes it.
  if (!ImGui::BeginPopup(palette_title, flags)) return context.push(command::Ask{Question::none});
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::SetNextItemWidth(em() * 38);
  const std::string before = typed_;
  const bool entered = ImGui::InputTextWithHint("##typed", "what to do", &typed_, ImGuiInputTextFlags_EnterReturnsTrue);
  if (typed_ != before) search();
  draw_entries(context);
  if (entered && selected_ < matches_.size()) choose(*matches_[selected_], context);
  if (ImGui::IsKeyPressed(ImGuiKey_Escape, false)) context.push(command::Ask{Question::none});
  ImGui::EndPopup();
}

void Palette::draw_entries(const Context& context) {
  bool moved = false;
  if (ImGui::IsKeyPressed(ImGuiKey_DownArrow) && selected_ + 1 < matches_.size()) moved = ++selected_ > 0;
  if (ImGui::IsKeyPressed(ImGuiKey_UpArrow) && selected_ > 0) moved = --selected_ + 1 > 0;
  // The arrows move in the list while the text field has the keyboard.
  if (ImGui::BeginChild("found", {em() * 38, em() * 20}, ImGuiChildFlags_None, ImGuiWindowFlags_NoNav)) {
    for (std::size_t i = 0; i < matches_.size(); ++i) {
      const Entry& entry = *matches_[i];
      ImGui::PushID(static_cast<int>(i));
      const bool enabled = is_enabled(entry, context);
      ImGui::PushStyleColor(ImGuiCol_Text, enabled ? colour::text : colour::quiet_text);
      if (ImGui::Selectable(entry.name.c_str(), i == selected_)) choose(entry, context);
      ImGui::PopStyleColor();
      if (i == selected_ && moved) ImGui::SetScrollHereY();
      tooltip(entry.help);
      if (!entry.keys.empty()) {
        ImGui::SameLine(em() * 37 - ImGui::CalcTextSize(entry.keys.c_str()).x);
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
