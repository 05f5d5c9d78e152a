// SPDX-License-Identifier: Apache-2.0
// The real program in a real window on a virtual display: what it shows against what `nephroid run` writes, real X
// events, and what it says where there is no display. A window that is killed in the middle of edits comes back with
// them: what its session had kept is there; NEPHROID_KILLS=20 kills twenty. Skipped where there is no Xvfb or no
// xdotool.
#include "real_window.h"
#include "window_fixture.h"

namespace nephroid::ui::window_test {

/// Where a window of this size draws the picture of a preset.
Placement placement_in_window(int width, int height, const std::string& preset, const std::array<int, 2>& picture) {
  const test::HeadlessWindow<> like({width, height}, "", preset);
  return place(ViewSettings{}, like.view().canvas(), picture);
}

/// Without a display.
class NoWindow : public testing::Test {
protected:
  test::Ended run(const std::vector<std::string>& arguments) const {
    return test::nephroid(arguments, folder.path(), folder.path(), {{"DISPLAY", {}}, {"WAYLAND_DISPLAY", {}}});
  }
  test::TemporaryFolder folder;
};

TEST_F(NoWindow, SaysWhatToDoButFirstWhatIsNotThere) {
  const test::Ended ended = run({"--frames", "1"});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, StartsWith("nephroid: window: no display ("));
  EXPECT_THAT(ended.err, EndsWith("; run it in a desktop session or under xvfb-run; or use nephroid run PRESET\n"));
  const test::Ended no_preset = run({"nope.json"}), no_layout = run({"--layout", "sideways", "--frames", "1"});
  EXPECT_EQ(no_preset.exit_code, 2);
  EXPECT_THAT(no_preset.err, HasSubstr("there is no preset"));
  EXPECT_EQ(no_layout.exit_code, 2);
  EXPECT_THAT(no_layout.err, HasSubstr("sideways"));
}

class WindowTest : public test::RealWindow {
protected:
  void SetUp() override {
    RealWindow::SetUp();
    if (!IsSkipped()) display_.emplace();
  }
  /// Runs the program with a window to its end.
  test::Ended run(const std::vector<std::string>& arguments) const {
    return test::nephroid(arguments, folder.path(), folder.path(), display_->environment());
  }

private:
  std::optional<test::XDisplay> display_;
};

TEST_F(WindowTest, ShowsThePixelsThatARunWrites) {
  const std::string file = folder.write("test.json", test::preset_text);
  const test::Ended batch = run({"run", file, "-o", "out"});
  ASSERT_EQ(batch.exit_code, 0) << batch.err;
  const test::Ended ended = run({file, "--size", "900x700", "--frames", "5", "--until", "1", "--screenshot",
                                 "screen.png", "--frame-times", "times.csv"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const image::Image picture = screen(), written = image::read_image(folder.path() / "out/image.png");
  ASSERT_EQ(picture.width, 900);
  ASSERT_EQ(picture.height, 700);
  const Placement p = placement_in_window(900, 700, file, {written.width, written.height});
  const preset::Preset preset = preset::parse_preset(test::preset_text, "test");
  const Point icon = *make_pinhole(preset.scene.camera, p, {written.width, written.height})
                          ->to_screen(to_vector(preset.scene.lights[0].position));
  ASSERT_GT(p.scale, 3) << "pixels are squares";
  int different = 0, brightest = 0;
  // The mouse rests over the picture: the value under it is shown over the lower left corner.
  for (int y = 0; y < written.height * 3 / 4; ++y)
    for (int x = 0; x < written.width; ++x) {
      const Point at = p.to_screen({x + 0.5, y + 0.5});
      if (std::hypot(at[0] - icon[0], at[1] - icon[1]) < 10) continue; // the light's icon
      const auto shown = bytes_at(picture, at[0], at[1]), expected = bytes_at(written, x, y);
      different += shown != expected;
      brightest = std::max(brightest, expected[1]);
    }
  EXPECT_GT(brightest, 50) << "the picture is not black";
  EXPECT_EQ(different, 0);
  EXPECT_THAT(read_file(folder.path() / "times.csv"),
              StartsWith("frame,draw_ms,own_ms,own_cpu_ms,period_ms,edits,run,state,fraction\n0,"));
}

TEST_F(WindowTest, AScreenshotOfAnErrorIsWrittenAndHasTheErrorsExitCode) {
  const auto with_screenshot = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--frames", "3", "--until", "1", "--screenshot", "screen.png"});
    return run(arguments);
  };
  const test::Ended missing = with_screenshot({"missing.json"});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_THAT(missing.err, HasSubstr("there is no preset"));
  EXPECT_EQ(screen().width, 1280);
  fs::remove(folder.path() / "screen.png");
  const test::Ended no_device = with_screenshot({folder.write("test.json", test::preset_text), "--device", "abacus"});
  EXPECT_EQ(no_device.exit_code, 3);
  EXPECT_THAT(no_device.err, HasSubstr("abacus"));
  EXPECT_EQ(screen().width, 1280);
}

TEST_F(WindowTest, FrameTimesThatCannotBeWrittenAreRefusedAtOnce) {
  const test::Ended ended =
      run({folder.write("test.json", test::preset_text), "--frame-times", "nosuchfolder/times.csv"});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("nephroid: nosuchfolder/times.csv: cannot be written"));
}

TEST_F(WindowTest, WhatCannotBePinnedIsSaid) {
  const std::string preset = folder.write("test.json", test::preset_text), wrong = folder.write("a.png", "no picture");
  const test::Ended ended = run({preset, wrong, "--frames", "1", "--screenshot", "screen.png"});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_THAT(ended.err, HasSubstr("\nnephroid: " + wrong + ": "));
  EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 2)
      << "the frames' times, then one line: " << ended.err;
}

class WindowEvents : public test::RealWindow {};

TEST_F(WindowEvents, AreFollowed) {
  // A run that does not end by itself; an orbit, a resize, a cancel, save, quit.
  preset::Preset endless = preset::parse_preset(test::preset_text, "test");
  endless.scene.materials["glass"].type = preset::Material::Type::dielectric;
  endless.scene.objects.push_back({.name = "ball",
                                   .shape = preset::Shape{.radius = 0.3},
                                   .material = "glass",
                                   .transform = {.translate = {0, 0, 0.5}}});
  endless.stop.passes.reset();
  endless.stop.seconds = 3600;
  const std::string file = folder.write("test.json", preset::to_json(endless));
  test::PlayedWindow window(file, {"--size", "900x700"}, folder.path());
  window.drag({450, 350}, {610, 350});
  EXPECT_THAT(window.title(), StartsWith("* Test")) << "the preset is edited";
  window.resize({1000, 800});
  window.save();
  const auto comes_to = [&](const std::string& state) {
    window.until(state, [&] { return window.states().back().name == state; });
  };
  comes_to("running");
  window.key("shift+F5");
  comes_to("cancelled");
  const test::Ended ended = window.quit();
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const preset::Preset saved = preset::read_preset(file);
  EXPECT_LT(saved.scene.camera.position[0], -0.5) << "the scene was turned to the right, the camera to the left";
  EXPECT_NEAR(saved.scene.camera.position[1], 0, 0.05);
  EXPECT_EQ(screen().width, 1000);
  EXPECT_EQ(screen().height, 800);
}

class KilledWindow : public test::RealWindow {
protected:
  /// Edits that the newest session has kept; -1 while there is none.
  int in_file() const {
    int edits = -1;
    fs::file_time_type newest = fs::file_time_type::min();
    std::error_code ignored;
    for (const fs::directory_entry& entry :
         fs::directory_iterator(folder.path() / "state/nephroid/sessions", ignored)) {
      const fs::path file = entry.path() / "session.json";
      const auto written = fs::last_write_time(file, ignored);
      if (ignored || written < newest) continue;
      newest = written;
      const Session session = parse_session(read_file(file), file.string());
      edits = session.edits ? static_cast<int>(session.edits->index) : -1;
    }
    return edits;
  }
};

TEST_F(KilledWindow, ComesBackWithItsEdits) {
  const char* asked = std::getenv("NEPHROID_KILLS");
  const int kills = asked ? std::atoi(asked) : 2;
  std::mt19937 random(1);
  preset::Preset endless = preset::parse_preset(test::preset_text, "killed.json");
  endless.stop.passes = 100000;
  std::vector<std::string> arguments{folder.write("killed.json", preset::to_json(endless))};
  int kept_before = 0;
  for (int i = 0; i < kills; ++i) {
    test::PlayedWindow window(arguments, folder.path(), folder.path());
    // As it was before: the first has its file, the others begin with nothing but the session.
    window.until("the session is kept",
                 [&] { return in_file() >= kept_before && window.title().find("Test") != std::string::npos; });
    const int edits = 1 + static_cast<int>(random() % 3);
    window.move({300, 400});
    for (int edit = 0; edit < edits;
         ++edit) { // the camera is a notch further away; turns within 0.6 s would be one edit
      window.turn_wheel();
      std::this_thread::sleep_for(std::chrono::milliseconds(700));
    }
    if (i % 2 == 0) window.until("an edit is kept", [&] { return in_file() > kept_before; });
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 1500));
    EXPECT_EQ(window.kill().signal, SIGKILL);
    EXPECT_GE(in_file(), kept_before) << "nothing that was kept is lost";
    EXPECT_LE(in_file(), kept_before + edits);
    kept_before = in_file();
    arguments.clear();
  }
  EXPECT_GT(kept_before, 0);
}

} // namespace nephroid::ui::window_test
