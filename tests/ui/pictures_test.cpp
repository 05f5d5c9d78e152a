// SPDX-License-Identifier: Apache-2.0
// Pictures of other programs in the window: opened, listed, chosen by keys, beside the run's picture or cut at a line,
// and measured. The run's picture is (0, 0, 4) everywhere, 64 x 48.
#include "base/files.h"
#include "image/image.h"
#include "measure/read_picture.h"
#include "ui/runs/panel.h"
#include "ui/state/session_keeper.h"
#include "window_fixture.h"

namespace nephroid::ui::pictures_test {

constexpr std::array size{64, 48};

class PicturesTest : public test::WindowFixture {
protected:
  PicturesTest() : WindowFixture("runs") {}

  /// An EXR file with these channels, each of one value.
  std::string exr(const std::string& name, const std::vector<std::pair<std::string, float>>& channels,
                  const std::array<int, 2>& of = size) {
    image::Image picture{of[0], of[1], {}, {}, {}};
    for (const auto& [channel, value] : channels) picture.channels.push_back(channel);
    for (int i = 0; i < of[0] * of[1]; ++i)
      for (const auto& [channel, value] : channels) picture.data.push_back(value);
    const std::filesystem::path file = folder.path() / name;
    image::write_exr(file, picture);
    return file.string();
  }
  std::string even(const std::string& name, const std::array<float, 3>& rgb, const std::array<int, 2>& of = size) {
    return exr(name, {{"R", rgb[0]}, {"G", rgb[1]}, {"B", rgb[2]}}, of);
  }
  const std::vector<PinnedRun>& pins() const { return workbench.comparing().pinned().all(); }
  const Comparison& comparison() const { return workbench.comparing().comparison(); }
  const RunsPanel& panel() const { return workspace.panel<RunsPanel>(); }
  /// Its id.
  std::uint64_t open_picture(const std::string& file) {
    const std::size_t before = pins().size();
    workbench.apply({command::PinFile{file, true}});
    EXPECT_TRUE(until([&] { return pins().size() == before + 1; })) << file;
    frames(3);
    return pins().empty() ? 0 : pins().back().id;
  }
  /// What is said of a file that cannot be opened.
  std::string refusal(const std::string& file) {
    workbench.apply({command::PinFile{file, true}});
    EXPECT_TRUE(until_files_are_done());
    frame();
    EXPECT_TRUE(pins().empty());
    return test::last_message(workbench);
  }
  std::array<int, 3> texel(const PictureTexture& texture) const {
    return {texture.pixels()[0], texture.pixels()[1], texture.pixels()[2]};
  }
  Point on_screen(const Point& pixel) const {
    return place(workbench.view_state().view_settings, view().canvas(), view().shown().size)
        .to_screen({pixel[0] + 0.5, pixel[1] + 0.5});
  }
  bool until_measured() {
    return until([&] { return workbench.comparing().metrics() != nullptr; });
  }
};

TEST_F(PicturesTest, AnOpenedPictureIsListedAndShown) {
  run_through();
  const std::string file = even("mitsuba.exr", {1, 0, 0}, {32, 16});
  const std::uint64_t id = open_picture(file);
  EXPECT_THAT(test::only_message(workbench), HasSubstr("opened mitsuba.exr, 32 x 16 (floats, linear)"));
  EXPECT_EQ(comparison().shown, id);
  EXPECT_EQ(view().shown().label, "\"mitsuba.exr\"");
  EXPECT_EQ(view().shown().size, (std::array{32, 16})) << "it has a size of its own";
  EXPECT_EQ(texel(view().texture()), (std::array{255, 0, 0}));
  ASSERT_THAT(panel().rows(), SizeIs(2));
  EXPECT_EQ(panel().rows()[1].name, "mitsuba.exr");
  EXPECT_EQ(panel().rows()[1].seconds, "32 x 16");
  EXPECT_EQ(workspace.panel<ErrorPanel>().contents().runs.size(), 0u) << "it has no history";
  click_in(panel(), fmt::format("unpin {}", id), 3);
  EXPECT_TRUE(pins().empty());
  EXPECT_EQ(texel(view().texture()), (std::array{0, 0, 255}));
  EXPECT_EQ(runs.made, 1) << "no new run";
}

TEST_F(PicturesTest, KeysChooseWhatIsShownAndWhatItIsComparedWith) {
  run_through();
  const std::uint64_t red = open_picture(even("red.exr", {1, 0, 0})),
                      green = open_picture(even("green.exr", {0, 1, 0}));
  press(ImGuiKey_2);
  EXPECT_EQ(comparison().shown, red);
  press(ImGuiKey_3);
  EXPECT_EQ(comparison().shown, green);
  press(ImGuiKey_1);
  EXPECT_EQ(comparison().shown, 0u);
  press(ImGuiKey_DownArrow);
  EXPECT_EQ(comparison().shown, red);
  press(ImGuiKey_UpArrow);
  press(ImGuiKey_UpArrow);
  EXPECT_EQ(comparison().shown, green) << "round again";
  press(ImGuiKey_2, ImGuiMod_Shift);
  EXPECT_EQ(comparison().pin, red);
  press(ImGuiKey_1, ImGuiMod_Shift);
  EXPECT_EQ(comparison().pin, Comparison::run_in_hand);
  press(ImGuiKey_N);
  EXPECT_EQ(comparison().pin, red) << "not the one that is shown";
  imgui.key(ImGuiKey_R, true);
  frames(3);
  EXPECT_EQ(texel(view().texture()), (std::array{255, 0, 0}));
  imgui.key(ImGuiKey_R, false);
  frame();
  press(ImGuiKey_7);
  EXPECT_EQ(comparison().shown, green);
  EXPECT_THAT(test::last_message(workbench), HasSubstr("Picture 7: the last picture is 3"));
  click_in(panel(), fmt::format("show {}", red), 3);
  click_in(panel(), fmt::format("compare {}", green), 3);
  EXPECT_EQ(comparison().shown, red);
  EXPECT_EQ(comparison().pin, green);
}

TEST_F(PicturesTest, AnOpenedPictureIsMovedWithoutACamera) {
  run_through();
  open_picture(even("red.exr", {1, 0, 0}));
  const preset::Camera before = camera();
  const Point at = on_screen({10, 10});
  drag(0, 20, 10);
  EXPECT_NEAR(on_screen({10, 10})[0], at[0] + 20, 1.01);
  EXPECT_NEAR(on_screen({10, 10})[1], at[1] + 10, 1.01);
  const double zoom = workbench.view_state().view_settings.zoom;
  move(middle());
  imgui.wheel(2);
  frames(2);
  EXPECT_NEAR(workbench.view_state().view_settings.zoom, 1.21 * zoom, 1e-3 * zoom);
  EXPECT_EQ(camera(), before);
  EXPECT_FALSE(workbench.edits()->modified());
}

TEST_F(PicturesTest, SplitsTwoPicturesAtALineThatIsDragged) {
  run_through();
  edit([](preset::Preset& p) { p.display = {preset::Display::Gamut::clip, preset::Display::Tone::clip}; });
  const std::uint64_t red = open_picture(even("red.exr", {1, 0, 0}));
  press(ImGuiKey_1);
  apply({command::CompareWith{red}});
  press(ImGuiKey_C);
  EXPECT_EQ(comparison().arrangement, Arrangement::split);
  EXPECT_EQ(texel(view().texture()), (std::array{0, 0, 255}));
  EXPECT_EQ(texel(view().texture_beside()), (std::array{255, 0, 0}));
  EXPECT_EQ(view().shown().label, "this run");
  EXPECT_EQ(view().beside().label, "\"red.exr\"");
  const Canvas canvas = view().canvas();
  const Point line = view().place_of("line").value();
  EXPECT_NEAR(line[0], canvas.corner[0] + canvas.size[0] / 2, 1);
  const preset::Camera before = camera();
  drag_by(line, 0.25 * canvas.size[0]);
  frames(2);
  EXPECT_NEAR(comparison().split, 0.75, 0.01);
  EXPECT_NEAR(view().place_of("line").value()[0], canvas.corner[0] + 0.75 * canvas.size[0], 2);
  EXPECT_EQ(camera(), before) << "the line has the mouse";
  // Values of both on both sides of the line.
  for (const double side : {-40, 40}) {
    move({view().place_of("line").value()[0] + side, middle()[1]});
    frame();
    EXPECT_THAT(view().pixel_value(), AllOf(HasSubstr("R 0   G 0   B 4"), HasSubstr("\"red.exr\"   R 1   G 0   B 0")));
  }
  drag_by(view().place_of("line").value(), 3 * canvas.size[0]);
  frames(2);
  EXPECT_EQ(comparison().split, 1) << "it stays in the panel";
  press(ImGuiKey_C);
  EXPECT_EQ(comparison().arrangement, Arrangement::single);
  EXPECT_FALSE(view().place_of("line"));
}

TEST_F(PicturesTest, TwoSideBySideHaveTheSameZoomAndPixel) {
  run_through();
  image::Image ramp{64, 48, {"R", "G", "B"}, {}, {}};
  for (int i = 0; i < 64 * 48; ++i)
    ramp.data.insert(ramp.data.end(), {static_cast<float>(i % 64), static_cast<float>(i / 64), 0});
  image::write_exr(folder.path() / "ramp.exr", ramp);
  const std::uint64_t id = open_picture((folder.path() / "ramp.exr").string());
  apply({command::ShowPicture{}, command::CompareWith{id}});
  press(ImGuiKey_V);
  ASSERT_GT(view().shift(), 50);
  const Point left = on_screen({20, 10}), right{left[0] + view().shift(), left[1]};
  for (const Point& at : {left, right}) {
    move(at);
    frame();
    EXPECT_THAT(view().pixel_value(), StartsWith("(20, 10)   R 0   G 0   B 4"));
    EXPECT_THAT(view().pixel_value(), HasSubstr("\"ramp.exr\"   R 20   G 10   B 0"));
  }
  // Zoomed about the cursor on the right one, the pixel under it stays on both sides.
  imgui.key(ImGuiMod_Ctrl, true);
  imgui.wheel(5);
  frames(2);
  imgui.key(ImGuiMod_Ctrl, false);
  frame();
  EXPECT_THAT(view().pixel_value(), StartsWith("(20, 10)"));
  EXPECT_NEAR(on_screen({20, 10})[0], left[0], 3);
  imgui.key(ImGuiMod_Alt, true);
  click(right);
  imgui.key(ImGuiMod_Alt, false);
  frame();
  EXPECT_EQ(workbench.view_state().pixel, (std::optional(std::array{20, 10}))) << "a pixel is inspected in either";
}

TEST_F(PicturesTest, MetricsAreOfTheShownAgainstTheCompared) {
  run_through();
  const std::string file = even("other.exr", {0, 0, 3});
  const std::uint64_t id = open_picture(file);
  apply({command::CompareWith{Comparison::run_in_hand}});
  ASSERT_TRUE(until_measured());
  EXPECT_NEAR(workbench.comparing().metrics()->metrics.rel_l2, 0.25, 1e-6) << "|3 - 4| / |4|";
  apply({command::ShowPicture{}, command::CompareWith{id}, command::Arrange{Arrangement::split}});
  ASSERT_TRUE(until_measured());
  EXPECT_NEAR(workbench.comparing().metrics()->metrics.rel_l2, 1.0 / 3, 1e-6) << "|4 - 3| / |3|";
  ASSERT_TRUE(until([&] { return workbench.comparing().all_metrics() != nullptr; }));
  // As the command line has them.
  const measure::LinearPicture other = measure::read_linear_rgb(file);
  const measure::Metrics expected = measure::compare(workbench.comparing().picture().pixels, other.pixels());
  EXPECT_EQ(workbench.comparing().all_metrics()->metrics.flip, expected.flip);
  EXPECT_EQ(workbench.comparing().metrics()->metrics.lab_mean, expected.lab_mean);
  frames(2);
  action("Copy metrics").run(context());
  const std::string text = ImGui::GetClipboardText();
  EXPECT_THAT(text, StartsWith("this run to \"other.exr\" (floats, linear); linear sRGB, 1 is white\n"));
  EXPECT_THAT(text, HasSubstr(fmt::format("rel_l2\t{:.6g}\t", expected.rel_l2)));
  EXPECT_THAT(text, HasSubstr(fmt::format("flip\t{:.6g}\t", *expected.flip)));
  EXPECT_TRUE(view().place_of("metrics"));
  apply({command::Arrange{}});
  EXPECT_FALSE(view().place_of("metrics"));
}

TEST_F(PicturesTest, OneOfAnotherSizeIsShownAndSaidNotToBeMeasured) {
  run_through();
  edit([](preset::Preset& p) { p.display = {preset::Display::Gamut::clip, preset::Display::Tone::clip}; });
  const std::uint64_t id = open_picture(even("small.exr", {1, 0, 0}, {32, 16}));
  apply({command::ShowPicture{}, command::CompareWith{id}, command::Arrange{Arrangement::side_by_side}});
  EXPECT_EQ(texel(view().texture_beside()), (std::array{255, 0, 0}));
  EXPECT_EQ(view().beside().hint, "");
  EXPECT_EQ(workbench.comparing().why_not(), "\"small.exr\" is 32 x 16, the picture 64 x 48");
  frames(10);
  EXPECT_EQ(workbench.comparing().metrics(), nullptr);
  move(on_screen({50, 30}));
  frame();
  EXPECT_THAT(view().pixel_value(), HasSubstr("\"small.exr\"   outside of it"));
  apply({command::ShowPicture{id}, command::CompareWith{Comparison::run_in_hand}});
  EXPECT_EQ(workbench.comparing().why_not(), "the run's picture is 64 x 48, \"small.exr\" 32 x 16");
  apply({command::InspectPixel{std::array{50, 30}}, command::SelectRegion{PixelRegion{{0, 0}, {64, 48}}}});
  EXPECT_EQ(pixel_text(context(), {60, 40}).find("outside of it"), std::string("(60, 40)   ").size());
  EXPECT_TRUE(test::last_message(workbench).starts_with("opened"));
}

TEST_F(PicturesTest, ABrokenPictureIsSaidInOneLine) {
  run_through();
  const std::string whole = read_file(even("whole.exr", {1, 0, 0}));
  EXPECT_THAT(refusal(folder.write("cut.exr", whole.substr(0, whole.size() / 2))),
              HasSubstr("cut.exr: is no picture that can be read"));
  EXPECT_THAT(refusal(folder.write("text.png", "no picture")), HasSubstr("text.png: is no picture that can be read"));
  EXPECT_THAT(refusal((folder.path() / "gone.exr").string()), HasSubstr("gone.exr"));
  EXPECT_THAT(refusal(exr("depth.exr", {{"Z", 1}})),
              HasSubstr("depth.exr: has the channels Z; expected R, G, B or Y alone"));
  for (const Message& message : workbench.messages())
    EXPECT_EQ(message.line.find('\n'), std::string::npos) << message.line;
}

TEST_F(PicturesTest, OtherChannelsAreReadAsTheyCanBe) {
  run_through();
  open_picture(exr("grey.exr", {{"Y", 1}}));
  EXPECT_EQ(pins().back().read_as, "floats, linear, grey");
  EXPECT_EQ(texel(view().texture()), (std::array{255, 255, 255}));
  open_picture(
      exr("layers.exr",
          {{"caustic.R", 0}, {"caustic.G", 1}, {"caustic.B", 0}, {"direct.R", 1}, {"direct.G", 0}, {"direct.B", 0}}));
  EXPECT_EQ(pins().back().read_as, "floats, linear, layer caustic");
  EXPECT_EQ(texel(view().texture()), (std::array{0, 255, 0}));
  apply({command::ShowLayer{"direct"}});
  EXPECT_EQ(texel(view().texture()), (std::array{255, 0, 0}));
  apply({command::ShowLayer{}});
  // Mitsuba 3, with the integrator aov: R, G, B, A and what else it was asked for.
  open_picture(
      exr("aov.exr", {{"R", 0}, {"G", 1}, {"B", 1}, {"A", 1}, {"dd.y", 3}, {"nn.X", 0}, {"nn.Y", 0}, {"nn.Z", 1}}));
  EXPECT_EQ(pins().back().read_as, "floats, linear");
  EXPECT_EQ(texel(view().texture()), (std::array{0, 255, 255}));
}

TEST_F(PicturesTest, IntegersAreDecoded) {
  run_through();
  // sRGB .5 of 16 bits, as a display shows it: .2140 linear (IEC 61966-2-1).
  write_file_whole(folder.path() / "half.png", [](ByteSink& to) {
    image::write_png16(to, size[0], size[1], std::vector<std::uint16_t>(std::size_t{64} * 48, 32768), "");
  });
  open_picture((folder.path() / "half.png").string());
  EXPECT_EQ(pins().back().read_as, "sRGB integers, decoded, grey");
  EXPECT_NEAR(pins().back().picture->rgb[0], 0.2140, 1e-4);
  EXPECT_EQ(texel(view().texture()), (std::array{128, 128, 128}));
}

TEST_F(PicturesTest, ANotANumberIsShownButNotMeasured) {
  run_through();
  image::Image picture{64, 48, {"R", "G", "B"}, std::vector<float>(std::size_t{3} * 64 * 48, 1), {}};
  picture.data[3 * (64 * 2 + 5)] = std::numeric_limits<float>::quiet_NaN();
  image::write_exr(folder.path() / "hole.exr", picture);
  open_picture((folder.path() / "hole.exr").string());
  apply({command::CompareWith{Comparison::run_in_hand}});
  ASSERT_TRUE(until_measured());
  EXPECT_THAT(workbench.comparing().metrics()->error,
              AllOf(HasSubstr("hole.exr"), HasSubstr("5, 2"), Not(HasSubstr("\n"))));
  EXPECT_THAT(pixel_text(context(), {5, 2}), HasSubstr("R nan"));
  frames(80);
  EXPECT_THAT(test::only_message(workbench), Not(HasSubstr("|"))) << "nothing but that it was opened";
}

TEST_F(PicturesTest, AWidePictureIsMeasuredThoughNoTextureHoldsIt) {
  ImGui::GetPlatformIO().Renderer_TextureMaxWidth = ImGui::GetPlatformIO().Renderer_TextureMaxHeight = 16384;
  run_through();
  const std::array<int, 2> wide{30000, 2};
  const std::uint64_t a = open_picture(even("a.exr", {1, 0, 0}, wide));
  EXPECT_THAT(view().shown().hint,
              StartsWith("The picture is 30000 x 2; this display's OpenGL shows at most 16384 x 16384."));
  open_picture(even("b.exr", {2, 0, 0}, wide));
  apply({command::CompareWith{a}});
  ASSERT_TRUE(until_measured());
  EXPECT_NEAR(workbench.comparing().metrics()->metrics.rel_l2, 1, 1e-6);
}

TEST_F(PicturesTest, AreDroppedOnTheListAndPickedInTheDialog) {
  run_through();
  const std::string file = even("sky.exr", {1, 0, 0});
  move(middle());
  EXPECT_TRUE(std::holds_alternative<command::Open>(workspace.dropped(file))) << "on the View it is an environment";
  move(panel().place_of("show 0").value());
  const Command dropped = workspace.dropped(file);
  ASSERT_TRUE(std::holds_alternative<command::PinFile>(dropped));
  workbench.apply({dropped});
  ASSERT_TRUE(until([&] { return pins().size() == 1; }));
  EXPECT_FALSE(workbench.edits()->modified());
  EXPECT_TRUE(std::holds_alternative<command::Open>(workspace.dropped(folder.write("a.obj", ""))));
  // A PNG that the engine has no use for is opened wherever it is dropped.
  image::write_png(folder.path() / "b.png", 2, 2, std::vector<float>(12, 1));
  workbench.apply({command::Open{(folder.path() / "b.png").string()}});
  ASSERT_TRUE(until([&] { return pins().size() == 2; }));
  apply({command::Ask{Question::open_pictures}});
  ASSERT_TRUE(until([&] { return workspace.dialogs().files().entries().size() == 2; }));
  const auto entry = workspace.dialogs().files().place_of("b.png");
  ASSERT_TRUE(entry);
  for (int twice = 0; twice < 2; ++twice) press_at(*entry), let_go();
  ASSERT_TRUE(until([&] { return pins().size() == 3; }));
  EXPECT_EQ(pins()[2].name, "b.png (2)");
  EXPECT_EQ(workbench.questions().question(), Question::none);
}

TEST_F(PicturesTest, AreOpenedAgainWithTheSession) {
  run_through();
  open_picture(even("red.exr", {1, 0, 0}));
  test::FakeRuns other_runs;
  Workbench other(other_runs);
  reopen_in(other);
  ASSERT_TRUE(test::eventually([&] { other.update(); }, [&] { return other.comparing().pinned().all().size() == 1; }));
  const PinnedRun& pin = other.comparing().pinned().all()[0];
  EXPECT_EQ(pin.name, "red.exr");
  EXPECT_FALSE(pin.is_run());
  EXPECT_EQ(pin.picture->rgb[0], 1);
  EXPECT_EQ(other.comparing().comparison().shown, 0u);
}

TEST_F(PicturesTest, MetricsOfLargePicturesHoldNoFrameUp) {
  run_through();
  const std::array<int, 2> large{2048, 2048};
  const std::uint64_t a = open_picture(even("a.exr", {0.5f, 0.2f, 0.1f}, large));
  open_picture(even("b.exr", {0.5f, 0.25f, 0.1f}, large));
  workbench.apply({command::CompareWith{a}});
  double longest = 0;
  ASSERT_TRUE(until([&] {
    const double before = test::thread_ms();
    frame();
    longest = std::max(longest, test::thread_ms() - before);
    return workbench.comparing().all_metrics() != nullptr;
  }));
  fmt::print("longest frame while 2048 x 2048 were measured: {:.1f} ms of the window's thread\n", longest);
  EXPECT_LT(longest, 100 * test::slowness());
}

} // namespace nephroid::ui::pictures_test
