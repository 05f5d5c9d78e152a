// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/workspace.h"

#include "ui/runs/panel.h"
#include "ui/shell/status_line.h"

#include <imgui_internal.h>

#include <algorithm>
#include <iterator>

namespace nephroid::ui {
namespace {

/// Runs draw; what it throws becomes a message that names the part, and the widgets it left open are closed.
template <class Draw>
void guarded(const char* part, Commands& commands, Draw draw) {
  ImGuiErrorRecoveryState before;
  ImGui::ErrorRecoveryStoreState(&before);
  try {
    draw();
  } catch (const std::exception& error) {
    ImGuiIO& io = ImGui::GetIO();
    const bool asserts = std::exchange(io.ConfigErrorRecoveryEnableAssert, false);
    const bool tooltip = std::exchange(io.ConfigErrorRecoveryEnableTooltip, false);
    ImGui::ErrorRecoveryTryToRecoverState(&before);
    io.ConfigErrorRecoveryEnableAssert = asserts;
    io.ConfigErrorRecoveryEnableTooltip = tooltip;
    commands.push_back(command::Report{std::string(part) + ": " + error.what()});
  }
}

/// A strip over the window's whole width at its foot, above those drawn before.
template <class Draw>
void strip(const char* name, float height, Draw draw) {
  // A message that comes takes the keyboard from nobody.
  constexpr ImGuiWindowFlags flags =
      ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing;
  if (ImGui::BeginViewportSideBar(name, ImGui::GetMainViewport(), ImGuiDir_Down, height, flags)) draw();
  ImGui::End();
}

/// The errors, or the notes.
std::vector<Message> errors_or_notes(const std::vector<Message>& messages, bool errors) {
  std::vector<Message> chosen;
  std::ranges::copy_if(messages, std::back_inserter(chosen),
                       [errors](const Message& message) { return message.error == errors; });
  return chosen;
}

bool looks_at_meters(const Context& context) {
  const std::string& on_picture = context.view_state.view_settings.meter;
  const preset::Preset* preset = context.preset();
  const auto is_on_picture = [&](const preset::Meter& meter) { return meter.name == on_picture; };
  if (preset && std::ranges::any_of(preset->scene.meters, is_on_picture)) return true;
  const auto panel = std::ranges::find(panel_table(), "meters", &PanelEntry::name);
  return panel != panel_table().end() && is_seen(*panel);
}

/// Over the foot of the panels, where they take neither room nor mouse: they go by themselves.
void draw_notes_over_panels(std::span<const Message> notes) {
  if (notes.empty()) return;
  const ImGuiViewport& viewport = *ImGui::GetMainViewport();
  ImGui::SetNextWindowPos({viewport.WorkPos.x, viewport.WorkPos.y + viewport.WorkSize.y}, ImGuiCond_Always, {0, 1});
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                                     ImGuiWindowFlags_NoDocking | ImGuiWindowFlags_NoSavedSettings |
                                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_AlwaysAutoResize;
  if (ImGui::Begin("notes", nullptr, flags)) draw_note_lines(notes, viewport.WorkSize.x);
  if (!ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup)) ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
  ImGui::End();
}

/// What menu bar and strips leave of the window is known in this frame, not only in the next: where a message went
/// there would be a hole until then, and a window that nobody touches draws seldom.
void take_over_strips() {
  auto& viewport = static_cast<ImGuiViewportP&>(*ImGui::GetMainViewport());
  viewport.WorkInsetMin = viewport.BuildWorkInsetMin;
  viewport.WorkInsetMax = viewport.BuildWorkInsetMax;
  viewport.UpdateWorkRect();
}

} // namespace

Workspace::Workspace(std::string layout) : name_(std::move(layout)) {
  check_layout(name_);
  for (const PanelEntry& entry : panel_table()) add(entry, entry.make(wavelengths_));
}

Commands Workspace::draw(Workbench& workbench) {
  Commands commands;
  const Context context = workbench.context(commands);
  plots_.follow_scale();
  guarded("menu", commands, [&] {
    if (ImGui::BeginMainMenuBar()) {
      places_.clear();
      draw_menus(context, places_);
      draw_toolbar(context, places_);
      ImGui::EndMainMenuBar();
    }
    shortcuts_.run(context, list_was_open_ || workbench.questions().question() != Question::none,
                   workbench.setup().help_shown());
  });
  guarded("status line", commands, [&] {
    strip("status", ImGui::GetFrameHeight() + 2 * ImGui::GetStyle().WindowPadding.y,
          [&] { draw_status_line(context, workbench.notes()); });
  });
  guarded("messages", commands, [&] {
    const std::vector<Message> errors = errors_or_notes(workbench.messages(), true);
    const float height = errors_height(errors, ImGui::GetMainViewport()->Size.x);
    if (height > 0) strip("messages", height, [&] { draw_errors(errors, context); });
  });
  take_over_strips();
  if (context.preset())
    guarded("layout", commands, [&] { draw_dock_space(workbench, context); });
  else
    guarded("start page", commands, [&] { draw_start_page(workbench, context); });
  for (const Open& open : panels_)
    if (context.preset() && serves(open.entry, *context.preset()) && is_open(open.entry, context))
      guarded(open.entry.title, commands, [&] { draw_panel(open, context); });
  workbench.look_at_meters(looks_at_meters(context));
  guarded("notes", commands, [&] { draw_notes_over_panels(errors_or_notes(workbench.messages(), false)); });
  if (workbench.setup().help_shown()) guarded("help", commands, [&] { draw_help(context); });
  guarded("dialog", commands, [&] { dialogs_.draw(workbench, commands); });
  guarded("commands", commands, [&] { palette_.draw(context, workbench.questions().question() == Question::command); });
  list_was_open_ = ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
  return commands;
}

Command Workspace::dropped(const std::string& file) {
  const ImGuiWindow* list = ImGui::FindWindowByName(RunsPanel::title);
  const auto& [x, y] = ImGui::GetIO().MousePos;
  const bool on_list = list && list->WasActive && !list->Hidden && list->Rect().Contains({x, y});
  if (on_list && is_picture(file)) return command::PinFile{file, true};
  return command::Open{file};
}

void Workspace::draw_panel(const Open& open, const Context& context) {
  // Without NoFocusOnAppearing the last panel to be drawn would come before the one that the layout has in front.
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoFocusOnAppearing;
  if (open.entry.name == to_front_) ImGui::SetNextWindowFocus();
  bool stays = true;
  if (ImGui::Begin(open.entry.title, can_close(open.entry) ? &stays : nullptr, flags)) open.panel->draw(context);
  ImGui::End();
  if (!stays) context.push(command::ShowPanel{std::string(open.entry.name), false});
}

void Workspace::draw_start_page(Workbench& workbench, const Context& context) {
  to_front_ = workbench.setup().take_panel_to_front();
  for (const Open& open : panels_)
    if (open.entry.name == "presets") start_page_.draw(context, *open.panel, open.entry.name == to_front_);
}

void Workspace::draw_dock_space(Workbench& workbench, const Context& context) {
  const std::array<float, 2> size{ImGui::GetMainViewport()->WorkSize.x, ImGui::GetMainViewport()->WorkSize.y};
  const std::string engine = context.engine();
  to_front_ = workbench.setup().take_panel_to_front();
  const bool reset = workbench.setup().take_layout_reset();
  const bool begins = laid_out_for_ != engine || reset;
  const auto kept = context.settings.engines.find(engine);
  const auto& opened = workbench.edits()->state().opened;
  if (begins) kept_in_front_ = !reset && opened == laid_out_opened_ ? panels_in_sight() : FrontTabs();
  laid_out_opened_ = opened;
  const bool has_own = name_.empty() && kept != context.settings.engines.end() && !kept->second.ini.empty();
  if (begins && has_own) front_tabs_ = restore_layout(kept->second.ini);
  const ImGuiID id = ImGui::DockSpaceOverViewport(ImGui::GetID("panels"), ImGui::GetMainViewport());
  if (begins && !has_own) front_tabs_ = begin_layout(name_, *context.preset(), id, size[0], size[1]);
  if (begins) {
    laid_out_for_ = engine;
    frames_laid_out_ = 0;
  }
  if (begins || laid_out_size_ != size) frames_since_ = 0;
  laid_out_size_ = size;
  // A few frames later docks have their sizes. From then on another layout is what the mouse made of it.
  constexpr int settled = 3;
  if (++frames_laid_out_ <= settled) {
    bring_to_front(front_tabs_);
    bring_to_front(kept_in_front_);
    // Whatever had the keyboard: its tab would come to the front. A dialog keeps it, and the View stays behind where
    // another is before it.
    if (workbench.questions().question() == Question::none && is_seen(panel_table().front()))
      ImGui::SetWindowFocus(panel_table().front().title);
  }
  if (frames_since_ < settled) {
    if (++frames_since_ == settled) before_ = layout_now();
  } else if (ImGui::IsMouseReleased(ImGuiMouseButton_Left))
    if (std::string now = layout_now(); now != before_) {
      before_ = now;
      context.push(command::KeepLayout{engine, std::move(now)});
    }
}

} // namespace nephroid::ui
