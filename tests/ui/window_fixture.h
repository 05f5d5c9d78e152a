// SPDX-License-Identifier: Apache-2.0
// The whole window without a display on fake jobs, with a mouse and keys.
#pragma once
#include "fake_job.h"
#include "headless.h"

#include <cmath>

namespace nephroid::test {

/// Runs: where the window's runs come from, a FakeRuns.
template <class Runs>
class WindowFixtureOf : public ::testing::Test {
protected:
  explicit WindowFixtureOf(const std::string& layout = {}) : workspace(layout) {}

  Runs runs;
  TemporaryFolder folder;
  Headless imgui;
  ui::Workbench workbench{runs};
  ui::Workspace workspace;

  /// What panels read; for what needs one and pushes nothing.
  ui::Context context() { return workbench.context(unread_); }
  void frame() { imgui.frame(workspace, workbench); }
  void frames(int count)
  {
    for (int i = 0; i < count; ++i) frame();
  }
  void open(const std::string& text = test::preset_text)
  {
    ASSERT_TRUE(workbench.open(folder.write("test.json", text)));
    ASSERT_TRUE(eventually([&] { frame(); }, [&] { return !workspace.panel<ui::ViewPanel>().texture().empty(); }));
    frames(3); // strips and docks take their final places
  }
  /// As a panel does.
  void edit(const std::function<void(preset::Preset&)>& change, const std::string& name = "edit")
  {
    preset::Preset edited = *workbench.preset();
    change(edited);
    workbench.apply({ui::command::Edit{name, edited}});
  }
  /// Until the run is over and drawn.
  void finish()
  {
    ASSERT_TRUE(eventually([&] { frame(); }, [&] { return workbench.run().status().state == job::State::finished; }));
    frames(2);
  }
  /// The runs that follow note an error after every step.
  void measured()
  {
    runs.history = [](int steps) { return falling_history(steps); };
  }
  ui::Point middle() const
  {
    const ui::Canvas& canvas = workspace.panel<ui::ViewPanel>().canvas();
    return {canvas.corner[0] + canvas.size[0] / 2, canvas.corner[1] + canvas.size[1] / 2};
  }
  void move(const ui::Point& at)
  {
    imgui.move(at[0], at[1]);
    frame();
  }
  void press_at(const ui::Point& at, int button = 0)
  {
    move(at);
    frame(); // a point of a plot is known to be under the mouse from the second frame on
    imgui.button(button, true);
    frame();
  }
  void let_go(int button = 0)
  {
    imgui.button(button, false);
    frame();
  }
  void click(const ui::Point& at, int button = 0)
  {
    press_at(at, button);
    let_go(button);
    frame();
  }
  /// A widget of a panel, by its name; panel: what has place_of(name). Then so many frames more.
  template <class Panel>
  void click_in(const Panel& panel, const std::string& widget, int more = 1, int button = 0)
  {
    const auto place = panel.place_of(widget);
    ASSERT_TRUE(place) << widget << " is not drawn";
    click(*place, button);
    frames(more);
  }
  /// Into the field that has the keyboard.
  void type(const std::string& text)
  {
    ImGui::GetIO().AddInputCharactersUTF8(text.c_str());
    frames(2);
  }
  /// In place of what is there.
  void retype(const std::string& text)
  {
    press(ImGuiKey_A, ImGuiMod_Ctrl);
    if (text.empty()) press(ImGuiKey_Delete);
    type(text);
  }
  /// In `steps` moves of the mouse, each a frame.
  void drag_between(const ui::Point& from, const ui::Point& to, int steps = 10, int button = 0)
  {
    press_at(from, button);
    for (int i = 1; i <= steps; ++i) move({from[0] + (to[0] - from[0]) * i / steps, from[1] + (to[1] - from[1]) * i / steps});
    let_go(button);
  }
  /// In the View.
  void drag(int button, double dx, double dy) { drag_between(middle(), {middle()[0] + dx, middle()[1] + dy}, 5, button); }
  void press(ImGuiKey key, ImGuiKey modifier = ImGuiKey_None)
  {
    if (modifier) imgui.key(modifier, true);
    imgui.key(key, true);
    frame();
    imgui.key(key, false);
    if (modifier) imgui.key(modifier, false);
    frame();
  }
  const preset::Camera& camera() const { return workbench.preset()->scene.camera; }
  double distance() const
  {
    return std::hypot(camera().position[0] - camera().target[0], camera().position[1] - camera().target[1],
                      camera().position[2] - camera().target[2]);
  }

private:
  ui::Commands unread_;
};

using WindowFixture = WindowFixtureOf<FakeRuns>;

} // namespace nephroid::test
