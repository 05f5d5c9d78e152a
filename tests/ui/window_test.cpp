// SPDX-License-Identifier: Apache-2.0
// The real program in a real window on a virtual display: what it shows against what `nephroid run` writes, real X events, and
// what it says where there is no display. Skipped where there is no xvfb-run (or, for events, no xdotool).
#include "base/files.h"
#include "fake_job.h"
#include "image/image.h"
#include "places.h"
#include "preset/read.h"
#include "real_window.h"
#include "ui/placement.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

namespace nephroid::ui {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

using test::bytes_at, test::program, test::shell, test::there_is;

/// Where a window of this size draws the picture.
Placement placement_in_window(int width, int height, const std::array<int, 2>& picture)
{
  return test::in_window_like({width, height}, "", "",
                              [&](const Workspace& workspace, auto&, auto) { return place(Look{}, workspace.view().canvas(), picture); });
}

class WindowTest : public test::RealWindow {};

TEST_F(WindowTest, WithoutADisplayItSaysWhatToDo)
{
  EXPECT_EQ(shell("env -u DISPLAY -u WAYLAND_DISPLAY " + program + " --frames 1", log), 1);
  const std::string said = read_file(log);
  EXPECT_THAT(said, StartsWith("nephroid: window: no display ("));
  EXPECT_THAT(said, EndsWith("; run it in a desktop session or under xvfb-run; or use nephroid run PRESET\n"));
}

TEST_F(WindowTest, WithoutADisplayAPresetThatIsNotThereIsSaidFirst)
{
  EXPECT_EQ(shell("env -u DISPLAY -u WAYLAND_DISPLAY " + program + " " + quoted("nope.json"), log), 2);
  EXPECT_THAT(read_file(log), HasSubstr("there is no preset"));
}

TEST_F(WindowTest, ALayoutThatThereIsNotIsBadUsage)
{
  EXPECT_EQ(shell("env -u DISPLAY " + program + " --layout sideways --frames 1", log), 2);
  EXPECT_THAT(read_file(log), HasSubstr("sideways"));
}

TEST_F(WindowTest, ShowsThePixelsThatARunWrites)
{
  if (!there_is("xvfb-run")) GTEST_SKIP() << "no xvfb-run";
  const std::string file = folder.write("test.json", test::preset_text);
  ASSERT_EQ(shell(program + " run '" + file + "' -o " + quoted("out"), log), 0) << read_file(log);
  const std::string options =
      " --size 900x700 --frames 5 --until 1 --screenshot " + quoted("screen.png") + " --frame-times " + quoted("times.csv");
  ASSERT_EQ(shell(on_display() + program + " '" + file + "'" + options, log), 0) << read_file(log);
  const image::Image screen = image::read_image(folder.path() / "screen.png");
  const image::Image written = image::read_image(folder.path() / "out/image.png");
  ASSERT_EQ(screen.width, 900);
  ASSERT_EQ(screen.height, 700);
  const Placement p = placement_in_window(900, 700, {written.width, written.height});
  ASSERT_GT(p.scale, 3) << "pixels are squares";
  int different = 0, brightest = 0;
  // The mouse rests over the picture: the value under it is shown over the lower left corner.
  for (int y = 0; y < written.height * 3 / 4; ++y)
    for (int x = 0; x < written.width; ++x) {
      const Point at = p.to_screen({x + 0.5, y + 0.5});
      const auto shown = bytes_at(screen, at[0], at[1]), expected = bytes_at(written, x, y);
      different += shown != expected;
      brightest = std::max(brightest, expected[1]);
    }
  EXPECT_GT(brightest, 50) << "the picture is not black";
  EXPECT_EQ(different, 0);
  EXPECT_THAT(read_file(folder.path() / "times.csv"), StartsWith("frame,draw_ms,period_ms,state,fraction\n0,"));
}

TEST_F(WindowTest, AScreenshotOfAnErrorIsWrittenAndHasTheErrorsExitCode)
{
  if (!there_is("xvfb-run")) GTEST_SKIP() << "no xvfb-run";
  const std::string options = " --frames 3 --until 1 --screenshot " + quoted("screen.png");
  EXPECT_EQ(shell(on_display() + program + " " + quoted("missing.json") + options, log), 2);
  EXPECT_THAT(read_file(log), HasSubstr("there is no preset"));
  EXPECT_EQ(image::read_image(folder.path() / "screen.png").width, 1280);
  std::filesystem::remove(folder.path() / "screen.png");
  EXPECT_EQ(shell(on_display() + program + " '" + folder.write("test.json", test::preset_text) + "' --device abacus" + options, log), 3);
  EXPECT_THAT(read_file(log), HasSubstr("abacus"));
  EXPECT_EQ(image::read_image(folder.path() / "screen.png").width, 1280);
}

TEST_F(WindowTest, WhatCannotBePinnedIsSaid)
{
  if (!there_is("xvfb-run")) GTEST_SKIP() << "no xvfb-run";
  const std::string preset = folder.write("test.json", test::preset_text);
  std::filesystem::create_directory(folder.path() / "empty");
  folder.write("a.png", "no picture");
  const std::string options = " --frames 1 --screenshot " + quoted("screen.png");
  for (const char* name : {"nosuchrun", "empty", "a.png", "test.json"}) {
    EXPECT_EQ(shell(on_display() + program + " '" + preset + "' " + quoted(name) + options, log), 2) << name;
    const std::string said = read_file(log);
    EXPECT_THAT(said, HasSubstr("\nnephroid: " + (folder.path() / name).string() + ": ")) << name;
    EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 2) << "the frames' times, then one line: " << said;
  }
}

TEST_F(WindowTest, FollowsRealEvents)
{
  if (!there_is("xvfb-run") || !there_is("xdotool")) GTEST_SKIP() << "no xvfb-run or no xdotool";
  // A run that does not end by itself; an orbit, a resize, a cancel, save, quit.
  preset::Preset endless = preset::parse_preset(test::preset_text, "test");
  endless.scene.materials["glass"].type = preset::Material::Type::dielectric;
  preset::Object ball;
  ball.name = "ball";
  ball.material = "glass";
  ball.shape = preset::Shape{};
  ball.shape->radius = 0.3;
  ball.transform.translate = {0, 0, 0.5};
  endless.scene.objects.push_back(ball);
  endless.stop.passes.reset();
  endless.stop.seconds = 3600;
  const std::string file = folder.write("test.json", preset::to_json(endless));
  const std::string options = "--size 900x700 --frame-times " + quoted("times.csv");
  const std::string events = R"(drag 450 350 610 350
xdotool windowsize $id 1000 800
sleep 1
chord s
xdotool key Escape
sleep 1
chord q)";
  ASSERT_EQ(play(file, options, events), 0) << read_file(log);
  const preset::Preset saved = preset::read_preset(file);
  EXPECT_LT(saved.scene.camera.position[0], -0.5) << "the scene was turned to the right, the camera to the left";
  EXPECT_NEAR(saved.scene.camera.position[1], 0, 0.05);
  const image::Image screen = image::read_image(folder.path() / "screen.png");
  EXPECT_EQ(screen.width, 1000);
  EXPECT_EQ(screen.height, 800);
  const std::string times = read_file(folder.path() / "times.csv");
  EXPECT_THAT(times, HasSubstr("running"));
  EXPECT_THAT(times.substr(times.rfind('\n', times.size() - 2) + 1), HasSubstr("cancelled"));
}

} // namespace
} // namespace nephroid::ui
