// SPDX-License-Identifier: Apache-2.0
// Somebody at work in the real window, from the start page to what is saved. Beside it the same window without a
// display gets the same mouse and keys, and says where things are by now. A screenshot a step; with the folder docs in
// NEPHROID_PICTURES a sheet of them is made there, and in NEPHROID_SHOTS they are kept whole.
#pragma once
#include "real_window.h"
#include "ui/presets/panel.h"
#include "window_fixture.h"

#include <imgui_internal.h>

namespace nephroid::test {

/// Runs: where the runs of the window without a display come from, a FakeRuns.
template <class Runs = FakeRuns>
class RecordedSession {
public:
  using ScreenPoint = std::array<double, 2>;
  static constexpr std::array<int, 2> size{1280, 800};

  /// name: of the sheet, session-NAME.jpg. What the window saves by a name alone is in saved(). opened_lately: a
  /// preset's text; the file saved()/NAME.json has it, and the start page lists it.
  RecordedSession(std::string name, const fs::path& folder, const std::string& opened_lately = {})
      : name_(std::move(name)), folder_(folder), aside_(made(folder / "aside")),
        window_({"--size", fmt::format("{}x{}", size[0], size[1])}, folder, prepared(opened_lately)) {
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(size[0]), static_cast<float>(size[1])};
    io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    if (!opened_lately.empty()) workbench_.remember({folder_ / "state/nephroid/recent.json", {}});
    draw(5);
  }

  // What the person does, in both windows.

  void move(const ScreenPoint& to) {
    window_.move(pixel(to));
    imgui_.move(pixel(to)[0], pixel(to)[1]);
    draw(2);
  }
  void press() {
    window_.press();
    imgui_.button(0, true);
    draw(2);
  }
  void let_go() {
    window_.let_go();
    imgui_.button(0, false);
    draw(4);
  }
  void click(const ScreenPoint& at) {
    move(at);
    press();
    let_go();
  }
  void drag(const ScreenPoint& from, const ScreenPoint& by) {
    move(from);
    press();
    constexpr int moves = 4;
    for (int i = 1; i <= moves; ++i) move({from[0] + by[0] * i / moves, from[1] + by[1] * i / moves});
    let_go();
  }
  /// A key by its name for X: "Return", "s"; the others are held: "ctrl", "shift".
  void key(const std::string& key, const std::vector<std::string>& held = {}) {
    window_.chord(held, key);
    const ImGuiKey meant = key == "Return" ? ImGuiKey_Enter : static_cast<ImGuiKey>(ImGuiKey_A + (key.at(0) - 'a'));
    const auto hold = [&](bool down) {
      for (const std::string& one : held) imgui_.key(one == "ctrl" ? ImGuiMod_Ctrl : ImGuiMod_Shift, down);
    };
    hold(true);
    imgui_.key(meant, true);
    draw(1);
    imgui_.key(meant, false);
    hold(false);
    draw(4);
  }
  void type(const std::string& text) {
    window_.type(text);
    ImGui::GetIO().AddInputCharactersUTF8(text.c_str());
    draw(3);
  }

  // Where things are.

  const ui::Workspace& workspace() const { return workspace_; }
  const ui::Workbench& workbench() const { return workbench_; }
  template <class P>
  const P& panel() const {
    return workspace_.panel<P>();
  }
  /// The tab of a panel.
  template <class P>
  ScreenPoint tab() const {
    const ImGuiWindow* found = ImGui::FindWindowByName(P::title);
    if (!found) throw std::runtime_error(std::string("there is no panel ") + P::title);
    const ImVec2 middle = found->DC.DockTabItemRect.GetCenter();
    return {middle.x, middle.y};
  }
  /// Of a part of the picture.
  ScreenPoint in_view(double x, double y) const {
    const ui::Canvas& canvas = panel<ui::ViewPanel>().canvas();
    return {canvas.corner[0] + x * canvas.size[0], canvas.corner[1] + y * canvas.size[1]};
  }

  // What is waited for.

  /// In the window without a display, which computes nothing that is not needed.
  template <class Condition>
  void until_placed(const std::string& what, Condition condition) {
    if (!eventually([&] { draw(1); }, condition)) throw std::runtime_error("it does not come to this: " + what);
    draw(4);
  }
  /// Until the run of a preset has shown a picture.
  void until_opened(const std::string& preset) {
    until_placed(preset + " is open", [&] { return workbench_.run().snapshot_is_current(); });
    rest();
    window_.until(preset + " is open", [&] { return window_.title().find(preset) != std::string::npos; });
    until_passed(0);
  }
  /// Opens from the list of the start page the preset that was opened lately, by typing some of its name.
  void open_listed(const std::string& typed, const std::string& title) {
    const auto& presets = panel<ui::PresetsPanel>();
    until_placed("the presets are listed", [&] { return presets.place_of("search") && workbench_.tasks().empty(); });
    window_.settle(30);
    click(presets.place_of("search").value());
    type(typed);
    until_placed("it is found", [&] { return presets.listed().size() == 1; });
    window_.settle(10);
    shot("The start page: a preset of mine is looked for");
    key("Return");
    until_opened(title);
  }
  /// The window without a display computes nothing more: the other one's is the run.
  void rest() { workbench_.apply({ui::command::Cancel{}}); }
  /// Until more than this part of the run in hand is done.
  void until_passed(double fraction) {
    window_.until(fmt::format("{} of the run is done", fraction), [&] {
      const auto states = window_.states();
      return !states.empty() && (states.back().fraction > fraction || states.back().name == "finished");
    });
    window_.settle();
  }
  void until_finished() {
    const auto over = [&] { return window_.states().back().name == "finished"; };
    for (int minute = 0; minute < 4 && !over(); ++minute) eventually(over);
    window_.until("the run is over", over);
    window_.settle();
  }
  void until_there(const fs::path& file) {
    window_.until(file.string() + " is written", [&] { return fs::exists(saved() / file); });
    window_.settle(5);
  }

  // What is left of it.

  fs::path saved() const { return folder_ / "saved"; }
  /// The preset that was opened lately.
  fs::path file() const { return saved() / (name_ + ".json"); }

  /// A screenshot; `what` is its title on the sheet.
  void shot(const std::string& what) {
    const std::string file = fmt::format("{}-{}.png", name_, shots_.size() + 1);
    move({size[0] - 9, size[1] - 9}); // no tooltip lies over it
    window_.picture(file);
    shots_.emplace_back(folder_ / file, what);
    const char* kept = std::getenv("NEPHROID_SHOTS");
    if (kept) fs::copy_file(folder_ / file, fs::path(kept) / file, fs::copy_options::overwrite_existing);
  }
  /// For a page of the docs: with what the mouse is over now.
  image::Image picture(const std::string& name) {
    image::Image picture = window_.picture(name);
    keep_for_docs(folder_ / name);
    return picture;
  }
  PlayedWindow& window() { return window_; }
  /// Quits; the session that the window leaves.
  ui::Session quit() {
    const Ended ended = window_.quit();
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    make_sheet();
    for (const auto& entry : fs::directory_iterator(folder_ / "state/nephroid/sessions"))
      if (const auto file = entry.path() / "session.json"; fs::exists(file))
        return ui::parse_session(read_file(file), file.string());
    throw std::runtime_error("the window left no session");
  }

private:
  /// Where the window works.
  fs::path prepared(const std::string& opened_lately) const {
    made(saved());
    if (opened_lately.empty()) return saved();
    write_file_whole(file(), opened_lately);
    write_file_whole(made(folder_ / "state/nephroid") / "recent.json",
                     fmt::format(R"({{"recent":[{{"file":"{}"}}]}})", file().string()));
    return saved();
  }
  static fs::path made(const fs::path& folder) {
    fs::create_directories(folder);
    return folder;
  }
  void draw(int frames) {
    for (int i = 0; i < frames; ++i) imgui_.frame(workspace_, workbench_);
  }
  void make_sheet() const {
    const char* pictures = std::getenv("NEPHROID_PICTURES");
    if (!pictures) return;
    std::string command = "montage -font DejaVu-Sans";
    for (const auto& [file, what] : shots_) command += fmt::format(" -label '{}' '{}'", what, file.string());
    command +=
        fmt::format(" -tile 2x -geometry 590x+4+4 -pointsize 15 -strip -define jpeg:extent=140kb '{}/session-{}.jpg'",
                    pictures, name_);
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
  }

  std::string name_;
  fs::path folder_, aside_;
  CurrentFolder here_{aside_}; // the window without a display saves, too
  Headless imgui_;
  Runs runs_;
  ui::Workbench workbench_{runs_};
  ui::Workspace workspace_;
  PlayedWindow window_;
  std::vector<std::pair<fs::path, std::string>> shots_; ///< a file and its title
};

} // namespace nephroid::test
