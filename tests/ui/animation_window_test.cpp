// SPDX-License-Identifier: Apache-2.0
// An animation in the window: frames are chosen and played, edits of what moves are keys, files stay as frame 0 has it,
// and a recorded film has the bits of the one that the command line makes.
#include "parameters_fixture.h"
#include "tests/support/child.h"
#include "ui/state/device_runs.h"
#include "ui/state/run_record.h"

namespace nephroid::ui::animation_window_test {

/// The camera goes from z = 4 at frame 0 to z = 14 at frame 10; the fake run's picture is of its colour.
const std::string moving = R"("animation": {"frames": 11, "fps": 100, "tracks": [
  {"path": "scene.camera.position.2", "keys": [{"frame": 0, "value": 4}, {"frame": 10, "value": 14}]}]})";

std::string animated(const std::string& animation = moving) {
  std::string text = test::preset_text;
  return text.insert(text.rfind('}'), ", " + animation);
}

class AnimationWindowTest : public test::WindowFixture {
protected:
  double z() const { return camera().position[2]; }
  int shown() const { return workbench.edits()->frame(); }
  /// What the picture in the View is of.
  double pictured() const { return static_cast<double>(workbench.run().snapshot()->picture->rgb[2]); }
  const std::vector<preset::Key>& keys() const { return workbench.preset()->animation->tracks.at(0).keys; }
};

TEST_F(AnimationWindowTest, AFrameIsChosenByTheSliderTheNumberAndKeys) {
  open(animated());
  EXPECT_EQ(z(), 4);
  const auto slider = view().place_of("frame");
  ASSERT_TRUE(slider);
  click(*slider); // its middle
  EXPECT_EQ(shown(), 5);
  EXPECT_EQ(z(), 9);
  ASSERT_TRUE(until([&] { return pictured() == 9; })) << "the run follows";
  EXPECT_FALSE(workbench.edits()->modified()) << "it is no edit";
  press(ImGuiKey_Period, ImGuiMod_Shift);
  EXPECT_EQ(z(), 10);
  press(ImGuiKey_Comma, ImGuiMod_Shift);
  press(ImGuiKey_Comma, ImGuiMod_Shift);
  EXPECT_EQ(z(), 8);
  press(ImGuiKey_Home, ImGuiMod_Shift);
  EXPECT_EQ(z(), 4);
  press(ImGuiKey_Comma, ImGuiMod_Shift);
  EXPECT_EQ(shown(), 10) << "round and round";
  click_in(view(), "frame number");
  retype("3");
  press(ImGuiKey_Enter);
  EXPECT_EQ(z(), 7);
  click_in(view(), "frame number");
  retype("99");
  press(ImGuiKey_Enter);
  EXPECT_EQ(shown(), 10) << "the nearest that there is";
}

TEST_F(AnimationWindowTest, WithoutAnAnimationThereIsNoBar) {
  open();
  EXPECT_FALSE(view().place_of("frame"));
  press(ImGuiKey_Period, ImGuiMod_Shift);
  EXPECT_EQ(workbench.edits()->frame(), 0);
  apply({command::Play{}, command::ShowFrame{3}});
  EXPECT_FALSE(workbench.playback().playing());
  apply({command::RecordFilm{folder.path() / "film"}});
  EXPECT_THAT(last_message(workbench), HasSubstr("#/animation: is not there"));
}

TEST_F(AnimationWindowTest, AnEditOfWhatMovesIsAKeyInTheShownFrame) {
  open(animated());
  apply({command::ShowFrame{5}});
  edit([](preset::Preset& p) { p.scene.camera.position[2] = 20; }, "away");
  EXPECT_EQ(keys(), (std::vector<preset::Key>{{0, {4}}, {5, {20}}, {10, {14}}}));
  EXPECT_EQ(z(), 20);
  EXPECT_EQ(workbench.edits()->undo_label(), "away, a key at frame 5");
  edit([](preset::Preset& p) { p.scene.camera.position[2] = 21; });
  EXPECT_EQ(keys()[1], (preset::Key{5, {21}})) << "the key that is there";
  apply({command::ShowFrame{0}});
  EXPECT_EQ(z(), 4) << "the other frames stay";
  apply({command::ShowFrame{5}, command::Undo{}, command::Undo{}});
  EXPECT_THAT(keys(), SizeIs(2));
  EXPECT_EQ(z(), 9);
  EXPECT_EQ(shown(), 5) << "undo goes to no other frame";
  apply({command::Redo{}});
  EXPECT_EQ(z(), 20);
}

TEST_F(AnimationWindowTest, AnEditOfWhatStandsStillIsOfAllFrames) {
  open(animated());
  apply({command::ShowFrame{5}});
  edit([](preset::Preset& p) { p.scene.camera.position[0] = 1; });
  EXPECT_THAT(keys(), SizeIs(2));
  EXPECT_EQ(camera().position, (preset::Vec3{1, 0, 9}));
  apply({command::ShowFrame{0}});
  EXPECT_EQ(camera().position, (preset::Vec3{1, 0, 4}));
}

TEST_F(AnimationWindowTest, ADragOfTheCameraIsOneKeyAndOneEntry) {
  open(animated());
  apply({command::ShowFrame{5}});
  drag(0, 60, 0); // orbits
  ASSERT_THAT(keys(), SizeIs(3));
  EXPECT_EQ(keys()[1].frame, 5);
  EXPECT_EQ(keys()[1].value[0], z());
  EXPECT_LT(z(), 9);
  apply({command::Undo{}});
  EXPECT_THAT(keys(), SizeIs(2));
}

TEST_F(AnimationWindowTest, ADragByAHandleIsOneKey) {
  open(animated(R"("animation": {"frames": 11, "tracks": [{"path": "scene.lights.0.position",
    "keys": [{"frame": 0, "value": [0, 0.5, 0]}, {"frame": 10, "value": [1, 0.5, 0]}]}]})"));
  apply({command::ShowFrame{5}, command::Select{{Selection::Kind::light, 0}}});
  frames(3);
  const auto handles = view().overlay().gizmo().places();
  ASSERT_TRUE(handles);
  drag_by((*handles)[2], 0, -60); // the arrow along y
  ASSERT_THAT(keys(), SizeIs(3));
  EXPECT_EQ(keys()[1].frame, 5);
  EXPECT_GT(keys()[1].value[1], 0.6);
  EXPECT_EQ(keys()[1].value[1], workbench.preset()->scene.lights[0].position[1]) << "the whole way of the drag";
  apply({command::Undo{}});
  EXPECT_THAT(keys(), SizeIs(2));
}

TEST_F(AnimationWindowTest, FilesHaveFrame0AndAPinHasItsFrame) {
  open(animated());
  apply({command::ShowFrame{5}});
  finish();
  apply({command::PinRun{}, command::SavePreset{folder.path() / "saved.json"}});
  const std::string saved = read_file(folder.path() / "saved.json");
  EXPECT_EQ(preset::Json::parse(saved).at("scene").at("camera").at("position").at(2), 4);
  EXPECT_EQ(shown(), 5);
  const PinnedRun& pin = workbench.comparing().pinned().all().at(0);
  write_run_folder(folder.path() / "pin", pin, {}, false);
  const preset::Preset kept = preset::read_preset((folder.path() / "pin/preset.json").string());
  EXPECT_FALSE(kept.animation);
  EXPECT_EQ(kept.scene.camera.position[2], 9);
  EXPECT_EQ(kept.name, "Test,frame=5");
}

TEST_F(AnimationWindowTest, ASessionKeepsTheFrame) {
  open(animated());
  apply({command::ShowFrame{5}});
  test::Bench other;
  reopen_in(other.workbench);
  EXPECT_EQ(other.workbench.edits()->frame(), 5);
  EXPECT_EQ(other.workbench.preset()->scene.camera.position[2], 9);
}

TEST_F(AnimationWindowTest, PlaysRoundAndRoundUntilSomebodyDoesSomethingElse) {
  runs.steps = 1000000;
  open(animated());
  press(ImGuiKey_Space, ImGuiMod_Shift);
  ASSERT_TRUE(workbench.playback().playing());
  EXPECT_NE(workbench.run().status().state, job::State::paused) << "Space alone pauses";
  std::set<int> seen;
  bool again = false;
  for (int last = 0; !again;) {
    ASSERT_TRUE(until([&] { return shown() != last; }));
    again = shown() < last;
    seen.insert(last = shown());
  }
  EXPECT_GE(seen.size(), 4u);
  EXPECT_TRUE(workbench.playback().playing());
  edit([](preset::Preset& p) { p.scene.camera.fov_deg = 30; });
  frames(2);
  EXPECT_FALSE(workbench.playback().playing());
  apply({command::Play{}});
  EXPECT_TRUE(workbench.playback().playing());
  apply({command::ShowFrame{(shown() + 3) % 11}});
  EXPECT_FALSE(workbench.playback().playing());
}

// A film of 1000 frames a second whose pictures take 50 ms and more. Time is the test's own.
TEST(Playback, LeavesFramesOutWhereTheMachineIsSlower) {
  test::TemporaryFolder folder;
  test::Bench bench;
  bench.runs.steps = 1000000;
  std::string text = animated();
  text.replace(text.find("\"fps\": 100"), 10, "\"fps\": 1000");
  text.replace(text.find("\"frames\": 11"), 12, "\"frames\": 80");
  ASSERT_TRUE(bench.workbench.open(folder.write("test.json", text)));
  const auto until_current = [&] { return bench.until([&] { return bench.workbench.run().snapshot_is_current(); }); };
  ASSERT_TRUE(until_current());
  bench.workbench.apply({command::Play{}});
  auto now = Workbench::Clock::now();
  bench.workbench.update(now);
  bench.workbench.update(now += std::chrono::microseconds(3500));
  EXPECT_EQ(bench.workbench.edits()->frame(), 3);
  bench.workbench.update(now += std::chrono::seconds(1));
  EXPECT_EQ(bench.workbench.edits()->frame(), 3) << "its picture is still to come";
  ASSERT_TRUE(
      test::eventually([&] { bench.workbench.update(now); }, [&] { return bench.workbench.edits()->frame() != 3; }));
  EXPECT_EQ(bench.workbench.edits()->frame(), 13) << "a round has eight pictures at least";
}

class AnimatedParametersTest : public test::ParametersFixture {};

TEST_F(AnimatedParametersTest, ANumberThatMovesIsTypedAsAKey) {
  open(animated());
  apply({command::ShowFrame{5}});
  enter("/scene/camera/fov_deg", "30");
  EXPECT_THAT(workbench.preset()->animation->tracks[0].keys, SizeIs(2));
  EXPECT_EQ(camera().position[2], 9);
  enter("/scene/camera/position/2", "20");
  EXPECT_THAT(problems(), IsEmpty());
  EXPECT_EQ(workbench.preset()->animation->tracks[0].keys.at(1), (preset::Key{5, {20}}));
  EXPECT_EQ(camera().position[2], 20);
  EXPECT_EQ(camera().fov_deg, 30);
  undo();
  EXPECT_EQ(camera().position[2], 9);
}

TEST(FilmRecording, HasTheBitsOfTheCommandLinesFilm) {
  test::TemporaryFolder folder;
  const std::string preset = folder.write("small.json", R"({"parent": "spectral/plate",
    "scene": {"camera": {"resolution": [48, 40]}}, "spectral": {"photons_per_pass": 20000}, "stop": {"passes": 2},
    "animation": {"frames": 24, "tracks": [{"path": "scene.objects.0.transform.rotate_deg.2",
      "keys": [{"frame": 0, "value": 0}, {"frame": 2, "value": 20}]}]}})");
  const auto ended =
      test::nephroid({"run", preset, "-o", (folder.path() / "film").string()}, folder.path(), folder.path());
  ASSERT_EQ(ended.exit_code, 0) << ended.err;

  DeviceRuns runs{compute::DeviceOptions{}};
  Workbench workbench(runs);
  const auto until = [&](const std::function<bool()>& done) {
    return test::eventually([&] { workbench.update(); }, done);
  };
  ASSERT_TRUE(workbench.open(preset));
  ASSERT_TRUE(until([&] { return workbench.run().status().state == job::State::finished; }));
  workbench.apply({command::ShowFrame{2}});
  const fs::path film = folder.path() / "recorded";
  workbench.apply({command::RecordFilm{film}});
  ASSERT_TRUE(workbench.film().active());
  EXPECT_THAT(workbench.film().summary(), testing::MatchesRegex("frame [0-9]+ of 24"));
  ASSERT_TRUE(until([&] { return fs::exists(film / "frame_0000.png"); }));
  workbench.apply({command::StopFilm{}});
  ASSERT_TRUE(until([&] { return !workbench.film().active(); })) << only_message(workbench);
  EXPECT_THAT(only_message(workbench), HasSubstr("again goes on there"));
  EXPECT_FALSE(fs::exists(film / "frame_0023.png"));
  const auto first = fs::last_write_time(film / "frame_0000.png");
  workbench.apply({command::RecordFilm{film}});
  ASSERT_TRUE(until([&] { return !workbench.film().active(); }));
  EXPECT_EQ(fs::last_write_time(film / "frame_0000.png"), first) << "finished frames stay";
  for (const char* frame : {"frame_0000", "frame_0001", "frame_0002", "frame_0023"})
    for (const char* kind : {".exr", ".png"})
      EXPECT_TRUE(read_file(film / (frame + std::string(kind))) ==
                  read_file(folder.path() / "film" / (frame + std::string(kind))))
          << frame << kind;
  EXPECT_EQ(fs::exists(film / "animation.mp4"), fs::exists(folder.path() / "film/animation.mp4"));
  EXPECT_TRUE(fs::exists(film / "frames.csv"));
}

} // namespace nephroid::ui::animation_window_test
