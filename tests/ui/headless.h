// SPDX-License-Identifier: Apache-2.0
// A Dear ImGui context without a window or a renderer: frames are drawn, the mouse and the keys are injected.
#pragma once
#include "ui/error/panel.h"
#include "ui/parameters/panel.h"
#include "ui/plan/panel.h"
#include "ui/shell/workspace.h"
#include "ui/spectral/dispersion/panel.h"
#include "ui/spectral/spectra/panel.h"
#include "ui/state/workbench.h"
#include "ui/view/panel.h"
#include "ui/widgets/theme.h"

#include <imgui.h>

#include <ctime>
#include <variant>

namespace nephroid::test {

/// Processor time of this thread: other work of the machine does not count.
inline double thread_ms()
{
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

class Headless {
public:
  Headless()
  {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {1000, 700};
    io.BackendFlags |= ImGuiBackendFlags_RendererHasTextures;
    io.ConfigFlags |= ImGuiConfigFlags_DockingEnable;
    io.ConfigInputTrickleEventQueue = false; // what is injected in one go arrives in one frame
    ui::add_font();
    ui::set_theme(1);
  }
  ~Headless()
  {
    for (ImTextureData* texture : ImGui::GetPlatformIO().Textures) release(texture);
    ImGui::DestroyContext();
  }
  Headless(const Headless&) = delete;

  /// One frame of the whole window; the commands are applied and kept in `commands`.
  void frame(ui::Workspace& workspace, ui::Workbench& workbench)
  {
    ImGui::GetIO().DeltaTime = 1.0f / 60;
    ImGui::NewFrame();
    workbench.update();
    commands = workspace.draw(workbench);
    ImGui::Render();
    for (ImTextureData* texture : ImGui::GetPlatformIO().Textures) serve(texture);
    workbench.apply(commands);
  }

  void move(double x, double y) { ImGui::GetIO().AddMousePosEvent(static_cast<float>(x), static_cast<float>(y)); }
  void button(int which, bool down) { ImGui::GetIO().AddMouseButtonEvent(which, down); }
  void wheel(double notches) { ImGui::GetIO().AddMouseWheelEvent(0, static_cast<float>(notches)); }
  void key(ImGuiKey key, bool down) { ImGui::GetIO().AddKeyEvent(key, down); }

  ui::Commands commands;
  template <class C>
  const C* pushed() const
  {
    for (const ui::Command& command : commands)
      if (const C* c = std::get_if<C>(&command)) return c;
    return nullptr;
  }

private:
  /// What a renderer would do about textures.
  static void serve(ImTextureData* texture)
  {
    if (texture->Status == ImTextureStatus_WantCreate) texture->SetTexID(1);
    if (texture->Status == ImTextureStatus_WantCreate || texture->Status == ImTextureStatus_WantUpdates)
      texture->SetStatus(ImTextureStatus_OK);
    if (texture->Status == ImTextureStatus_WantDestroy) release(texture);
  }
  static void release(ImTextureData* texture)
  {
    texture->SetTexID(ImTextureID_Invalid);
    texture->SetStatus(ImTextureStatus_Destroyed);
  }
};

} // namespace nephroid::test
