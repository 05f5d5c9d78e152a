// SPDX-License-Identifier: Apache-2.0
// Holding runs against each other in the window: pinned runs, flip and difference in the View.
#include "measure/run_files.h"
#include "window_fixture.h"

namespace nephroid::ui::compare_test {

class CompareTest : public test::WindowFixture {
protected:
  /// A reference of the pictures' size, all of one colour.
  void give_reference(std::array<float, 3> rgb, int width = 64, int height = 48) {
    auto reference = std::make_shared<measure::Reference>();
    reference->width = width;
    reference->height = height;
    for (int i = 0; i < width * height; ++i) reference->rgb.insert(reference->rgb.end(), rgb.begin(), rgb.end());
    reference->origin = "reference.exr";
    runs.reference = reference;
  }
  void change_camera(double z) {
    edit([&](preset::Preset& p) { p.scene.camera.position[2] = z; }, "camera");
  }
  std::array<int, 3> first_texel() const {
    const auto pixels = view().texture().pixels();
    return {pixels[0], pixels[1], pixels[2]};
  }
};

TEST_F(CompareTest, APinnedRunStaysWhenThePresetIsEdited) {
  run_measured();
  press(ImGuiKey_P);
  ASSERT_THAT(workbench.comparing().pinned().all(), SizeIs(1));
  const PinnedRun pinned = workbench.comparing().pinned().all()[0];
  EXPECT_EQ(pinned.name, "Test");
  EXPECT_EQ(pinned.history->rows.size(), 20u);
  EXPECT_EQ(pinned.picture->rgb[2], 4);
  runs.history = [](int steps) { return falling_history(steps, 0.005); }; // half the error
  change_camera(2);
  ASSERT_TRUE(until_current());
  finish();
  EXPECT_THAT(workspace.panel<ui::ErrorPanel>().contents().runs, SizeIs(2));
  EXPECT_EQ(workbench.comparing().pinned().all()[0].history, pinned.history);
  EXPECT_EQ(workbench.comparing().pinned().all()[0].picture->rgb[2], 4);
  press(ImGuiKey_P);
  ASSERT_THAT(workbench.comparing().pinned().all(), SizeIs(2));
  EXPECT_EQ(workbench.comparing().pinned().all()[1].name, "Test: camera");
  EXPECT_NE(workbench.comparing().pinned().all()[1].colour, pinned.colour);
  // Hidden, the first is no longer in the plot; the second is.
  apply({command::ChangePin{pinned.id, "far", pinned.colour, false}});
  EXPECT_EQ(workbench.comparing().pinned().find(pinned.id)->name, "far");
  EXPECT_THAT(workspace.panel<ui::ErrorPanel>().contents().runs, SizeIs(2));
  EXPECT_EQ(workspace.panel<ui::ErrorPanel>().contents().runs[0].name, "Test: camera");
  apply({command::CompareWith{pinned.id}, command::Unpin{pinned.id}});
  EXPECT_EQ(workbench.comparing().comparison().pin, 0u);
  EXPECT_THAT(workbench.comparing().pinned().all(), SizeIs(1));
  EXPECT_TRUE(workbench.open(folder.write("other.json", test::preset_text)));
  frames(2);
  EXPECT_THAT(workbench.comparing().pinned().all(), SizeIs(1)) << "another preset may be compared with it";
}

TEST_F(CompareTest, FoldersAndTablesThatAreDroppedArePinned) {
  run_measured();
  folder.write("history.csv", measure::to_csv(*falling_history(7)));
  workbench.apply({command::Open{folder.path().string()}});
  ASSERT_TRUE(until([&] { return workbench.comparing().pinned().all().size() == 1; }));
  EXPECT_EQ(workbench.comparing().pinned().all()[0].history->rows.size(), 7u);
  EXPECT_EQ(workbench.preset()->name, "Test") << "the preset stays";
  frames(2);
  EXPECT_THAT(workspace.panel<ui::ErrorPanel>().contents().runs, SizeIs(2));
  workbench.apply({command::Open{folder.write("cut.csv", "seconds,wall_seconds,step,work,lab_mean\n1,1,1,1")}});
  ASSERT_TRUE(until([&] { return workbench.messages().size() == 1; }));
  EXPECT_THAT(workbench.messages()[0].line, HasSubstr("cut.csv:2"));
  EXPECT_EQ(workbench.messages()[0].kind, ErrorKind::bad_input);
  EXPECT_THAT(workbench.comparing().pinned().all(), SizeIs(1));
}

TEST_F(CompareTest, PinsStandInTheOrderInWhichTheyWereNamed) {
  measured();
  open();
  const std::string longer = folder.write("longer.csv", measure::to_csv(*falling_history(20000))),
                    shorter = folder.write("shorter.csv", measure::to_csv(*falling_history(2)));
  workbench.apply({command::PinFile{longer}, command::PinFile{shorter}});
  const auto& pins = workbench.comparing().pinned();
  ASSERT_TRUE(until([&] { return pins.all().size() == 2; }));
  EXPECT_EQ(pins.all()[0].name, "longer");
  EXPECT_EQ(pins.all()[1].name, "shorter");
}

TEST_F(CompareTest, HoldingTheKeyFlipsToTheReference) {
  give_reference({1, 0, 0});
  run_through();
  EXPECT_EQ(first_texel(), (std::array{0, 0, 255})) << "the camera at (0, 0, 4)";
  imgui.key(ImGuiKey_R, true);
  frame();
  ASSERT_NE(imgui.pushed<command::Flip>(), nullptr);
  EXPECT_TRUE(imgui.pushed<command::Flip>()->on);
  frames(3);
  EXPECT_EQ(first_texel(), (std::array{255, 0, 0}));
  EXPECT_EQ(view().shown().label, "Reference");
  imgui.key(ImGuiKey_R, false);
  frames(2);
  EXPECT_FALSE(workbench.comparing().comparison().flip);
  EXPECT_EQ(first_texel(), (std::array{0, 0, 255}));
  EXPECT_EQ(runs.made, 1) << "no new run";
}

TEST_F(CompareTest, KeysOfOneFrameDoNotUndoEachOther) {
  give_reference({1, 0, 0});
  run_through();
  imgui.key(ImGuiKey_R, true);
  frame();
  imgui.key(ImGuiKey_R, false); // a slow frame takes the release and the next key at once
  imgui.key(ImGuiKey_D, true);
  frame();
  imgui.key(ImGuiKey_D, false);
  frame();
  EXPECT_FALSE(workbench.comparing().comparison().flip);
  EXPECT_TRUE(workbench.comparing().comparison().difference);
}

TEST_F(CompareTest, AWindowThatLosesTheKeyboardFlipsBack) {
  give_reference({1, 0, 0});
  run_through();
  imgui.key(ImGuiKey_R, true);
  frames(2);
  EXPECT_TRUE(workbench.comparing().comparison().flip);
  ImGui::GetIO().AddFocusEvent(false);
  frames(2);
  EXPECT_FALSE(workbench.comparing().comparison().flip);
}

TEST_F(CompareTest, FlipsToTheChosenPinnedRun) {
  run_through();
  press(ImGuiKey_P);
  change_camera(-1);
  ASSERT_TRUE(until_current());
  finish();
  EXPECT_EQ(first_texel(), (std::array{0, 0, 0}));
  press(ImGuiKey_N); // from the reference to the pinned run
  EXPECT_EQ(workbench.comparing().comparison().pin, workbench.comparing().pinned().all()[0].id);
  imgui.key(ImGuiKey_R, true);
  frames(2);
  EXPECT_EQ(first_texel(), (std::array{0, 0, 255}));
  EXPECT_EQ(view().shown().label, "\"Test\"");
  imgui.key(ImGuiKey_R, false);
  frame();
  press(ImGuiKey_N);
  EXPECT_EQ(workbench.comparing().comparison().pin, 0u) << "round again";
}

TEST_F(CompareTest, WithoutAReferenceTheActionsSayWhy) {
  run_through();
  EXPECT_FALSE(action("Flip").enabled(context()));
  EXPECT_FALSE(action("Difference").enabled(context()));
  EXPECT_THAT(action("Flip").why_not(context()), HasSubstr("the preset has no reference"));
  press(ImGuiKey_R);
  ASSERT_THAT(workbench.messages(), SizeIs(1));
  EXPECT_FALSE(workbench.messages()[0].error);
  EXPECT_THAT(workbench.messages()[0].line, StartsWith("Flip: the preset has no reference"));
  EXPECT_FALSE(workbench.comparing().comparison().flip);
}

TEST_F(CompareTest, ShowsTheDifferenceInFalseColour) {
  give_reference({0, 0, 3});
  run_through();
  press(ImGuiKey_D);
  workbench.apply({command::ShowDifference{true, measure::DifferenceMetric::absolute}});
  const auto is_absolute = [&] { // not that of the key, which has another metric
    const auto map = workbench.comparing().difference();
    return map && map->values && view().shown().owner == map && std::abs(map->values->at(0) - 1.0 / 3) < 1e-6;
  };
  ASSERT_TRUE(until(is_absolute)) << "(|0| + |0| + |4 - 3|) / 3";
  const auto map = workbench.comparing().difference();
  EXPECT_EQ(map->scale, measure::colour_scale(*map->values));
  const auto colour = measure::map_colour(map->values->at(0) / map->scale);
  EXPECT_NEAR(first_texel()[0], colour[0], 2);
  EXPECT_NEAR(first_texel()[1], colour[1], 2);
  EXPECT_THAT(pixel_text(context(), {3, 2}), HasSubstr("\nReference   R 0   G 0   B 3"));
  EXPECT_THAT(pixel_text(context(), {3, 2}), HasSubstr("\ndifference   R +0   G +0   B +1"));
  EXPECT_THAT(pixel_text(context(), {3, 2}), HasSubstr("|a - b| 0.3333"));
  // A fixed scale is another map of the same values, which are not computed again.
  workbench.apply({command::ShowDifference{true, measure::DifferenceMetric::absolute, 1.0 / 3}});
  ASSERT_TRUE(until([&] { return workbench.comparing().difference()->scale == 1.0 / 3; }));
  EXPECT_EQ(workbench.comparing().difference()->values, map->values);
  frame();
  EXPECT_NEAR(first_texel()[0], measure::map_colour(1)[0], 2);
  press(ImGuiKey_D);
  EXPECT_EQ(first_texel(), (std::array{0, 0, 255}));
  EXPECT_TRUE(workbench.messages().empty());
}

TEST_F(CompareTest, EveryMetricHasADifference) {
  give_reference({0, 0, 3});
  run_through();
  for (std::size_t i = 0; i < measure::difference_names.size(); ++i) {
    const auto metric = static_cast<measure::DifferenceMetric>(i);
    workbench.apply({command::ShowDifference{true, metric}});
    ASSERT_TRUE(until(
        [&] { return workbench.comparing().difference() && workbench.comparing().difference()->of.metric == metric; }));
    frame();
    EXPECT_EQ(workbench.comparing().difference()->error, "");
    EXPECT_EQ(view().shown().hint, "");
  }
}

TEST_F(CompareTest, PicturesOfOtherSizesAreSaidNotCompared) {
  give_reference({1, 0, 0}, 32, 32);
  run_through();
  EXPECT_THAT(workbench.comparing().why_not(), HasSubstr("32 x 32, the picture 64 x 48"));
  workbench.apply({command::ShowDifference{}});
  frames(5);
  EXPECT_THAT(view().shown().hint, HasSubstr("32 x 32"));
  EXPECT_EQ(workbench.comparing().difference(), nullptr);
  apply({command::Flip{}});
  EXPECT_THAT(view().shown().hint, HasSubstr("32 x 32"));
  EXPECT_TRUE(action("Difference").why_not(context()).size() > 10);
}

TEST_F(CompareTest, APictureThatIsNotFiniteHasNoDifferenceAndSaysSo) {
  give_reference({0, std::numeric_limits<float>::quiet_NaN(), 0});
  run_through();
  workbench.apply({command::ShowDifference{}});
  ASSERT_TRUE(until([&] { return workbench.comparing().difference() != nullptr; }));
  frame();
  EXPECT_THAT(view().shown().hint, HasSubstr("reference.exr"));
  EXPECT_TRUE(workbench.messages().empty());
}

} // namespace nephroid::ui::compare_test
