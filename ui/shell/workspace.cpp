// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/workspace.h"

#include "base/error.h"
#include "ui/shell/actions.h"
#include "ui/shell/help.h"
#include "ui/shell/layout.h"
#include "ui/shell/messages.h"
#include "ui/shell/status_line.h"
#include "ui/state/workbench.h"

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

} // namespace

template <class P, class... Arguments>
P* Workspace::add_own(Arguments&... arguments)
{
  auto panel = std::make_unique<P>(arguments...);
  P* added = panel.get();
  add(std::move(panel));
  return added;
}

Workspace::Workspace(std::string layout) : layout_(std::move(layout))
{
  check_layout(layout_);
  view_ = add_own<ViewPanel>();
  error_ = add_own<ErrorPanel>();
  parameters_ = add_own<ParametersPanel>();
  dispersion_ = add_own<DispersionPanel>(wavelengths_);
  spectra_ = add_own<SpectraPanel>(wavelengths_);
  plan_ = add_own<PlanPanel>();
}

Commands Workspace::draw(Workbench& workbench)
{
  Commands commands;
  plots_.follow_scale();
  guarded("menu", commands, [&] {
    if (ImGui::BeginMainMenuBar()) {
      draw_menus(workbench, commands);
      ImGui::EndMainMenuBar();
    }
    run_shortcuts(workbench, commands);
  });
  guarded("status line", commands, [&] {
    strip("status", ImGui::GetFrameHeight() + 2 * ImGui::GetStyle().WindowPadding.y, [&] { draw_status_line(workbench, commands); });
  });
  guarded("messages", commands, [&] {
    const float height = messages_height(workbench, ImGui::GetMainViewport()->Size.x);
    if (height > 0) strip("messages", height, [&] { draw_messages(workbench, commands); });
  });
  guarded("layout", commands, [&] { draw_dock_space(workbench); });
  for (const std::unique_ptr<Panel>& panel : panels_) guarded(panel->name(), commands, [&] { draw_panel(*panel, workbench, commands); });
  guarded("help", commands, [&] { draw_help(workbench, commands); });
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

void Workspace::draw_panel(Panel& panel, const Workbench& workbench, Commands& commands) const
{
  // Without NoFocusOnAppearing the last panel to be drawn would come before the one that the layout has in front.
  constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoFocusOnAppearing;
  if (ImGui::Begin(panel.name(), nullptr, flags)) panel.draw(workbench, commands);
  ImGui::End();
}

} // namespace nephroid::ui
