// SPDX-License-Identifier: Apache-2.0
// Loading a scene whose meshes and glasses are in files.
#include "scene/materials.h"
#include "tests/support/errors.h"
#include "tests/support/loaded_scenes.h"
#include "tests/support/temporary_folder.h"

namespace nephroid::scene::scene_files_test {

class SceneFiles : public testing::Test {
protected:
  preset::Preset with_mesh(const std::string& obj) const
  {
    write_file_whole(folder / "mesh.obj", obj);
    preset::Preset preset = ball_over_floor();
    preset.source = (folder / "p.json").string();
    preset.scene.objects[0].shape.reset();
    preset.scene.objects[0].mesh = "mesh.obj";
    return preset;
  }
  const test::TemporaryFolder temporary;
  const std::filesystem::path folder = temporary.path();
};

constexpr const char* tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

TEST_F(SceneFiles, MeshBesideThePreset)
{
  preset::Preset preset = with_mesh(tetrahedron);
  preset.scene.objects.push_back(preset.scene.objects[0]); // the same file twice
  preset.scene.objects[2].name = "twin";
  preset.scene.objects[2].transform.translate = {5, 0, 0};
  preset.scene.objects[0].normals = preset::Object::Normals::smooth;
  const Scene scene = load_scene(preset);
  EXPECT_THAT(scene.warnings, IsEmpty());
  EXPECT_NEAR(volume(scene, 0), 1.0 / 6, 1e-7);
  expect_near(world_bounds(scene, 2).first, {5, 0, 0}, 1e-6);
  expect_near(scene.origin, {3, 0.5, 0.5}, 1e-12);
  for (const glm::vec3& n : scene.geometry.normals) EXPECT_NEAR(glm::length(n), 1, 1e-6); // made here: the file has none
}

TEST_F(SceneFiles, DropsAndSaysSo)
{
  const preset::Preset preset = with_mesh(std::string(tetrahedron) + "f 2 3 4\nf 1 1 2\n");
  const Scene scene = load_scene(preset);
  EXPECT_EQ(scene.objects[0].triangle_count, 4u);
  EXPECT_TRUE(scene.objects[0].closed);
  EXPECT_THAT(scene.warnings,
              ElementsAre("object 'ball': 1 triangle without area dropped", "object 'ball': 1 duplicated triangle dropped"));
}

TEST_F(SceneFiles, ShippedMaterialsHaveShortNamesWhichFilesBesideThePresetGoBefore)
{
  preset::Dispersion dispersion;
  dispersion.type = preset::Dispersion::Type::file;
  dispersion.file = "N-BK7";
  const FileFinder finder(folder);
  const auto n_at_d = [&] { return make_curve(dispersion, finder, "p.json#/n").sample(587.5618).n.value(); };
  EXPECT_NEAR(n_at_d(), 1.5168, 1e-5); // Schott's data sheet
  write_file_whole(folder / "N-BK7", "DATA:\n  - type: tabulated n\n    data: |\n        0.40 1.25\n        0.70 1.25\n");
  EXPECT_EQ(n_at_d(), 1.25);
  dispersion.file = "N-BK77";
  EXPECT_THAT(test::refusal_of([&] { n_at_d(); }), HasSubstr("p.json#/n: 'N-BK77' not found; looked in "));
}

TEST_F(SceneFiles, MaterialFromAFileWithItsRangeAndAbsorption)
{
  write_file_whole(folder / "dye.yml", "DATA:\n  - type: tabulated nk\n    data: |\n        0.40 1.6 0.5\n        0.70 1.5 0.0\n");
  preset::Preset preset = with_mesh(tetrahedron);
  preset::Material& glass = preset.scene.materials["glass"];
  glass.dispersion.type = preset::Dispersion::Type::file;
  glass.dispersion.file = "dye.yml";
  const Scene scene = load_scene(preset);
  EXPECT_TRUE(scene.materials[0].absorbs);
  EXPECT_NEAR(scene.materials[0].k[550 - 380], 0.25, 1e-12);
  EXPECT_NEAR(scene.materials[0].n[0], 1.6, 1e-12); // a table holds its ends
  EXPECT_THAT(scene.warnings, ElementsAre(testing::AllOf(HasSubstr("material 'glass': "), HasSubstr("400"))));
  glass.absorption = false;
  EXPECT_FALSE(load_scene(preset).materials[0].absorbs);
  glass.dispersion.outside = preset::Outside::refuse;
  EXPECT_THAT(refusal(preset), HasSubstr("p.json#/scene/materials/glass/dispersion: "));
}

TEST_F(SceneFiles, TheBunnyIsClosedAndWhole)
{
  if (!std::filesystem::exists("/usr/share/glmark2/models/bunny.obj")) GTEST_SKIP() << "glmark2-data is not installed";
  preset::Preset preset = ball_over_floor();
  preset.scene.objects[0].shape.reset();
  preset.scene.objects[0].mesh = "/usr/share/glmark2/models/bunny.obj";
  const Scene scene = load_scene(preset);
  EXPECT_EQ(scene.objects[0].triangle_count, 69666u);
  EXPECT_TRUE(scene.objects[0].closed);
  EXPECT_THAT(scene.warnings, IsEmpty());
}

} // namespace nephroid::scene::scene_files_test
