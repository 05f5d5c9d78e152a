// SPDX-License-Identifier: Apache-2.0
// The panel "Parameters": what is impossible is said at its field while the run goes on, a gesture is one entry, lists
// take and lose items, the search finds. parameters_schema_test.cpp reaches every field.
#include "parameters_fixture.h"

namespace nephroid::ui::parameters_test {

const std::string fov = "/scene/camera/fov_deg", white = "/white";

class ParametersTest : public test::ParametersFixture {
protected:
  /// Why the edit at this pointer waits; empty where it does not.
  std::string problem(const std::string& pointer) const {
    const auto found = problems().find(pointer);
    return found == problems().end() ? "" : found->second.text;
  }
  int made() const { return runs.made; }
};

TEST_F(ParametersTest, WithoutAPresetItSaysSo) {
  frames(3);
  EXPECT_FALSE(panel().place_of("search"));
  EXPECT_THAT(workbench.messages(), IsEmpty());
}

TEST_F(ParametersTest, WhatIsImpossibleIsSaidAtItsFieldAndTheRunGoesOn) {
  open();
  const std::string before = text();
  const int runs_before = made();
  const std::map<std::string, std::string> impossible{{"200", "expected a number from 0.001 to 179.9 degrees"},
                                                      {"-1", "expected a number from"},
                                                      {"wide", "is the string 'wide'"},
                                                      {"nan", "is the string 'nan'"},
                                                      {"1e999", "is the string '1e999'"},
                                                      {"40,5", "is the string '40,5'"},
                                                      {"", "is the string ''"}};
  for (const auto& [typed, said] : impossible) {
    enter(fov, typed);
    EXPECT_THAT(problem(fov), HasSubstr(said));
    EXPECT_TRUE(panel().place_of(fov + ":problem")) << "said at the field";
    EXPECT_EQ(text(), before);
  }
  frames(20);
  EXPECT_EQ(made(), runs_before) << "no run was begun";
  EXPECT_EQ(workbench.run().status().state, job::State::running);
  EXPECT_THAT(workbench.messages(), IsEmpty());
  enter(white, "2");
  EXPECT_EQ(at(white), 2) << "another field is edited all the same";
  EXPECT_EQ(at(fov), 40);
  EXPECT_NE(problem(fov), "") << "nothing is lost";
  enter(fov, " +5e1 ");
  EXPECT_EQ(at(fov), 50) << "mended";
  EXPECT_THAT(problems(), IsEmpty());
  undo();
  undo();
  EXPECT_EQ(text(), before) << "two entries";
}

TEST_F(ParametersTest, NumbersAreReadAsPeopleTypeThem) {
  open();
  for (const auto& [typed, number] :
       std::map<std::string, double>{{".02", .02}, {"+3", 3}, {"1e5", 1e5}, {"7.", 7}, {" 5 ", 5}}) {
    enter(white, typed);
    EXPECT_EQ(at(white), number) << typed;
  }
  enter("/seed", "18446744073709551615");
  EXPECT_EQ(workbench.preset()->seed, 18446744073709551615u) << "every bit of it";
  enter("/seed", "1.5");
  EXPECT_THAT(problem("/seed"), HasSubstr("expected a whole number"));
}

TEST_F(ParametersTest, WhatNoFieldHasIsSaid) {
  open();
  search("camera");
  EXPECT_FALSE(panel().place_of("nothing"));
  search("no such words");
  EXPECT_TRUE(panel().place_of("nothing"));
}

TEST_F(ParametersTest, WhileItIsTypedItIsSaidAlready) {
  open();
  const std::string before = text();
  begin_typing(fov, "0");
  EXPECT_TRUE(panel().place_of(fov + ":problem"));
  EXPECT_THAT(problems(), IsEmpty()) << "not entered";
  retype("60");
  EXPECT_FALSE(panel().place_of(fov + ":problem"));
  EXPECT_EQ(text(), before) << "no run for every letter";
  press(ImGuiKey_Escape);
  EXPECT_EQ(text(), before);
  begin_typing(fov, "61");
  click(*panel().place_of("search"));
  EXPECT_EQ(at(fov), 61) << "taken where the keyboard goes elsewhere";
}

TEST_F(ParametersTest, ADragIsOneEntryAndTheRunFollows) {
  open();
  const std::string before = text();
  search("scene.camera.fov_deg");
  const auto from = *panel().place_of(fov);
  press_at(from);
  for (int step = 1; step <= 5; ++step) {
    move({from[0] + 20 * step, from[1]});
    const auto* edit = imgui.pushed<command::Edit>();
    ASSERT_TRUE(edit);
    EXPECT_TRUE(edit->live);
  }
  let_go();
  EXPECT_TRUE(imgui.pushed<command::EndGesture>());
  EXPECT_EQ(at(fov), 50) << "a tenth a pixel at 40";
  press_at(from);
  move({from[0] - 3000, from[1]});
  let_go();
  EXPECT_GT(at(fov).get<double>(), 0) << "a drag stops at what is possible";
  EXPECT_THAT(problems(), IsEmpty());
  undo();
  undo();
  EXPECT_EQ(text(), before);
  EXPECT_FALSE(workbench.edits()->modified());
}

TEST_F(ParametersTest, EditsThatNeedEachOtherAreOneEntry) {
  folder.write("ball.obj", "");
  open();
  const std::string before = text(), object = "/scene/objects/0", other = object + "/mesh";
  search("scene.objects.0");
  click(object + "/shape:given");
  EXPECT_THAT(problem(object + "/shape"), HasSubstr("neither 'mesh' nor 'shape'"));
  click(other + ":given");
  enter(other, "nowhere.obj");
  EXPECT_THAT(problem(other), HasSubstr("nowhere.obj")) << "a file that is not there";
  EXPECT_EQ(text(), before);
  enter(other, "ball.obj");
  EXPECT_EQ(at(other), "ball.obj");
  EXPECT_TRUE(at(object + "/shape").is_null());
  EXPECT_THAT(problems(), IsEmpty());
  undo();
  EXPECT_EQ(text(), before);
}

TEST_F(ParametersTest, AWhiteThatIsFittedIsANumberAsSoonAsItIsKnown) {
  runs.white = 2.5;
  open();
  enter(white, "7");
  click(white + ":auto");
  ASSERT_TRUE(until([&] { return workbench.preset()->white == 2.5; }));
  ASSERT_TRUE(until([&] { return workbench.run().snapshot_is_current(); }));
  EXPECT_EQ(workbench.run().snapshot_origin().preset->white, 2.5);
  frames(2);
  const int before = made();
  enter(fov, "50");
  ASSERT_TRUE(until([&] { return made() > before; }));
  EXPECT_EQ(workbench.preset()->white, 2.5) << "it stays";
  undo();
  undo();
  EXPECT_EQ(at(white), 7);
  enter(white, "auto");
  ASSERT_TRUE(until([&] { return workbench.preset()->white == 2.5; }));
  EXPECT_THAT(last_message(workbench), HasSubstr("white 2.5 fits the first picture"));
}

TEST_F(ParametersTest, AnotherEngineIsChosenWhateverTheOldOneHad) {
  open(
      R"({"engine": "spectral", "white": 2, "scene": {"camera": {"resolution": [32, 24]}, "lights": [{"type": "point"}]},
    "spectral": {"threshold_deg": 1}, "reference": {"type": "recipe", "spectral": {"step_nm": 2}}, "stop": {"error": 0.5}})");
  const std::string before = text();
  choose("/engine", "inverse");
  EXPECT_TRUE(problems().empty());
  EXPECT_EQ(at("/engine"), "inverse");
  EXPECT_EQ(at("/scene/camera/resolution"), Json({32, 24}));
  EXPECT_TRUE(at("/scene/lights").empty());
  ASSERT_FALSE(workbench.messages().empty());
  EXPECT_EQ(workbench.messages().back().line,
            "left out what the engine 'inverse' does not know: spectral, reference.spectral, "
            "scene.lights, white, reference, stop.error (Undo brings it back)");
  undo();
  EXPECT_EQ(text(), before);
}

TEST_F(ParametersTest, WhatWaitsIsTakenBack) {
  open();
  enter(fov, "200");
  enter(white, "-1");
  ASSERT_THAT(problems(), SizeIs(2));
  EXPECT_EQ(panel().draft().value().at("white"), -1);
  click(white + ":drop");
  EXPECT_THAT(problems(), SizeIs(1));
  EXPECT_EQ(panel().draft().value().at("white"), 1);
  drag(0, 40, 0); // the camera, in the View
  EXPECT_NE(problem(fov), "") << "stays over another edit";
  EXPECT_EQ(panel().draft().value()["scene"]["camera"]["position"], at("/scene/camera/position"));
  open();
  Json another = Json::parse(test::preset_text);
  another["seed"] = 77;
  ASSERT_TRUE(workbench.open(folder.write("another.json", another.dump())));
  frames(2);
  EXPECT_THAT(problems(), IsEmpty()) << "another preset";
}

TEST_F(ParametersTest, AFieldIsResetAndWhatIsNotByDefaultIsMarked) {
  open();
  search("passes");
  EXPECT_TRUE(panel().place_of("/stop/passes"));
  search("fov");
  EXPECT_FALSE(panel().place_of(fov + ":reset")) << "as it is by default";
  enter(fov, "50");
  click(fov + ":reset");
  EXPECT_EQ(at(fov), 40);
  enter(fov, "50");
  click(*panel().place_of(fov + ":label"), 1);
  frames(2);
  click(fov + ":menu reset");
  EXPECT_EQ(at(fov), 40);
  search("");
  click("changed");
  frames(2);
  EXPECT_TRUE(panel().place_of("/scene/lights/0/power_w")) << "10 W";
  EXPECT_TRUE(panel().place_of(white)) << "1, not auto";
  EXPECT_FALSE(panel().place_of(fov));
}

TEST_F(ParametersTest, TheSearchFindsNamesUnitsAndHelp) {
  open();
  search("refraction angle");
  EXPECT_TRUE(panel().place_of("/spectral/threshold_deg"));
  EXPECT_FALSE(panel().place_of(white));
  search("CAMERA degrees");
  EXPECT_TRUE(panel().place_of(fov));
  EXPECT_FALSE(panel().place_of("/scene/camera/position/0"));
  search("no such thing");
  EXPECT_FALSE(panel().place_of(fov));
  search("fog");
  EXPECT_TRUE(panel().place_of("environment.extinction")) << "of another engine";
  search("");
  EXPECT_TRUE(panel().place_of(white));
  EXPECT_FALSE(panel().place_of(fov)) << "closed, as it was before the search";
}

TEST_F(ParametersTest, TheSearchOffersWhatThePresetHasNot) {
  open();
  const std::string before = text();
  search("sun");
  EXPECT_TRUE(panel().place_of("Add sun"));
  EXPECT_TRUE(panel().place_of("Add sky"));
  EXPECT_FALSE(panel().place_of("Add lamp"));
  click("make scene.environment: sky");
  EXPECT_EQ(at("/scene/environment/type"), "sky");
  EXPECT_THAT(problems(), IsEmpty());
  EXPECT_TRUE(panel().place_of(white)) << "the search is over";
  search("turbidity");
  EXPECT_TRUE(panel().place_of("/scene/environment/turbidity"));
  EXPECT_FALSE(panel().place_of("make scene.environment: sky"));
  undo();
  EXPECT_EQ(text(), before);
  search("angular diameter");
  click("make scene.lights: directional");
  EXPECT_EQ(at("/scene/lights/1/type"), "directional");
  EXPECT_THAT(problems(), IsEmpty());
  search("half_angle_deg");
  click("make scene.lights: spot");
  EXPECT_EQ(at("/scene/lights/2/type"), "spot");
  EXPECT_GT(at("/scene/lights/2/position/1"), 0) << "above what the camera looks at, as Add lamp has it";
  search("no such thing");
  EXPECT_TRUE(panel().place_of("nothing"));
}

TEST_F(ParametersTest, TheSearchEndsWithItsScene) {
  open();
  search("refraction angle");
  EXPECT_FALSE(panel().place_of(white));
  open();
  frames(2);
  EXPECT_TRUE(panel().place_of(white));
}

TEST_F(ParametersTest, TabGoesToTheNextNumber) {
  open();
  const std::string position = "/scene/camera/position/";
  begin_typing(position + "0", "3");
  for (const char* const next : {"4", "5"}) {
    press(ImGuiKey_Tab);
    frames(3);
    retype(next);
  }
  press(ImGuiKey_Tab, ImGuiMod_Shift);
  frames(3);
  retype("6");
  press(ImGuiKey_Enter);
  EXPECT_EQ(at("/scene/camera/position"), Json::array({3, 6, 5}));
}

TEST_F(ParametersTest, TabTakesTheNumberWhereThereIsNoOther) {
  open();
  search("scene.camera.fov_deg");
  click(fov);
  frames(2);
  retype("33");
  press(ImGuiKey_Tab);
  frames(3);
  EXPECT_EQ(at(fov), 33);
  retype("34");
  press(ImGuiKey_Escape);
  frames(2);
  EXPECT_EQ(at(fov), 33);
}

TEST_F(ParametersTest, CtrlSSavesWhatIsBeingTyped) {
  open();
  begin_typing(fov, "33");
  press(ImGuiKey_S, ImGuiMod_Ctrl);
  frames(2);
  ASSERT_TRUE(until_files_are_done());
  EXPECT_EQ(at(fov), 33);
  EXPECT_EQ(preset::read_preset(folder.path() / "test.json").scene.camera.fov_deg, 33);
}

TEST_F(ParametersTest, ItemsOfAListAreAddedCopiedMovedAndRemoved) {
  open();
  const std::string before = text(), lights = "/scene/lights", objects = "/scene/objects";
  search("scene.lights");
  click(lights + ":add");
  ASSERT_THAT(at(lights), SizeIs(2));
  enter(lights + "/1/power_w", "3");
  search("scene.lights");
  click(lights + "/1:duplicate");
  ASSERT_THAT(at(lights), SizeIs(3));
  EXPECT_EQ(at(lights + "/2/power_w"), 3);
  click(lights + "/1:move up");
  EXPECT_EQ(at(lights + "/0/power_w"), 3);
  EXPECT_EQ(at(lights + "/1/power_w"), 10);
  click(lights + "/1:remove");
  ASSERT_THAT(at(lights), SizeIs(2));
  search("scene.objects");
  click(objects + "/0:duplicate");
  EXPECT_EQ(at(objects + "/1/name"), "wall 2") << "names are each object's own";
  for (int i = 0; i < 6; ++i) undo();
  EXPECT_EQ(text(), before);
}

TEST_F(ParametersTest, AnObjectThatIsAddedWaitsUntilItIsWhole) {
  open();
  const std::string before = text(), added = "/scene/objects/1";
  search("scene.objects");
  click("/scene/objects:add");
  ASSERT_THAT(problems(), SizeIs(1));
  EXPECT_EQ(text(), before);
  search("scene.objects.1");
  click(added + "/shape:given");
  choose(added + "/material", "wall");
  EXPECT_THAT(problems(), IsEmpty());
  EXPECT_EQ(at(added + "/shape/type"), "sphere");
  undo();
  EXPECT_EQ(text(), before) << "one entry";
}

TEST_F(ParametersTest, AMaterialIsRenamedWithItsUses) {
  open();
  const std::string before = text(), materials = "/scene/materials";
  search("scene.materials");
  click(materials + ":add");
  ASSERT_TRUE(at(materials).contains("new"));
  const auto rename = [&](const std::string& name, const std::string& to) {
    search("scene.materials." + name);
    click(materials + "/" + name + ":name");
    retype(to);
    press(ImGuiKey_Enter);
  };
  rename("wall", "new");
  EXPECT_TRUE(at(materials).contains("wall")) << "there is another";
  rename("wall", "a/b ~ c");
  EXPECT_EQ(at("/scene/objects/0/material"), "a/b ~ c");
  search("scene.materials");
  click(materials + "/a~1b ~0 c:duplicate");
  EXPECT_TRUE(at(materials).contains("a/b ~ c 2"));
  click(materials + "/a~1b ~0 c:remove");
  ASSERT_THAT(problems(), SizeIs(1)) << "an object is made of it";
  EXPECT_THAT(problems().begin()->second.text, HasSubstr("there is no material"));
  click(materials + ":drop");
  for (int i = 0; i < 3; ++i) undo();
  EXPECT_EQ(text(), before);
}

TEST_F(ParametersTest, RowsOfATableAreAddedSortedAndRemoved) {
  open();
  const std::string spectrum = "/scene/lights/0/spectrum", table = spectrum + "/table";
  search("scene.lights.0.spectrum");
  choose(spectrum + "/type", "lines");
  EXPECT_THAT(problem(spectrum), HasSubstr("expected a list of 1 to 100000 items"));
  click(table + ":add");
  click(table + ":add");
  ASSERT_THAT(at(table), SizeIs(2));
  enter(table + "/1/0", "450");
  EXPECT_EQ(at(table).dump(), "[[550.0,1.0],[450.0,1.0]]");
  search("scene.lights.0.spectrum");
  click(table + ":sort");
  EXPECT_EQ(at(table).dump(), "[[450.0,1.0],[550.0,1.0]]");
  choose(spectrum + "/type", "table");
  EXPECT_EQ(at(table).dump(), "[[450.0,1.0],[550.0,1.0]]") << "both types have it";
  click(table + "/0:remove");
  EXPECT_THAT(problem(table), HasSubstr("expected a list of 2"));
  EXPECT_THAT(at(table), SizeIs(2));
}

TEST_F(ParametersTest, AFileIsChosenFromAList) {
  folder.write("mask.exr", "");
  open();
  search("measure.mask");
  click("/measure/mask:given");
  EXPECT_NE(problem("/measure/mask"), "");
  click("/measure/mask:files");
  ASSERT_TRUE(until([&] { return panel().files().place_of("mask.exr").has_value(); }));
  click_in(panel().files(), "mask.exr");
  EXPECT_EQ(at("/measure/mask"), "mask.exr");
}

TEST_F(ParametersTest, AFileIsChosenWhereThePresetHasNone) {
  workbench.apply({command::New{test::preset_text}});
  ASSERT_TRUE(until([&] { return workbench.run().snapshot_is_current(); }));
  search("measure.mask");
  click("/measure/mask:given");
  EXPECT_TRUE(panel().place_of("/measure/mask:files"));
}

TEST_F(ParametersTest, WhatARunRefusesIsSaidAtItsFieldToo) {
  open();
  runs.refusal = bad_input(Location(workbench.preset()->source, fov), "is not to this run's taste");
  workbench.apply({command::Restart{}});
  ASSERT_TRUE(until(job::State::failed));
  search("scene.camera.fov_deg");
  EXPECT_TRUE(panel().place_of(fov + ":problem"));
}

TEST_F(ParametersTest, ATableOfManyRowsIsDrawnInAFrame) {
  Json preset = Json::parse(test::preset_text);
  Json& table = preset["scene"]["lights"][0]["spectrum"] = {{"type", "table"}};
  for (int i = 0; i < 20000; ++i) table["table"].push_back({300 + 0.005 * i, 1});
  open(preset.dump());
  search("scene.lights.0.spectrum.table");
  const double begin = test::thread_ms();
  frames(20);
  EXPECT_LT(test::thread_ms() - begin, 2000 * test::slowness()) << "rows that are not in sight cost nothing";
}

} // namespace nephroid::ui::parameters_test
