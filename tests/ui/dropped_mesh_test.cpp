// SPDX-License-Identifier: Apache-2.0
// Meshes that are dropped on the window: what becomes of them, and that nothing does of what is none.

#include "tests/support/errors.h"
#include "tests/support/loaded_scenes.h"
#include "workbench_fixture.h"

namespace nephroid::ui::dropped_mesh_test {

/// A closed tetrahedron with edges of 10 along the axes, its corner at (100, 0, 0).
constexpr const char* tetrahedron = "v 100 0 0\nv 110 0 0\nv 100 10 0\nv 100 0 10\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

class DroppedMeshTest : public test::WorkbenchFixture {
protected:
  void SetUp() override { ASSERT_TRUE(workbench.open(folder.write("test.json", test::preset_text))); }
  std::string write(const std::string& name, const std::string& text) { return folder.write(name, text); }
  void drop(const std::string& file)
  {
    workbench.apply({command::Open{file}});
    ASSERT_TRUE(until([&] { return !workbench.works_on_files(); }));
    workbench.update();
  }
  std::string only_error() const
  {
    std::string line;
    for (const Message& message : workbench.messages())
      if (message.error) line += (line.empty() ? "" : " | ") + message.line;
    return line;
  }
};

TEST_F(DroppedMeshTest, IsAnObjectWhereTheCameraLooks)
{
  drop(write("thing.obj", tetrahedron));
  EXPECT_EQ(only_error(), "");
  const preset::Preset& preset = *workbench.preset();
  ASSERT_EQ(preset.scene.objects.size(), 2U);
  const preset::Object& object = preset.scene.objects[1];
  EXPECT_EQ(object.name, "thing");
  EXPECT_EQ(object.material, "wall") << "there is no dielectric";
  // The camera sees 2 * 4 * tan(20 degrees) = 2.91 at its target; 0.4 of that.
  const auto [low, high] = test::world_bounds(scene::load_scene(preset), 1);
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(high[i] - low[i], 0.4 * 2.9118, 0.01);
    EXPECT_NEAR(high[i] + low[i], 0, 0.002) << "its middle is at the camera's target";
  }
  EXPECT_EQ(workbench.edits()->undo_label(), "add thing.obj");
  EXPECT_EQ(workbench.chosen().selection, (Selection{Selection::Kind::object, 1}));
  EXPECT_THAT(workbench.messages().back().line, HasSubstr("the object 'thing' of 'wall'"));
  workbench.apply({command::Undo{}});
  EXPECT_EQ(*workbench.preset(), workbench.edits()->opened());
  EXPECT_EQ(in_preset(workbench.chosen().selection, workbench.preset()), Selection{});
}

TEST_F(DroppedMeshTest, IsOfTheFirstGlassAndOfAnotherName)
{
  preset::Preset edited = *workbench.preset();
  edited.scene.materials["zircon"].type = preset::Material::Type::dielectric;
  edited.scene.objects[0].name = "thing";
  workbench.apply({command::Edit{"edit", edited}});
  drop(write("thing.obj", tetrahedron));
  ASSERT_EQ(workbench.preset()->scene.objects.size(), 2U);
  EXPECT_EQ(workbench.preset()->scene.objects[1].material, "zircon");
  EXPECT_EQ(workbench.preset()->scene.objects[1].name, "thing 2");
}

TEST_F(DroppedMeshTest, GetsGlassWhereThereIsNoMaterial)
{
  preset::Preset edited = *workbench.preset();
  edited.scene.objects.clear();
  edited.scene.materials.clear();
  workbench.apply({command::Edit{"edit", edited}});
  drop(write("thing.obj", tetrahedron));
  ASSERT_EQ(workbench.preset()->scene.objects.size(), 1U);
  EXPECT_EQ(workbench.preset()->scene.materials.at("glass").type, preset::Material::Type::dielectric);
}

TEST_F(DroppedMeshTest, CanBeSavedAndOpened)
{
  drop(write("thing.obj", tetrahedron));
  const std::string file = (folder.path() / "saved.json").string();
  workbench.apply({command::SavePreset{file}});
  EXPECT_EQ(preset::read_preset(file).scene, workbench.preset()->scene);
}

TEST_F(DroppedMeshTest, BrokenOnesChangeNothing)
{
  const std::string bad[][2] = {{"empty.obj", ""},
                                {"no-face.obj", "v 0 0 0\nv 1 0 0\n"},
                                {"flat.obj", "v 0 0 0\nf 1 1 1\n"},
                                {"words.stl", "this is no mesh"},
                                {"nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"}};
  for (const auto& [name, text] : bad) {
    drop(write(name, text));
    EXPECT_THAT(only_error(), HasSubstr(name));
    EXPECT_EQ(only_error().find(" | "), std::string::npos) << "one message: " << only_error();
    EXPECT_EQ(*workbench.preset(), workbench.edits()->opened());
    for (const Message& message : std::vector(workbench.messages())) workbench.apply({command::Dismiss{message.id}});
  }
  drop((folder.path() / "vanished.ply").string());
  EXPECT_THAT(only_error(), HasSubstr("vanished.ply"));
  EXPECT_EQ(*workbench.preset(), workbench.edits()->opened());
}

TEST_F(DroppedMeshTest, OpenOnesAreRefusedWhereThePresetSaysSo)
{
  const std::string file = write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  preset::Preset edited = *workbench.preset();
  edited.scene.materials["glass"].type = preset::Material::Type::dielectric;
  workbench.apply({command::Edit{"edit", edited}});
  drop(file);
  ASSERT_EQ(workbench.preset()->scene.objects.size(), 2U);
  EXPECT_THAT(workbench.messages().back().line, HasSubstr("it is not closed"));
  workbench.apply({command::Undo{}});
  edited.scene.damaged_meshes = preset::Scene::DamagedMeshes::refuse;
  workbench.apply({command::Edit{"refuse", edited}});
  drop(file);
  EXPECT_THAT(only_error(), HasSubstr("not closed"));
  EXPECT_EQ(workbench.preset()->scene.objects.size(), 1U);
}

TEST_F(DroppedMeshTest, OnAnInversePresetIsRefused)
{
  ASSERT_TRUE(workbench.open("inverse/point"));
  workbench.apply({command::Open{write("thing.obj", tetrahedron)}});
  EXPECT_THAT(only_error(), HasSubstr("is a mesh"));
  EXPECT_FALSE(workbench.works_on_files());
}

TEST_F(DroppedMeshTest, ForAPresetThatIsGoneIsForgotten)
{
  const std::string file = write("thing.obj", tetrahedron);
  workbench.apply({command::Open{file}});
  ASSERT_TRUE(workbench.open("spectral/prism"));
  ASSERT_TRUE(until([&] { return !workbench.works_on_files(); }));
  EXPECT_EQ(*workbench.preset(), workbench.edits()->opened());
}

} // namespace nephroid::ui::dropped_mesh_test
