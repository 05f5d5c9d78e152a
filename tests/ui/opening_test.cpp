// SPDX-License-Identifier: Apache-2.0
// Opening files in the window: what it asks before unsaved changes go, what it says about files that are no preset.
// What becomes of pictures and meshes that are dropped on it, and that nothing does of what is none.
#include "inverse/settings.h"
#include "tests/support/loaded_scenes.h"
#include "window_fixture.h"

namespace nephroid::ui::opening_test {

class OpeningTest : public test::WorkbenchFixture {
protected:
  const std::string first = folder.write("first.json", test::preset_text);
  const std::string second = folder.write("second.json", R"({"name": "Second", "parent": "first.json"})");

  void open_and_edit() {
    ASSERT_TRUE(workbench.open(first));
    edit([](preset::Preset& p) { p.scene.camera.position = {0, 0, 2}; });
    ASSERT_TRUE(workbench.edits()->modified());
  }
  std::string refusal(const std::string& file) {
    return refusal_of([&] { refuse_other_kinds(file); });
  }
};

TEST_F(OpeningTest, WithoutChangesNothingIsAsked) {
  ASSERT_TRUE(workbench.open(first));
  workbench.apply({command::Open{second}});
  EXPECT_EQ(workbench.questions().question(), Question::none);
  EXPECT_EQ(workbench.preset()->name, "Second");
  workbench.apply({command::Quit{}});
  EXPECT_TRUE(workbench.questions().quitting());
}

TEST_F(OpeningTest, QuittingAsksBeforeChangesGo) {
  open_and_edit();
  workbench.apply({command::Quit{}});
  EXPECT_FALSE(workbench.questions().quitting());
  EXPECT_EQ(workbench.questions().question(), Question::unsaved);
  ASSERT_NE(workbench.questions().waiting(), nullptr);
  workbench.apply({*workbench.questions().waiting()});
  EXPECT_TRUE(workbench.questions().quitting());
}

TEST_F(OpeningTest, AnotherPresetAsksBeforeChangesGo) {
  open_and_edit();
  workbench.apply({command::Open{second}});
  EXPECT_EQ(workbench.questions().question(), Question::unsaved);
  EXPECT_EQ(workbench.preset()->name, "Test") << "still there";
  workbench.apply({command::Ask{Question::none}});
  EXPECT_EQ(workbench.questions().waiting(), nullptr);
  EXPECT_EQ(workbench.preset()->scene.camera.position[2], 2);
  workbench.apply({command::Open{second}});
  workbench.apply({*workbench.questions().waiting()});
  EXPECT_EQ(workbench.preset()->name, "Second");
  EXPECT_EQ(workbench.questions().question(), Question::none);
  EXPECT_EQ(preset::read_preset(first).scene.camera.position[2], 4) << "not saved";
}

TEST_F(OpeningTest, OnceTheChangesAreSavedWhatWaitedGoesOn) {
  open_and_edit();
  workbench.apply({command::Open{second}});
  workbench.apply({command::SavePreset{folder.path() / "missing" / "first.json"}});
  EXPECT_EQ(workbench.questions().question(), Question::unsaved) << "saving failed: the question stays";
  EXPECT_TRUE(workbench.edits()->modified());
  ASSERT_FALSE(workbench.messages().empty());
  EXPECT_TRUE(workbench.messages().back().error);
  workbench.apply({command::Ask{Question::save_preset}}); // "Save as..." in the dialog
  workbench.apply({command::SavePreset{folder.path() / "third.json"}});
  EXPECT_EQ(workbench.preset()->name, "Second");
  EXPECT_EQ(preset::read_preset((folder.path() / "third.json").string()).scene.camera.position[2], 2);
  EXPECT_EQ(workbench.questions().question(), Question::none);
}

TEST_F(OpeningTest, WhatCannotBeOpenedAsksNothing) {
  open_and_edit();
  workbench.apply(
      {command::Open{folder.write("broken.json", "{")}, command::Open{folder.write("ball.obj", "v 0 0 0\n")}});
  EXPECT_TRUE(until([&] { return workbench.messages().size() == 2; })) << "a mesh is read in the background";
  EXPECT_EQ(workbench.questions().question(), Question::none);
  EXPECT_TRUE(workbench.edits()->modified());
}

TEST_F(OpeningTest, TheDialogSavesAndOpens) {
  test::HeadlessWindow<> window;
  window.open_file(first);
  window.edit([](preset::Preset& p) { p.scene.camera.position = {0, 0, 2}; });
  window.workbench.apply({command::Open{second}});
  window.frames(3);
  ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  window.press(ImGuiKey_Tab); // to the first button
  window.press(ImGuiKey_Space);
  window.frames(3);
  EXPECT_EQ(window.workbench.preset()->name, "Second");
  EXPECT_EQ(preset::read_preset(first).scene.camera.position[2], 2) << "saved";
  EXPECT_EQ(window.workbench.questions().question(), Question::none);
}

TEST_F(OpeningTest, AMapBecomesTheEnvironment) {
  const std::string map = folder.write("hall.hdr", "read by the run"), other = folder.write("sky.EXR", "");
  workbench.apply({command::Open{map}});
  EXPECT_THAT(only_message(workbench), HasSubstr("once a preset is open"));
  open_and_edit();
  workbench.apply({command::Open{map}});
  ASSERT_TRUE(workbench.preset()->scene.environment);
  EXPECT_EQ(workbench.preset()->scene.environment->file, map);
  EXPECT_EQ(workbench.questions().question(), Question::none);
  EXPECT_EQ(workbench.edits()->undo_label(), "surround with hall.hdr");
  edit(
      [&](preset::Preset& p) { p.scene.environment = {.file = map, .radiance = 3, .rotate_deg = 40, .lights = true}; });
  workbench.apply({command::Open{other}});
  const preset::Environment expected{.file = other, .radiance = 3, .rotate_deg = 40, .lights = true};
  EXPECT_EQ(workbench.preset()->scene.environment, expected);
  for (int i = 0; i < 3; ++i) workbench.apply({command::Undo{}});
  EXPECT_FALSE(workbench.preset()->scene.environment);
}

// An engine that has no use for surroundings says so, and nothing changes.
TEST_F(OpeningTest, AMapThatThePresetCannotHaveIsRefused) {
  ASSERT_TRUE(workbench.open(folder.write("inverse.json", R"({"engine": "inverse", "inverse": {"receivers": [
    {"distance_mm": 100, "picture": {"type": "disc", "radius": 0.3}}]}})")));
  workbench.apply({command::Open{folder.write("hall.hdr", "")}});
  EXPECT_THAT(only_message(workbench), HasSubstr("environment"));
  EXPECT_TRUE(workbench.messages()[0].error);
  EXPECT_FALSE(workbench.edits()->modified());
}

TEST_F(OpeningTest, FilesDroppedTogetherKeepTheirMessages) {
  workbench.apply({command::Open{folder.write("ball.obj", "v 0 0 0\n")}, command::Open{first}});
  EXPECT_EQ(workbench.preset()->name, "Test");
  EXPECT_THAT(only_message(workbench), HasSubstr("is a mesh"));
  workbench.apply({command::Open{first}});
  EXPECT_TRUE(workbench.messages().empty()) << "an earlier error is over";
}

TEST_F(OpeningTest, SaysWhatOtherFilesAreAndWhatCanBeDoneWithThem) {
  const std::string glass = std::string(NEPHROID_SOURCE_DIR) + "/presets/materials/N-BK7.yml";
  EXPECT_THAT(refusal(glass), StartsWith(glass + ": is dispersion data; the window opens presets; "));
  EXPECT_THAT(refusal(glass), HasSubstr("`nephroid dispersion " + glass + "`"));
  EXPECT_THAT(refusal(folder.write("BALL.OBJ", "v 0 0 0\n")),
              HasSubstr("is a mesh; the window opens presets; drop it on the window once"));
  EXPECT_THAT(refusal(folder.write("scene.gltf", "{\"asset\": {}}")),
              HasSubstr("is a scene; the window opens presets; drop it on the window"));
  EXPECT_THAT(refusal(folder.write("sky.exr", "v/1")), HasSubstr("is a picture"));
  EXPECT_THAT(refusal(folder.write("direct.cl", "__kernel")), HasSubstr("--kernels"));
  EXPECT_THAT(refusal(folder.write("a.step", "ISO-10303-21;")), AllOf(HasSubstr("a CAD model"), HasSubstr("as glTF")));
  EXPECT_THAT(refusal(folder.write("notes.txt", "hello")), HasSubstr("is no preset"));
  EXPECT_THAT(refusal(folder.write("noise", std::string("\0\1\2", 3))), HasSubstr("is no preset"));
}

TEST_F(OpeningTest, LeavesPresetsToTheReader) {
  EXPECT_NO_THROW(refuse_other_kinds(first));
  EXPECT_NO_THROW(refuse_other_kinds("first-light"));
  EXPECT_NO_THROW(refuse_other_kinds(folder.path().string()));
  EXPECT_NO_THROW(refuse_other_kinds((folder.path() / "missing.obj").string()));
  EXPECT_NO_THROW(refuse_other_kinds(folder.write("broken.json", "]"))) << "the reader names line and column";
  EXPECT_NO_THROW(refuse_other_kinds(folder.write("preset.txt", " \n{}")));
  EXPECT_NO_THROW(refuse_other_kinds(folder.write("empty", "")));
}

class DroppedPicture : public test::WorkbenchFixture {
protected:
  const std::vector<inverse::Receiver>& receivers() const {
    return workbench.preset()->settings.as<inverse::Settings>().receivers;
  }
  std::string picture = folder.write("face.png", "a run reads it");
};

TEST_F(DroppedPicture, TakesThePlaceOfTheDrawingsOneAfterTheOther) {
  ASSERT_TRUE(workbench.open("inverse/shapes"));
  const std::vector<inverse::Receiver> before = receivers();
  ASSERT_EQ(before.size(), 3u);
  const std::string opened = preset::to_json(*workbench.preset());
  workbench.apply({command::Open{picture}});
  EXPECT_EQ(receivers()[0].picture.file, picture);
  EXPECT_EQ(receivers()[0].distance_mm, before[0].distance_mm);
  EXPECT_EQ(receivers()[1], before[1]);
  const std::string other = folder.write("other.JPG", "");
  workbench.apply({command::Open{other}});
  EXPECT_EQ(receivers()[0].picture.file, picture);
  EXPECT_EQ(receivers()[1].picture.file, other);
  workbench.apply({command::Undo{}, command::Undo{}});
  EXPECT_EQ(preset::to_json(*workbench.preset()), opened);
}

TEST_F(DroppedPicture, ThatIsNotThereChangesNothing) {
  ASSERT_TRUE(workbench.open("inverse/shapes"));
  workbench.apply({command::Open{(folder.path() / "gone.png").string()}});
  EXPECT_THAT(last_message(workbench), HasSubstr("there is no such picture"));
  EXPECT_FALSE(workbench.edits()->modified());
}

TEST_F(DroppedPicture, IsOpenedToBeLookedAtElsewhere) {
  open();
  workbench.apply({command::Open{picture}});
  ASSERT_TRUE(until([&] { return !workbench.works_on_files(); }));
  EXPECT_THAT(last_message(workbench), HasSubstr("face.png: is no picture that can be read"))
      << "of which this is none";
  EXPECT_FALSE(workbench.edits()->modified());
}

TEST_F(DroppedPicture, IsTheTextureOfASelectedMattObject) {
  ASSERT_TRUE(workbench.open("spectral/brilliant"));
  const auto texture = [&] { return workbench.preset()->scene.materials.at("ground").texture; };
  workbench.apply({command::Select{{Selection::Kind::object, 1}}, command::Open{picture}});
  ASSERT_TRUE(texture());
  EXPECT_EQ(texture()->file, picture);
  EXPECT_THAT(last_message(workbench), HasSubstr("face.png is the texture of the material 'ground'"));
  workbench.apply({command::Undo{}});
  EXPECT_FALSE(texture());
  workbench.apply({command::Open{(folder.path() / "gone.png").string()}});
  EXPECT_THAT(last_message(workbench), HasSubstr("there is no such picture"));
  workbench.apply({command::Select{{Selection::Kind::object, 0}}, command::Open{picture}});
  EXPECT_FALSE(workbench.preset()->scene.materials.at("diamond").texture);
  EXPECT_FALSE(workbench.edits()->modified());
}

/// A closed tetrahedron with edges of 10 along the axes, its corner at (100, 0, 0).
constexpr const char* tetrahedron =
    "v 100 0 0\nv 110 0 0\nv 100 10 0\nv 100 0 10\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

class DroppedMeshTest : public test::WorkbenchFixture {
protected:
  void SetUp() override { open(); }
  void drop(const std::string& file) {
    workbench.apply({command::Open{file}});
    ASSERT_TRUE(until([&] { return !workbench.works_on_files(); }));
    workbench.update();
  }
  std::string only_error() const {
    std::string line;
    for (const Message& message : workbench.messages())
      if (message.error) line += (line.empty() ? "" : " | ") + message.line;
    return line;
  }
};

TEST_F(DroppedMeshTest, IsAnObjectWhereTheCameraLooks) {
  drop(folder.write("thing.obj", tetrahedron));
  EXPECT_EQ(only_error(), "");
  const preset::Preset& preset = *workbench.preset();
  ASSERT_EQ(preset.scene.objects.size(), 2U);
  const preset::Object& object = preset.scene.objects[1];
  EXPECT_EQ(object.name, "thing");
  EXPECT_EQ(object.material, "wall") << "there is no dielectric";
  // The camera sees 2 * 4 * tan(20 degrees) = 2.91 at its target; 0.4 of that.
  const auto [low, high] = test::world_bounds(scene::load_scene(preset), 1);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(high[i] - low[i], 0.4 * 2.9118, 0.01);
  EXPECT_NEAR(high[0] + low[0], 0, 0.002) << "before the camera's target";
  EXPECT_NEAR(low[1], 0, 0.002) << "it stands there";
  EXPECT_TRUE(low[2] > -0.002 || high[2] < 0.002) << "and not in the wall, which is at z = 0";
  EXPECT_EQ(workbench.edits()->undo_label(), "add thing.obj");
  EXPECT_EQ(workbench.view_state().selection, (Selection{Selection::Kind::object, 1}));
  EXPECT_THAT(last_message(workbench), HasSubstr("the object 'thing' of 'wall'"));
  workbench.apply({command::Undo{}});
  EXPECT_EQ(*workbench.preset(), workbench.edits()->opened());
  EXPECT_EQ(in_preset(workbench.view_state().selection, workbench.preset()), Selection{});
}

TEST_F(DroppedMeshTest, IsOfTheFirstGlassAndOfAnotherName) {
  edit([](preset::Preset& p) {
    p.scene.materials["zircon"].type = preset::Material::Type::dielectric;
    p.scene.objects[0].name = "thing";
  });
  drop(folder.write("thing.obj", tetrahedron));
  ASSERT_EQ(workbench.preset()->scene.objects.size(), 2U);
  EXPECT_EQ(workbench.preset()->scene.objects[1].material, "zircon");
  EXPECT_EQ(workbench.preset()->scene.objects[1].name, "thing 2");
}

TEST_F(DroppedMeshTest, GetsGlassWhereThereIsNoMaterial) {
  edit([](preset::Preset& p) { p.scene.objects.clear(), p.scene.materials.clear(); });
  drop(folder.write("thing.obj", tetrahedron));
  ASSERT_EQ(workbench.preset()->scene.objects.size(), 1U);
  EXPECT_EQ(workbench.preset()->scene.materials.at("glass").type, preset::Material::Type::dielectric);
}

TEST_F(DroppedMeshTest, CanBeSavedAndOpened) {
  drop(folder.write("thing.obj", tetrahedron));
  const std::string file = (folder.path() / "saved.json").string();
  workbench.apply({command::SavePreset{file}});
  EXPECT_EQ(preset::read_preset(file).scene, workbench.preset()->scene);
}

TEST_F(DroppedMeshTest, BrokenOnesChangeNothing) {
  const std::string bad[][2] = {{"empty.obj", ""},
                                {"no-face.obj", "v 0 0 0\nv 1 0 0\n"},
                                {"flat.obj", "v 0 0 0\nf 1 1 1\n"},
                                {"words.stl", "this is no mesh"},
                                {"nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"}};
  for (const auto& [name, text] : bad) {
    drop(folder.write(name, text));
    EXPECT_THAT(only_error(), HasSubstr(name));
    EXPECT_EQ(only_error().find(" | "), std::string::npos) << "one message: " << only_error();
    EXPECT_EQ(*workbench.preset(), workbench.edits()->opened());
    for (const Message& message : std::vector(workbench.messages())) workbench.apply({command::Dismiss{message.id}});
  }
  drop((folder.path() / "vanished.ply").string());
  EXPECT_THAT(only_error(), HasSubstr("vanished.ply"));
  EXPECT_EQ(*workbench.preset(), workbench.edits()->opened());
}

TEST_F(DroppedMeshTest, OpenOnesAreRefusedWhereThePresetSaysSo) {
  const std::string file = folder.write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  edit([](preset::Preset& p) { p.scene.materials["glass"].type = preset::Material::Type::dielectric; });
  drop(file);
  ASSERT_EQ(workbench.preset()->scene.objects.size(), 2U);
  EXPECT_THAT(last_message(workbench), HasSubstr("it is not closed"));
  workbench.apply({command::Undo{}});
  edit([](preset::Preset& p) { p.scene.damaged_meshes = preset::Scene::DamagedMeshes::refuse; });
  drop(file);
  EXPECT_THAT(only_error(), HasSubstr("not closed"));
  EXPECT_EQ(workbench.preset()->scene.objects.size(), 1U);
}

TEST_F(DroppedMeshTest, OnAnInversePresetIsRefused) {
  ASSERT_TRUE(workbench.open("inverse/point"));
  workbench.apply({command::Open{folder.write("thing.obj", tetrahedron)}});
  EXPECT_THAT(only_error(), HasSubstr("is a mesh"));
  EXPECT_FALSE(workbench.works_on_files());
}

TEST_F(DroppedMeshTest, ForAPresetThatIsGoneIsForgotten) {
  const std::string file = folder.write("thing.obj", tetrahedron);
  workbench.apply({command::Open{file}});
  ASSERT_TRUE(workbench.open("spectral/prism"));
  ASSERT_TRUE(until([&] { return !workbench.works_on_files(); }));
  EXPECT_EQ(*workbench.preset(), workbench.edits()->opened());
}

} // namespace nephroid::ui::opening_test
