// SPDX-License-Identifier: Apache-2.0
// The whole window without a display or a renderer: frames are drawn, the mouse and the keys are injected.
#pragma once
#include "fake_job.h"
#include "ui/error/panel.h"
#include "ui/parameters/panel.h"
#include "ui/plan/panel.h"
#include "ui/shell/workspace.h"
#include "ui/spectral/dispersion/panel.h"
#include "ui/spectral/spectra/panel.h"
#include "ui/state/session_keeper.h"
#include "ui/view/panel.h"

namespace nephroid::test {

inline double thread_ms() { return 1e3 * processor_seconds(CLOCK_THREAD_CPUTIME_ID); }

/// What bounds on thread_ms() are multiplied by: how many times as long as on the machine they were set on (5 ms) this
/// thread takes here to sort numbers; at least 1.
inline double slowness() {
  const double begin = thread_ms();
  std::mt19937 random(1);
  std::vector<std::mt19937::result_type> numbers(100'000);
  std::generate(numbers.begin(), numbers.end(), random);
  std::sort(numbers.begin(), numbers.end());
  return std::max(1.0, (thread_ms() - begin) / 5);
}

class Headless {
public:
  Headless() {
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
  ~Headless() {
    for (ImTextureData* texture : ImGui::GetPlatformIO().Textures) release(texture);
    ImGui::DestroyContext();
  }
  Headless(const Headless&) = delete;

  /// One frame of the whole window; the commands are applied and kept in `commands`.
  void frame(ui::Workspace& workspace, ui::Workbench& workbench) {
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
  const C* pushed() const {
    for (const ui::Command& command : commands)
      if (const C* c = std::get_if<C>(&command)) return c;
    return nullptr;
  }

private:
  /// What a renderer would do about textures.
  static void serve(ImTextureData* texture) {
    if (texture->Status == ImTextureStatus_WantCreate) texture->SetTexID(1);
    if (texture->Status == ImTextureStatus_WantCreate || texture->Status == ImTextureStatus_WantUpdates)
      texture->SetStatus(ImTextureStatus_OK);
    if (texture->Status == ImTextureStatus_WantDestroy) release(texture);
  }
  static void release(ImTextureData* texture) {
    texture->SetTexID(ImTextureID_Invalid);
    texture->SetStatus(ImTextureStatus_Destroyed);
  }
};

/// Runs: where the window's runs come from, a FakeRuns.
template <class Runs = FakeRuns>
class HeadlessWindow {
public:
  explicit HeadlessWindow(const std::string& layout = {}) : workspace(layout) {}
  /// As a real window of this size, in pixels, shows a preset's file once it has a picture.
  HeadlessWindow(const std::array<int, 2>& size, const std::string& layout, const std::string& preset)
      : HeadlessWindow(layout) {
    resize(size);
    workbench.open(preset);
    until_shown();
    frames(5); // strips and docks take their final places
  }

  Runs runs;
  TemporaryFolder folder;
  Headless imgui;
  ui::Workbench workbench{runs};
  ui::Workspace workspace;

  /// What panels read; for what needs one and pushes nothing.
  ui::Context context() { return workbench.context(unread_); }
  void frame() { imgui.frame(workspace, workbench); }
  void frames(int count) {
    for (int i = 0; i < count; ++i) frame();
  }
  static void resize(const std::array<int, 2>& size) {
    ImGui::GetIO().DisplaySize = {static_cast<float>(size[0]), static_cast<float>(size[1])};
  }
  /// Draws frames until it holds; false where it does not come to that.
  bool until(const std::function<bool()>& condition) {
    return eventually([&] { frame(); }, condition);
  }
  bool until(job::State state) {
    return until([&] { return workbench.run().status().state == state; });
  }
  /// Until the run in hand is of the present preset, and has shown a picture.
  bool until_current() {
    return until([&] { return workbench.run().snapshot_is_current(); });
  }
  bool until_shown() {
    return until([&] { return !workspace.template panel<ui::ViewPanel>().texture().empty(); });
  }
  bool until_files_are_done() {
    return until([&] { return !workbench.works_on_files(); });
  }
  void open(const std::string& text = test::preset_text) { open_file(folder.write("test.json", text)); }
  void open_file(const std::string& name) {
    ASSERT_TRUE(workbench.open(name));
    ASSERT_TRUE(until_shown());
    frames(3); // strips and docks take their final places
  }
  /// As a panel does.
  void edit(const std::function<void(preset::Preset&)>& change, const std::string& name = "edit") {
    preset::Preset edited = *workbench.preset();
    change(edited);
    workbench.apply({ui::command::Edit{name, edited}});
  }
  /// Commands, and what is drawn after them.
  void apply(const ui::Commands& commands) {
    workbench.apply(commands);
    frames(3);
  }
  /// Until the run is over and drawn.
  void finish() {
    ASSERT_TRUE(until(job::State::finished));
    frames(2);
  }
  /// Opens it and runs it to its end.
  void run_through(const std::string& text = test::preset_text) {
    open(text);
    finish();
  }
  void run_measured(const std::string& text = test::preset_text) {
    measured();
    run_through(text);
  }
  /// The runs that follow note an error after every step.
  void measured() {
    runs.history = [](int steps) { return falling_history(steps); };
  }
  const ui::ViewPanel& view() const { return workspace.template panel<ui::ViewPanel>(); }
  ui::Point middle() const {
    const ui::Canvas& canvas = view().canvas();
    return {canvas.corner[0] + canvas.size[0] / 2, canvas.corner[1] + canvas.size[1] / 2};
  }
  void move(const ui::Point& at) {
    imgui.move(at[0], at[1]);
    frame();
  }
  void press_at(const ui::Point& at, int button = 0) {
    move(at);
    frame(); // a point of a plot is known to be under the mouse from the second frame on
    imgui.button(button, true);
    frame();
  }
  void let_go(int button = 0) {
    imgui.button(button, false);
    frame();
  }
  void click(const ui::Point& at, int button = 0) {
    press_at(at, button);
    let_go(button);
    frame();
  }
  /// A widget of a panel, by its name; panel: what has place_of(name). Then so many frames more.
  template <class Panel>
  void click_in(const Panel& panel, const std::string& widget, int more = 1, int button = 0) {
    const auto place = panel.place_of(widget);
    ASSERT_TRUE(place) << widget << " is not drawn";
    click(*place, button);
    frames(more);
  }
  /// Into the field that has the keyboard.
  void type(const std::string& text) {
    ImGui::GetIO().AddInputCharactersUTF8(text.c_str());
    frames(2);
  }
  /// In place of what is there.
  void retype(const std::string& text) {
    press(ImGuiKey_A, ImGuiMod_Ctrl);
    if (text.empty()) press(ImGuiKey_Delete);
    type(text);
  }
  /// In `steps` moves of the mouse, each a frame.
  void drag_between(const ui::Point& from, const ui::Point& to, int steps = 10, int button = 0) {
    press_at(from, button);
    for (int i = 1; i <= steps; ++i)
      move({from[0] + (to[0] - from[0]) * i / steps, from[1] + (to[1] - from[1]) * i / steps});
    let_go(button);
  }
  void drag_by(const ui::Point& from, double x, double y = 0, int steps = 10) {
    drag_between(from, {from[0] + x, from[1] + y}, steps);
  }
  /// In the View.
  void drag(int button, double dx, double dy) {
    drag_between(middle(), {middle()[0] + dx, middle()[1] + dy}, 5, button);
  }
  /// Until what it does is drawn.
  void press(ImGuiKey key, ImGuiKey modifier = ImGuiKey_None) {
    if (modifier) imgui.key(modifier, true);
    imgui.key(key, true);
    frame();
    imgui.key(key, false);
    if (modifier) imgui.key(modifier, false);
    frames(3);
  }
  /// Closes this window's session, and opens it again in another one.
  void reopen_in(ui::Workbench& other) {
    ui::SessionKeeper(folder.path() / "state").close(workbench);
    ui::SessionKeeper(folder.path() / "state").reopen(other);
  }
  const preset::Camera& camera() const { return workbench.preset()->scene.camera; }
  double distance() const {
    return std::hypot(camera().position[0] - camera().target[0], camera().position[1] - camera().target[1],
                      camera().position[2] - camera().target[2]);
  }

private:
  ui::Commands unread_;
};

template <class Runs>
class WindowFixtureOf : public testing::Test, public HeadlessWindow<Runs> {
protected:
  using HeadlessWindow<Runs>::HeadlessWindow;
};

using WindowFixture = WindowFixtureOf<FakeRuns>;

/// A place on the screen as the pixel that events go to.
inline std::array<int, 2> pixel(const ui::Point& place) {
  return {static_cast<int>(std::lround(place[0])), static_cast<int>(std::lround(place[1]))};
}

} // namespace nephroid::test
