// SPDX-License-Identifier: Apache-2.0
// How the View shows a picture: layers, tone curves, false colour; and that a picture is saved as it is shown.
#include "image/image.h"
#include "layered_runs.h"
#include "run/display.h"
#include "ui/state/tone.h"
#include "ui/view/pinhole.h"
#include "window_fixture.h"

namespace nephroid::ui::looks_test {

class LooksTest : public test::WindowFixtureOf<test::LayeredRuns> {
protected:
  void SetUp() override { run_through(); }
  std::array<int, 3> texel(int x, int y) {
    const auto pixels = view().texture().pixels().subspan(4 * static_cast<std::size_t>(64 * y + x));
    return {pixels[0], pixels[1], pixels[2]};
  }
  static std::array<int, 3> bytes(float r, float g, float b) {
    return {image::shown(r), image::shown(g), image::shown(b)};
  }
  const std::string& layer() { return workbench.comparing().comparison().layer; }
  const ViewSettings& view_settings() { return workbench.view_state().view_settings; }
  void click_on(const std::string& widget) { click_in(view(), widget, 2); }
  image::Image saved(const std::string& name) {
    const fs::path file = folder.path() / name;
    workbench.apply({command::SavePicture{file}});
    EXPECT_TRUE(until_files_are_done());
    return image::read_image(file);
  }
  /// The picture's file holds what the texture shows.
  void expect_saved_as_shown(const std::string& name) {
    const image::Image file = saved(name);
    ASSERT_EQ(file.width, 64);
    ASSERT_EQ(file.height, 48);
    const std::size_t channels = file.channels.size();
    for (const auto& [x, y] : {std::array{0, 0}, std::array{40, 11}, std::array{63, 47}})
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_EQ(std::lround(255 * file.data[channels * static_cast<std::size_t>(64 * y + x) + c]), texel(x, y)[c])
            << name;
  }
};

TEST_F(LooksTest, AKeyGoesThroughTheLayers) {
  edit([](preset::Preset& p) { p.display.tone = preset::Display::Tone::clip; });
  frames(2);
  EXPECT_EQ(texel(32, 12), bytes(0.75f, 0.75f, 0.125f));
  const std::pair<const char*, std::array<int, 3>> layers[] = {
      {"direct", bytes(0.25f, 0.5f, 0.125f)}, {"caustic", bytes(0.5f, 0.25f, 0)}, {"", bytes(0.75f, 0.75f, 0.125f)}};
  for (const auto& [name, colour] : layers) {
    press(ImGuiKey_L);
    EXPECT_EQ(layer(), name);
    EXPECT_EQ(view().shown().label, name);
    EXPECT_EQ(texel(32, 12), colour);
  }
  press(ImGuiKey_L, ImGuiMod_Shift);
  EXPECT_EQ(layer(), "caustic") << "back";
  EXPECT_EQ(runs.made, 1) << "no new run";
  EXPECT_TRUE(workbench.open(folder.write("other.json", test::preset_text)));
  EXPECT_EQ(layer(), "") << "another preset, another picture";
}

TEST_F(LooksTest, TheBoxesChooseLayerAndTone) {
  click_on("layer");
  click_on("layer:caustic");
  EXPECT_EQ(layer(), "caustic");
  click_on("tone");
  click_on("tone:filmic");
  EXPECT_EQ(workbench.preset()->display.tone, preset::Display::Tone::filmic);
  click_on("tone");
  click_on("tone:false colour");
  EXPECT_TRUE(view_settings().false_colour);
  EXPECT_FALSE(view_settings().range) << "automatic";
  click_on("auto range");
  ASSERT_TRUE(view_settings().range);
  EXPECT_EQ(view_settings().range, view().tone().false_colour) << "as it was";
  click_on("auto range");
  EXPECT_FALSE(view_settings().range);
  click_on("tone");
  click_on("tone:clip");
  EXPECT_FALSE(view_settings().false_colour);
  click_on("gamut");
  click_on("gamut:clip");
  click_on("white balance");
  click_on("white balance:light");
  EXPECT_EQ(workbench.preset()->display, (preset::Display{preset::Display::Gamut::clip, preset::Display::Tone::clip,
                                                          preset::Display::WhiteBalance::light}));
  EXPECT_EQ(runs.made, 1) << "no new run";
  EXPECT_FALSE(workbench.run().snapshot_is_previous());
}

TEST_F(LooksTest, ARangeIsTyped) {
  apply({command::SetViewSettings{{.false_colour = true, .range = LuminanceRange{0.01, 1}}}});
  const auto type = [&](const std::string& field, const char* text) {
    click_on(field);
    retype(text);
    press(ImGuiKey_Enter);
  };
  type("high", "50");
  EXPECT_EQ(*view_settings().range, (LuminanceRange{0.01, 50}));
  type("low", "0.5");
  EXPECT_EQ(*view_settings().range, (LuminanceRange{0.5, 50}));
  type("low", "60");
  EXPECT_EQ(*view_settings().range, (LuminanceRange{0.5, 50})) << "the low end is not above the high one";
  EXPECT_THAT(only_message(workbench), HasSubstr("0 < low < high"));
}

TEST_F(LooksTest, RangesThatAreNoneAreNotTaken) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (const LuminanceRange& range : {LuminanceRange{nan, 1}, LuminanceRange{1, infinity}, LuminanceRange{0, -1}}) {
    workbench.apply({command::SetViewSettings{{.false_colour = true, .range = range}}});
    EXPECT_FALSE(view_settings().range);
    frames(2);
  }
  workbench.apply({command::SetViewSettings{{.false_colour = true, .range = LuminanceRange{5, 1}}}});
  ASSERT_TRUE(view_settings().range);
  EXPECT_LT(view_settings().range->low, view_settings().range->high);
  EXPECT_TRUE(workbench.messages().empty());
}

TEST_F(LooksTest, AKeyGoesThroughTheToneCurvesOfThePreset) {
  using Curve = preset::Display::Tone;
  const auto tone = [&] { return workbench.preset()->display.tone; };
  press(ImGuiKey_T);
  EXPECT_EQ(tone(), Curve::filmic);
  const auto filmic = image::displayed({0.75f, 0.75f, 0.125f}, {.display = run::display_of(*workbench.preset())});
  EXPECT_EQ(texel(32, 12), bytes(filmic[0], filmic[1], filmic[2]));
  EXPECT_LT(filmic[0], 0.5f);
  press(ImGuiKey_T);
  EXPECT_EQ(tone(), Curve::clip);
  EXPECT_EQ(texel(32, 12), bytes(0.75f, 0.75f, 0.125f));
  press(ImGuiKey_T);
  EXPECT_EQ(tone(), Curve::reinhard);
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_EQ(tone(), Curve::clip);
  EXPECT_EQ(runs.made, 1) << "no new run";
  EXPECT_EQ(workbench.run().snapshot_origin().preset->display.tone, Curve::clip) << "as its files say";
  apply({command::SetViewSettings{{.false_colour = true}}});
  // (32, 12) is (.75, .75, .125): Y = .2126 .75 + .7152 .75 + .0722 .125 = .7049
  const Rgb8 wanted = luminance_colour(0.704875, *view().tone().false_colour);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(texel(32, 12)[c], wanted[c], 2);
}

TEST_F(LooksTest, AnotherEditAfterOneOfTheDisplayStartsARun) {
  press(ImGuiKey_T);
  edit([](preset::Preset& p) { p.seed += 1; });
  EXPECT_TRUE(until([&] { return runs.made == 2; }));
}

TEST_F(LooksTest, FalseColourIsInWattsWhateverTheExposure) {
  apply({command::SetViewSettings{{.false_colour = true, .range = LuminanceRange{0.1, 10}}}});
  const std::array<int, 3> before = texel(32, 12);
  press(ImGuiKey_E);
  EXPECT_EQ(view_settings().exposure_stops, 0.5);
  EXPECT_EQ(texel(32, 12), before);
  edit([&](preset::Preset& p) { p.white = 2; }); // the same numbers are twice the light
  frames(3);
  const Rgb8 wanted = luminance_colour(2 * 0.704875, {0.1, 10});
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(texel(32, 12)[c], wanted[c], 2);
}

TEST_F(LooksTest, KeysOfOneFrameDoNotUndoEachOther) {
  imgui.key(ImGuiKey_E, true);
  imgui.key(ImGuiKey_T, true);
  imgui.key(ImGuiKey_L, true);
  frame();
  EXPECT_EQ(view_settings().exposure_stops, 0.5);
  EXPECT_EQ(workbench.preset()->display.tone, preset::Display::Tone::filmic);
  EXPECT_EQ(layer(), "direct");
}

TEST_F(LooksTest, PicturesAreSavedAsShown) {
  expect_saved_as_shown("standard.png");
  for (const ImGuiKey key : {ImGuiKey_E, ImGuiKey_L, ImGuiKey_T, ImGuiKey_T}) {
    press(key);
    expect_saved_as_shown("picture.png");
  }
  apply({command::SetViewSettings{{.false_colour = true}}});
  expect_saved_as_shown("picture.png");
  EXPECT_THAT(last_message(workbench), HasSubstr("W/m2/sr"));
  EXPECT_THAT(saved("linear.exr").channels, SizeIs(9)) << "the whole picture with both layers, whatever is shown";
}

TEST_F(LooksTest, ALayerThatThePictureDoesNotHaveIsSaid) {
  apply({command::ShowLayer{"indirect"}});
  EXPECT_THAT(view().shown().hint, HasSubstr("has no layer \"indirect\", only direct, caustic"));
  workbench.apply({command::SavePicture{folder.path() / "none.png"}});
  ASSERT_TRUE(until_files_are_done());
  EXPECT_FALSE(fs::exists(folder.path() / "none.png"));
  EXPECT_THAT(last_message(workbench), HasSubstr("nothing to save"));
  press(ImGuiKey_L);
  EXPECT_EQ(layer(), "direct");
}

TEST_F(LooksTest, PinnedRunsHaveTheirLayers) {
  press(ImGuiKey_P);
  press(ImGuiKey_N);
  apply({command::ShowLayer{"caustic"}, command::Flip{}});
  EXPECT_EQ(texel(32, 12), bytes(0.5f, 0.25f, 0));
  EXPECT_EQ(view().shown().label, "\"Test\": caustic");
}

class LooksWithReference : public LooksTest {
protected:
  void SetUp() override {
    runs.reference = test::even_reference({1, 1, 1}, {0.5f, 0, 0});
    LooksTest::SetUp();
  }
};

TEST_F(LooksWithReference, TheReferenceShowsTheSameLayer) {
  apply({command::ShowLayer{"caustic"}, command::Flip{}});
  EXPECT_EQ(texel(32, 12), bytes(0.5f, 0, 0));
  apply({command::ShowLayer{"direct"}});
  EXPECT_THAT(view().shown().hint, HasSubstr("the reference has no layer \"direct\", only caustic"));
  apply({command::ShowLayer{}});
  EXPECT_EQ(texel(32, 12), bytes(1, 1, 1));
}

TEST_F(LooksWithReference, TheDifferenceIsThatOfTheLayer) {
  workbench.apply({command::ShowLayer{"caustic"}, command::ShowDifference{true, measure::DifferenceMetric::absolute}});
  const auto at = [&] { return (*workbench.comparing().difference()->values)[64 * 12 + 32]; };
  ASSERT_TRUE(until([&] { return workbench.comparing().difference() != nullptr; }));
  EXPECT_NEAR(at(), 0.25 / 3, 1e-6) << "(.5, .25, 0) - (.5, 0, 0)";
  frames(2);
  expect_saved_as_shown("difference.png");
  workbench.apply({command::ShowLayer{}});
  ASSERT_TRUE(until([&] { return at() > 0.2; }));
  EXPECT_NEAR(at(), (0.25 + 0.25 + 0.875) / 3, 1e-6) << "(.75, .75, .125) - (1, 1, 1)";
}

TEST_F(LooksTest, TheCameraIsCopiedAsTextThatPresetsTake) {
  edit([](preset::Preset& p) { p.scene.camera.position = {1.5, -0.25, 3}, p.scene.camera.fov_deg = 31; });
  const auto copied = [&](const char* name) {
    action(name).run(context());
    return std::string(ImGui::GetClipboardText());
  };
  EXPECT_THAT(copied("Copy camera as JSON"), HasSubstr("\"fov_deg\": 31"));
  // Every --set of the text, without its quotes, makes the camera of a preset that had another.
  preset::Overrides overrides;
  std::string text = copied("Copy camera as --set");
  for (std::size_t at = text.find('\''); at != std::string::npos;) {
    const std::size_t end = text.find('\'', at + 1);
    overrides.push_back(text.substr(at + 1, end - at - 1));
    at = text.find('\'', end + 1);
  }
  EXPECT_EQ(preset::parse_preset(test::preset_text, "again", overrides).scene.camera, camera());
}

TEST(LooksOfASession, AreKept) {
  Session session;
  session.view_state.view_settings.false_colour = true;
  session.view_state.view_settings.range = LuminanceRange{0.25, 64};
  const std::string text = SessionText().of(session);
  EXPECT_EQ(parse_session(text, "session.json").view_state.view_settings, session.view_state.view_settings);
  EXPECT_EQ(parse_session(SessionText().of({}), "session.json").view_state.view_settings, ViewSettings{});
  std::string other = text;
  other.replace(other.find("false_colour"), 5, "wrong");
  EXPECT_ANY_THROW(parse_session(other, "session.json"));
}

} // namespace nephroid::ui::looks_test
