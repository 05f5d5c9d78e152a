// SPDX-License-Identifier: Apache-2.0
// A window in which every action can be possible, and three ways to press one: the command palette, its keys, its menu.
#pragma once
#include "scenes.h"
#include "window_fixture.h"

namespace nephroid::test {

class Desk : public HeadlessWindow<SceneRuns> {
public:
  Desk() {
    resize({1300, 900});
    runs.steps = 1000000;
    runs.step_ms = 1;
    measured();
    open(ball_text());
    EXPECT_TRUE(until([&] { return workbench.run().scene_facts().view && workbench.run().error_history(); }));
  }

  ~Desk() { runs.opens_device = true; }

  const preset::Preset& preset() const { return *workbench.preset(); }
  const preset::Scene& scene() const { return preset().scene; }
  const ui::ViewState& view_state() const { return workbench.view_state(); }
  const ui::WindowSettings& settings() const { return workbench.setup().settings(); }
  const ui::RunInHand& run() const { return workbench.run(); }
  const auto& comparing() const { return workbench.comparing(); }
  std::string file() const { return (folder.path() / "test.json").string(); }
  void apply(ui::Command command) {
    workbench.apply({std::move(command)});
    frames(4);
  }
  /// Another camera, as one edit.
  void edit(double z = 3) {
    HeadlessWindow::edit([&](preset::Preset& p) { p.scene.camera.position = {0, 0, z}; });
    frames(4);
  }
  void set_tone(preset::Display::Tone tone) {
    HeadlessWindow::edit([tone](preset::Preset& p) { p.display.tone = tone; });
    frames(4);
  }
  void look(ui::ViewSettings view_settings) { apply(ui::command::SetViewSettings{view_settings}); }
  static std::string clipboard() {
    const char* text = ImGui::GetClipboardText();
    return text ? text : "";
  }

  /// Remembers what there is, for what is looked at after a press.
  void remember() {
    ImGui::SetClipboardText("nothing was copied");
    before = {preset(), workbench.view_state(), workbench.setup().settings(), workbench.run().status().generation};
  }
  struct Before {
    preset::Preset preset;
    ui::ViewState view_state;
    ui::WindowSettings settings;
    std::uint64_t run = 0;
  } before;

  /// Draws frames until it holds.
  bool comes_to(const std::function<bool(Desk&)>& condition) {
    return until([&] { return condition(*this); });
  }

  /// The palette, its name, Enter. False, and nothing is done, where the palette has another action first.
  bool by_palette(const ui::Action& action) {
    apply(ui::command::Ask{ui::Question::command});
    ImGui::GetIO().AddInputCharactersUTF8(action.name.c_str());
    frames(2);
    const auto& found = workspace.palette().matches();
    if (found.empty() || found.front()->action != &action) return false;
    imgui.key(ImGuiKey_Enter, true);
    frame();
    imgui.key(ImGuiKey_Enter, false);
    return true;
  }
  /// The keys stay down until lift().
  void hold(int chord) {
    keys(chord, true);
    frame();
  }
  void lift(int chord) {
    keys(chord, false);
    frames(2);
  }
  /// The menu's title, then the entry. False where the menu has no such entry.
  bool by_menu(const ui::Action& action) {
    click(workspace.place_of("menu:" + action.menu).value());
    frames(2);
    const auto entry = workspace.place_of("menu:" + action.menu + "/" + action.name);
    if (entry) click(*entry);
    return entry.has_value();
  }

private:
  void keys(int chord, bool down) {
    for (const ImGuiKey modifier : {ImGuiMod_Ctrl, ImGuiMod_Shift})
      if (chord & modifier) imgui.key(modifier, down);
    imgui.key(static_cast<ImGuiKey>(chord & ~ImGuiMod_Mask_), down);
  }
};

} // namespace nephroid::test
