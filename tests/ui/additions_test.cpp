// SPDX-License-Identifier: Apache-2.0
// What the menu "Add" puts into scenes: it is valid, it stands on the ground in the picture, nothing is in another
// thing. Each is one entry to undo.
#include "scenes.h"
#include "ui/state/additions.h"
#include "window_fixture.h"

namespace nephroid::ui::additions_test {

using Kind = Selection::Kind;

preset::Preset with(preset::Preset preset, std::initializer_list<Thing> things) {
  for (const Thing thing : things) preset = with_thing(std::move(preset), thing).preset;
  return preset;
}

preset::Preset empty() {
  return preset::parse_preset(R"({"name": "untitled", "engine": "spectral", "unit": "m"})", "empty.json");
}

/// Boxes of the loaded objects, which spheres know exactly.
std::vector<std::array<preset::Vec3, 2>> boxes(const preset::Preset& preset) {
  std::vector<std::array<preset::Vec3, 2>> all;
  for (const preset::Object& object : preset.scene.objects) {
    preset::Vec3 low = object.transform.translate, high = low;
    const preset::Vec3 size =
        object.shape->type == preset::Shape::Type::sphere
            ? preset::Vec3{2 * object.shape->radius, 2 * object.shape->radius, 2 * object.shape->radius}
            : object.shape->size;
    const bool flat = object.shape->type == preset::Shape::Type::quad;
    for (std::size_t i = 0; i < 3; ++i)
      if (!flat || i != 1) low[i] -= size[i] / 2, high[i] += size[i] / 2;
    all.push_back({low, high});
  }
  return all;
}

TEST(Additions, AnEmptySceneGetsTableGlassAndSkyInAnyOrder) {
  for (const auto& things :
       {std::array{Thing::table, Thing::glass, Thing::sky}, std::array{Thing::sky, Thing::glass, Thing::table}}) {
    const preset::Preset made = with(empty(), {things[0], things[1], things[2]});
    preset::with_overrides(made, {}); // which throws what the reader refuses
    scene::load_scene(made);
    ASSERT_EQ(made.scene.objects.size(), 2U);
    const auto all = boxes(made);
    EXPECT_NEAR(all[0][0][1], 0, 1e-9) << "the camera's target is the ground";
    EXPECT_NEAR(all[1][0][1], 0, 1e-9);
    EXPECT_EQ(made.scene.materials.at("glass").dispersion.file, "N-BK7");
    EXPECT_EQ(made.scene.materials.at("white").type, preset::Material::Type::diffuse);
    ASSERT_TRUE(made.scene.environment && made.scene.environment->place);
    EXPECT_TRUE(made.scene.environment->lights);
    EXPECT_TRUE(preset::days_since_2000(made.scene.environment->place->date));
    EXPECT_EQ(made.white, std::nullopt) << "it is found anew under another light";
  }
}

TEST(Additions, NothingIsInAnotherThingOrOnItsCopy) {
  const preset::Preset made = with(preset::parse_preset(test::ball_text(), "ball.json"),
                                   {Thing::sphere, Thing::glass, Thing::sphere, Thing::table, Thing::table, Thing::lamp,
                                    Thing::lamp, Thing::sun, Thing::sun});
  preset::with_overrides(made, {});
  scene::load_scene(made);
  const auto all = boxes(made);
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      bool apart = false;
      for (std::size_t axis = 0; axis < 3; ++axis)
        apart = apart || all[i][0][axis] >= all[j][1][axis] - 0.005 || all[j][0][axis] >= all[i][1][axis] - 0.005;
      EXPECT_TRUE(apart) << made.scene.objects[i].name << " is in " << made.scene.objects[j].name;
    }
  EXPECT_NEAR(all[2][0][1], -1, 1e-3) << "on the floor, which is there";
  EXPECT_EQ(made.scene.objects[3].material, "glass") << "that of the scene";
  const auto& lights = made.scene.lights;
  for (std::size_t i = 0; i < lights.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(lights[i].position == lights[j].position && lights[i].direction == lights[j].direction);
}

TEST(Additions, TheNewCameraSeesAll) {
  const preset::Preset preset = preset::parse_preset(test::ball_text(), "ball.json");
  EXPECT_EQ(camera_on_all(empty()), empty().scene.camera) << "there is nothing";
  EXPECT_NEAR(camera_on_all(preset).target[0], -0.5, 1e-3) << "the ball's, which is no floor";
}

class AdditionsWindow : public test::WindowFixtureOf<test::SceneRuns> {};

TEST_F(AdditionsWindow, EachIsOneEntryAndSelected) {
  open(test::ball_text());
  const preset::Preset before = *workbench.preset();
  apply({command::Select{}});
  for (const char* name : {"Add glass", "Add lamp", "Add sky"}) {
    click(workspace.place_of("menu:Add").value());
    frames(2);
    click(workspace.place_of(std::string("menu:Add/") + name).value());
    frames(3);
    EXPECT_EQ(workbench.edits()->undo_label(), name);
    EXPECT_NE(workbench.view_state().selection, Selection{});
    EXPECT_THAT(workbench.messages(), testing::Each(testing::Field(&Message::error, false)));
    apply({command::Undo{}});
    EXPECT_EQ(workbench.preset()->scene, before.scene);
  }
}

TEST_F(AdditionsWindow, AWhiteThatFittedAnotherPictureIsFoundAnew) {
  runs.white = 2.5;
  open(test::ball_text());
  const auto add_table = [&] {
    apply({command::Edit{"Add table", with_thing(*workbench.preset(), Thing::table).preset}});
    return workbench.preset()->white;
  };
  edit([](preset::Preset& p) { p.white = 3; });
  EXPECT_EQ(add_table(), 3) << "somebody has chosen it";
  edit([](preset::Preset& p) { p.white.reset(); });
  ASSERT_TRUE(until([&] { return workbench.preset()->white == 2.5; }));
  edit([](preset::Preset& p) { p.scene.camera.fov_deg += 1; });
  EXPECT_TRUE(workbench.preset()->white);
  EXPECT_EQ(add_table(), std::nullopt);
}

TEST_F(AdditionsWindow, F5RunsWhereATextIsTyped) {
  runs.steps = 1000000;
  open(test::ball_text());
  const auto& panel = workspace.panel<ParametersPanel>();
  apply({command::ShowPanel{"parameters", true}});
  click_in(panel, "search", 2);
  ASSERT_TRUE(ImGui::GetIO().WantTextInput);
  const auto run = workbench.run().status().generation;
  press(ImGuiKey_F5);
  EXPECT_GT(workbench.run().status().generation, run);
}

TEST_F(AdditionsWindow, AMeshIsAskedForAndAnythingElseRefused) {
  open(test::ball_text());
  apply({command::AddMesh{folder.write("no.json", "{}")}});
  EXPECT_THAT(workbench.messages().back().line, HasSubstr("is no mesh"));
  apply({command::AddMesh{
      folder.write("thing.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")}});
  ASSERT_TRUE(until_files_are_done());
  frames(2);
  EXPECT_EQ(workbench.preset()->scene.objects.back().name, "thing");
}

TEST(Additions, AnObjectTakesItsLampWithIt) {
  preset::Preset preset = preset::parse_preset(test::preset_text, "test");
  preset.scene.lights.push_back({.type = preset::Light::Type::mesh, .object = "wall"});
  const preset::Preset without = without_thing(preset, {Selection::Kind::object, 0});
  EXPECT_TRUE(without.scene.objects.empty());
  EXPECT_EQ(without.scene.lights.size(), 1u) << "the point light stays";
}

} // namespace nephroid::ui::additions_test
