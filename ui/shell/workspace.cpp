// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/workspace.h"

#include "ui/shell/menus.h"
#include "ui/shell/status_line.h"

#include <imgui.h>
#include <imgui_internal.h>

#include <exception>
#include <utility>

namespace nephroid::ui {
namespace {

/// Runs draw; what it throws becomes a message that names the part, and the widgets it left open are closed.
template <class Draw>
void guarded(const char* part, Commands& commands, Draw draw)
{
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
void strip(const char* name, float height, Draw draw)
{
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoSavedSettings;
  if (ImGui::BeginViewportSideBar(name, ImGui::GetMainViewport(), ImGuiDir_Down, height, flags)) draw();
  ImGui::End();
}

void draw_panel(const char* title, Panel& panel, const Context& context)
{
  // Without NoFocusOnAppearing the last panel to be drawn would come before the one that the layout has in front.
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoFocusOnAppearing;
  if (ImGui::Begin(title, nullptr, flags)) panel.draw(context);
  ImGui::End();
}

} // namespace

Workspace::Workspace(std::string layout) : layout_(std::move(layout))
{
  check_layout(layout_);
  for (const PanelEntry& entry : panel_table()) add(entry, entry.make(wavelengths_));
}

Commands Workspace::draw(Workbench& workbench)
{
  Commands commands;
  const Context context = workbench.context(commands);
  plots_.follow_scale();
  guarded("menu", commands, [&] {
    if (ImGui::BeginMainMenuBar()) {
      draw_menus(context);
      ImGui::EndMainMenuBar();
    }
    run_shortcuts(context, workbench.question() != Question::none);
  });
  guarded("status line", commands, [&] {
    strip("status", ImGui::GetFrameHeight() + 2 * ImGui::GetStyle().WindowPadding.y, [&] { draw_status_line(context, workbench.notes()); });
  });
  guarded("messages", commands, [&] {
    const float height = messages_height(workbench.messages(), ImGui::GetMainViewport()->Size.x);
    if (height > 0) strip("messages", height, [&] { draw_messages(workbench.messages(), context); });
  });
  guarded("layout", commands, [&] { draw_dock_space(workbench); });
  for (const Open& open : panels_)
    if (serves(open.entry, context.preset()))
      guarded(open.entry.title, commands, [&] { draw_panel(open.entry.title, *open.panel, context); });
  if (workbench.help_shown()) guarded("help", commands, [&] { draw_help(context); });
  guarded("dialog", commands, [&] { dialogs_.draw(workbench, commands); });
  return commands;
}

void Workspace::draw_dock_space(Workbench& workbench)
{
  const ImGuiID id = ImGui::DockSpaceOverViewport(ImGui::GetID("panels"), ImGui::GetMainViewport());
  if (laid_out_ && !workbench.take_layout_reset()) return;
  laid_out_ = true;
  const ImVec2 size = ImGui::GetMainViewport()->WorkSize;
  build_layout(layout_, id, size.x, size.y);
}

} // namespace nephroid::ui
