// SPDX-License-Identifier: Apache-2.0
// Materials as balls in the panels: which are asked for and how often, and that nothing runs where none is shown. The
// lists of shipped metals and glasses: words narrow them, the keyboard and the mouse choose.
#include "dispersion_fixture.h"
#include "parameters_fixture.h"
#include "scatter/spectra.h"

namespace nephroid::ui::material_balls_test {

const std::string materials = "/scene/materials", metal = materials + "/metal/metal",
                  glass = materials + "/glass/dispersion/file";

/// A wall of gold. The camera's resolution is not a ball's.
std::string metal_text() {
  test::Json preset = test::Json::parse(test::preset_text);
  preset["scene"]["materials"]["metal"] = {{"type", "conductor"}, {"metal", "gold"}};
  preset["scene"]["materials"]["glass"] = {{"type", "dielectric"}, {"dispersion", "N-SF66"}};
  preset["scene"]["objects"][0]["material"] = "metal";
  return preset.dump();
}

class BallsTest : public test::ParametersFixture {
protected:
  BallsTest() { runs.beside.steps = 3; }
  std::string picture(const std::string& name) const { return materials + "/" + name + ":picture"; }
  bool is_drawn(const std::string& widget) const { return panel().place_of(widget).has_value(); }
  bool until_done() {
    return until([&] { return !workbench.balls().works(); });
  }
  void expect_asked(int times) {
    frames(4);
    ASSERT_TRUE(until_done());
    frames(10);
    EXPECT_EQ(runs.made_beside, times);
  }
};

TEST_F(BallsTest, NothingRunsWhereNoMaterialIsShown) {
  open(metal_text());
  search("camera");
  expect_asked(0);
  workbench.apply({command::Select{{Selection::Kind::camera, 0}}});
  expect_asked(0);
}

TEST_F(BallsTest, AMaterialIsAskedForOnceAChange) {
  open(metal_text());
  const std::size_t files = std::distance(fs::directory_iterator(folder.path()), {});
  search("scene.materials.metal");
  expect_asked(1);
  EXPECT_TRUE(is_drawn(picture("metal")));
  {
    const std::lock_guard lock(runs.beside_mutex);
    EXPECT_EQ(runs.seen_beside.scene.materials.at("ball"), workbench.preset()->scene.materials.at("metal"));
    EXPECT_EQ(runs.seen_beside.scene.camera.resolution, (std::array{MaterialBalls::edge, MaterialBalls::edge}));
    EXPECT_EQ(runs.seen_beside.source, workbench.preset()->source) << "its files are looked up from there";
  }
  edit([](preset::Preset& p) { p.scene.camera.fov_deg = 30; });
  expect_asked(1);
  edit([](preset::Preset& p) { p.scene.materials.at("metal").roughness = 0.3; });
  expect_asked(2);
  undo();
  expect_asked(3);
  edit([](preset::Preset& p) { p.scene.materials.at("glass").roughness = 0.3; });
  expect_asked(3);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), files) << "no files";
  EXPECT_THAT(workbench.comparing().pinned().all(), IsEmpty());
  EXPECT_THAT(workbench.messages(), IsEmpty());
}

TEST_F(BallsTest, AMaterialWhoseFileChangesIsAskedForAgain) {
  folder.write("own.yml", read_file(test::shipped("N-BK7")));
  test::Json preset = test::Json::parse(metal_text());
  preset["scene"]["materials"]["glass"]["dispersion"] = "own.yml";
  open(preset.dump());
  search("scene.materials.glass");
  expect_asked(1);
  folder.write("own.yml", read_file(test::shipped("N-SF66")));
  EXPECT_TRUE(until([&] { return runs.made_beside == 2; }));
  expect_asked(2);
}

TEST_F(BallsTest, TheRunInHandIsWaitedForButNotLong) {
  open(metal_text());
  search("scene.materials.metal");
  expect_asked(1);
  runs.reads_on = true; // it comes to no picture
  edit([](preset::Preset& p) { p.scene.materials.at("metal").roughness = 0.3; });
  frame();
  EXPECT_EQ(runs.made_beside, 1);
  EXPECT_TRUE(until([&] { return runs.made_beside == 2; }));
  EXPECT_EQ(workbench.run().status().state, job::State::preparing);
  runs.reads_on = false;
}

TEST_F(BallsTest, ASelectedObjectShowsItsMaterial) {
  open(metal_text());
  const std::string at = "/scene/objects/0/material:picture";
  workbench.apply({command::Select{{Selection::Kind::object, 0}}});
  expect_asked(1);
  EXPECT_TRUE(is_drawn(at));
  workbench.apply({command::Select{}});
  frames(3);
  EXPECT_FALSE(is_drawn(at));
  edit([](preset::Preset& p) { p.scene.materials.at("metal").roughness = 0.3; });
  expect_asked(1);
  workbench.apply({command::Select{{Selection::Kind::object, 0}}});
  expect_asked(2);
}

TEST_F(BallsTest, WhatNobodyShowsAnyMoreEnds) {
  runs.beside.steps = 1000000;
  open(metal_text());
  search("scene.materials.metal");
  ASSERT_TRUE(until([&] { return is_drawn(picture("metal")); }));
  EXPECT_TRUE(workbench.balls().works());
  search("camera");
  frames(3);
  EXPECT_FALSE(workbench.balls().works());
}

TEST_F(BallsTest, FirstPicturesComeBeforeBetterOnes) {
  runs.beside.steps = 1000000;
  open(metal_text());
  search("scene.materials");
  for (const char* name : {"metal", "glass", "wall"})
    EXPECT_TRUE(until([&] { return is_drawn(picture(name)); })) << name;
}

TEST_F(BallsTest, WhileTheMouseDragsEachRunShowsAPicture) {
  runs.beside.step_ms = 50;
  open(metal_text());
  search("scene.materials.metal.roughness");
  ASSERT_TRUE(until_done());
  const int before = runs.made_beside;
  drag_by(*panel().place_of(materials + "/metal/roughness"), 40, 0, 20);
  EXPECT_LT(runs.made_beside - before, 10) << "of 20 edits";
  ASSERT_TRUE(until_done());
  const std::lock_guard lock(runs.beside_mutex);
  EXPECT_EQ(runs.seen_beside.scene.materials.at("ball"), workbench.preset()->scene.materials.at("metal"));
}

TEST_F(BallsTest, WhereAnEditWaitsThereIsNone) {
  open(metal_text());
  enter(metal, "unobtainium");
  EXPECT_THAT(problems().at(metal).text, HasSubstr("unobtainium"));
  EXPECT_TRUE(is_drawn(metal + ":problem"));
  EXPECT_FALSE(is_drawn(picture("metal")));
  const int before = runs.made_beside;
  expect_asked(before);
  click(metal + ":drop");
  frames(3);
  EXPECT_TRUE(until([&] { return is_drawn(picture("metal")); }));
}

TEST_F(BallsTest, WhatCannotBeMadeLeavesNoMessage) {
  open(metal_text());
  runs.refuses_beside = true;
  search("scene.materials.metal");
  expect_asked(1);
  EXPECT_FALSE(is_drawn(picture("metal")));
  EXPECT_THAT(workbench.messages(), IsEmpty());
  runs.refuses_beside = false;
  edit([](preset::Preset& p) { p.scene.materials.at("metal").roughness = 0.3; });
  expect_asked(2);
  EXPECT_TRUE(is_drawn(picture("metal")));
}

class ShippedChoice : public BallsTest {
protected:
  void open_list(const std::string& field, const std::string& entry) {
    search(dotted(field));
    click(field + ":shipped");
    ASSERT_TRUE(until([&] { return is_drawn(field + ":" + entry); }));
  }
};

TEST_F(ShippedChoice, AMetalIsFoundByItsLetters) {
  open(metal_text());
  const std::string before = text();
  open_list(metal, "silver");
  for (const char* name : {"aluminium", "brass", "copper", "gold", "silver"})
    EXPECT_TRUE(is_drawn(metal + ":" + name)) << name;
  EXPECT_FALSE(is_drawn(metal + ":N-BK7"));
  const int asked = runs.made_beside;
  type("copp");
  EXPECT_TRUE(is_drawn(metal + ":copper"));
  EXPECT_FALSE(is_drawn(metal + ":silver"));
  EXPECT_EQ(text(), before);
  press(ImGuiKey_Enter);
  EXPECT_EQ(at(metal), "copper");
  EXPECT_FALSE(is_drawn(metal + ":words")) << "the list closes";
  expect_asked(asked + 1);
  undo();
  EXPECT_EQ(text(), before) << "one step";
  EXPECT_FALSE(workbench.edits()->modified());
}

TEST_F(ShippedChoice, ArrowsAndTheMouseChoose) {
  open(metal_text());
  open_list(metal, "silver");
  press(ImGuiKey_DownArrow);
  press(ImGuiKey_DownArrow);
  press(ImGuiKey_UpArrow);
  press(ImGuiKey_Enter);
  EXPECT_EQ(at(metal), "brass") << "the second";
  open_list(metal, "silver");
  click(metal + ":silver");
  EXPECT_EQ(at(metal), "silver");
  const std::string before = text();
  open_list(metal, "silver");
  type("no such metal");
  press(ImGuiKey_Enter);
  EXPECT_EQ(text(), before);
  press(ImGuiKey_Escape);
  EXPECT_FALSE(is_drawn(metal + ":words"));
  EXPECT_EQ(text(), before);
}

TEST_F(ShippedChoice, AGlassIsFoundByItsLettersAndFigures) {
  open(metal_text());
  open_list(glass, "N-BK7");
  EXPECT_FALSE(is_drawn(glass + ":gold"));
  type("bk7");
  EXPECT_FALSE(is_drawn(glass + ":N-SF11"));
  press(ImGuiKey_Enter);
  EXPECT_EQ(at(glass), "N-BK7");
  open_list(glass, "N-BK7");
  type("1.7847"); // Schott's catalogue: N-SF11 has n_d 1.78472 and V_d 25.68
  EXPECT_TRUE(is_drawn(glass + ":N-SF11"));
  EXPECT_FALSE(is_drawn(glass + ":N-BK7"));
  press(ImGuiKey_Enter);
  EXPECT_EQ(at(glass), "N-SF11");
}

TEST_F(ShippedChoice, ThereAreFilesToo) {
  open(metal_text());
  search(dotted(metal));
  EXPECT_TRUE(is_drawn(metal + ":files"));
  EXPECT_TRUE(is_drawn(metal)) << "and a path can be typed";
}

class GlassOfDispersion : public test::DispersionFixture {};

TEST_F(GlassOfDispersion, IsChosenAndSeen) {
  test::HeadlessWindow<>::resize({1400, 900});
  open_glass({{"glass", test::from_points(test::five)}});
  frames(5);
  ASSERT_TRUE(until([&] { return panel().place_of("picture").has_value(); }));
  click("glass:shipped");
  ASSERT_TRUE(until([&] { return panel().place_of("glass:N-BK7").has_value(); }));
  type("bk7");
  press(ImGuiKey_Enter);
  EXPECT_EQ(dispersion(), test::from_file("N-BK7"));
  EXPECT_TRUE(until([&] { return runs.made_beside >= 2; })) << "a ball of the other glass";
  press(ImGuiKey_Z, ImGuiMod_Ctrl);
  EXPECT_EQ(dispersion(), test::from_points(test::five));
}

} // namespace nephroid::ui::material_balls_test
