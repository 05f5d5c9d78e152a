// SPDX-License-Identifier: Apache-2.0
// Loading a scene: places and orientation of objects, what contains what, warnings about them; meshes and glasses in
// files; contradictions between fields, refused at the right place.
#include "base/bytes.h"
#include "image/image.h"
#include "scatter/spectra.h"
#include "scene/scene.h"
#include "tests/support/loaded_scenes.h"

namespace nephroid::scene::scene_test {

using namespace nephroid::scatter;

using preset::Shape;

TEST(Scene, HoldsWhatThePresetSays) {
  const Scene scene = load_scene(ball_over_floor());
  EXPECT_THAT(scene.warnings, IsEmpty());
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.objects[0].triangle_count, 0u);
  EXPECT_EQ(scene.objects[0].ellipsoid_count, 1u);
  EXPECT_EQ(scene.objects[1].first_triangle, 0u);
  EXPECT_THAT(scene.object_of_primitive, ElementsAre(1, 1, 0)); // the floor's triangles first
  EXPECT_EQ(scene.geometry.normals.size(), scene.geometry.positions.size());
  EXPECT_TRUE(scene.objects[0].closed);
  EXPECT_FALSE(scene.objects[1].closed);
  EXPECT_NEAR(scene.objects[0].bounds.radius, 0.5, 1e-5);
  EXPECT_EQ(scene.materials[static_cast<std::size_t>(scene.objects[1].material)].name, "wall");
  EXPECT_NEAR(scene.objects[1].bounds.radius, std::sqrt(50.0), 1e-4);
}

// The ball's middle becomes the origin; everything else keeps its distance from it, to the precision of a float near 0.
TEST(Scene, MovesToItsOriginAndBack) {
  for (const glm::dvec3& away : {glm::dvec3(0), glm::dvec3(1e6, -2e6, 3e6)}) {
    preset::Preset preset = ball_over_floor();
    const auto move = [&](preset::Vec3& v) { v = {v[0] + away.x, v[1] + away.y, v[2] + away.z}; };
    for (preset::Object& object : preset.scene.objects) move(object.transform.translate);
    move(preset.scene.lights[0].position);
    move(preset.scene.camera.position);
    move(preset.scene.camera.target);
    const Scene scene = load_scene(preset);
    expect_near(scene.origin, away, 1e-9);
    expect_near(glm::dvec3(scene.lights[0].position), {0, 3, 0}, 1e-9);
    expect_near(scene.origin + glm::dvec3(scene.camera.position), glm::dvec3(0, 1, 4) + away, 1e-9);
    expect_near(world_bounds(scene, 1).first, glm::dvec3(-5, -1, -5) + away, 1e-9);
    EXPECT_NEAR(volume(scene, 0), volume(load_scene(ball_over_floor()), 0), 1e-9);
  }
}

TEST(Scene, OriginWithoutAnythingThatBends) {
  preset::Preset preset = ball_over_floor();
  preset.scene.objects.erase(preset.scene.objects.begin());
  expect_near(load_scene(preset).origin, {0, -1, 0}, 1e-12); // the floor's middle
  preset.scene.objects.clear();
  preset.scene.lights.clear();
  preset.scene.camera.target = {7, 8, 9};
  const Scene empty = load_scene(preset);
  expect_near(empty.origin, {7, 8, 9}, 1e-12);
  EXPECT_TRUE(empty.geometry.triangles.empty());
}

// Scale, then rotate about x, y, z, then translate. The box's corner (1, 2, 3)/2 -> scaled (2, 2, 3)/2 -> about x by
// 90: (x, -z, y) -> about z by 90: (-y, x, z). Extents 2, 2, 3 become 2, 3, 2 and then 3, 2, 2.
TEST(Scene, TransformsInOrder) {
  preset::Preset preset = ball_over_floor();
  preset.scene.objects[0] = shape_object("box", Shape::Type::box, "glass");
  preset.scene.objects[0].shape->size = {1, 2, 3};
  preset.scene.objects[0].transform = {{2, 1, 1}, {90, 0, 90}, {10, 20, 30}};
  const auto [low, high] = world_bounds(load_scene(preset), 0);
  expect_near(high - low, {3, 2, 2}, 1e-6);
  expect_near(0.5 * (low + high), {10, 20, 30}, 1e-6);

  // A prism tells directions apart: its apex edge, at +z and along y, goes to -y and along z by 90 degrees about x:
  // (x, y, z) -> (x, -z, y).
  preset.scene.objects[0] = shape_object("prism", Shape::Type::prism, "glass");
  preset.scene.objects[0].transform.rotate_deg = {90, 0, 0};
  const Scene scene = load_scene(preset);
  int apex_corners = 0;
  for (std::uint32_t t = 0; t < scene.objects[0].triangle_count; ++t)
    for (int i = 0; i < 3; ++i) {
      const glm::vec3 p = scene.geometry.positions[scene.geometry.triangles[t][i]];
      if (std::abs(p.x) > 1e-6f) continue;
      EXPECT_NEAR(p.y, -std::sqrt(3.0) / 4, 1e-6);
      ++apex_corners;
    }
  EXPECT_GT(apex_corners, 0);
}

TEST(Scene, MirroringKeepsTrianglesOutwards) {
  preset::Preset preset = ball_over_floor();
  preset.scene.objects[0] = shape_object("stone", Shape::Type::brilliant, "glass");
  const double before = volume(load_scene(preset), 0);
  preset.scene.objects[0].transform.scale = {-2, 1, 1};
  const Scene scene = load_scene(preset);
  EXPECT_NEAR(volume(scene, 0), 2 * before, 1e-6);
  EXPECT_THAT(scene.warnings, IsEmpty());
  const Object& stone = scene.objects[0];
  for (std::uint32_t t = stone.first_triangle; t < stone.first_triangle + stone.triangle_count; ++t) {
    const glm::uvec3& v = scene.geometry.triangles[t];
    const glm::vec3 a = scene.geometry.positions[v.x];
    const glm::vec3 n =
        glm::normalize(glm::cross(scene.geometry.positions[v.y] - a, scene.geometry.positions[v.z] - a));
    EXPECT_GT(glm::dot(n, scene.geometry.normals[v.x]), 0.9999f);
  }
}

TEST(Scene, HoldsAtAMillimetreAndAKilometre) {
  for (double scale : {1e-3, 1.0, 1e3}) {
    preset::Preset preset = ball_over_floor();
    for (preset::Object& object : preset.scene.objects)
      for (std::size_t i = 0; i < 3; ++i) {
        object.transform.scale[i] *= scale;
        object.transform.translate[i] *= scale;
      }
    const Scene scene = load_scene(preset);
    EXPECT_THAT(scene.warnings, IsEmpty());
    EXPECT_NEAR(volume(scene, 0) / std::pow(scale, 3), volume(load_scene(ball_over_floor()), 0), 1e-6);
    EXPECT_TRUE(scene.objects[0].closed);
  }
}

TEST(Scene, WarnsWherePrecisionIsLost) {
  preset::Preset preset = ball_over_floor();
  preset.scene.objects.push_back(shape_object("far", Shape::Type::box, "mirror"));
  preset.scene.objects.back().transform.translate = {0, 0, 4e5};
  EXPECT_THAT(load_scene(preset).warnings, Contains(HasSubstr("object 'far': is 1 units across but 200000 away")));
}

// Nested balls of glass: the light in the middle is inside both, the outer (larger) one first; the camera between them
// is in one.
TEST(Scene, KnowsWhatContainsLightAndCamera) {
  preset::Preset preset = ball_over_floor();
  preset.scene.objects.push_back(shape_object("shell", Shape::Type::sphere, "glass"));
  preset.scene.objects.push_back(shape_object("silvered", Shape::Type::sphere, "mirror"));
  preset.scene.objects[2].transform.scale = {4, 4, 4};
  preset.scene.objects[3].transform.scale = {9, 9, 9};
  preset.scene.lights[0].position = {0, 0.1, 0};
  preset.scene.camera.position = {0, 0, 1.5};
  preset.scene.lights.push_back(preset.scene.lights[0]);
  preset.scene.lights[1].type = preset::Light::Type::directional;
  const Scene scene = load_scene(preset);
  EXPECT_THAT(scene.lights[0].inside, ElementsAre(2, 0));
  EXPECT_THAT(scene.camera.inside, ElementsAre(2));
  EXPECT_THAT(scene.lights[1].inside, IsEmpty()); // it comes from far away
  EXPECT_THAT(dielectrics_around(scene, {0, 0, 5}), IsEmpty());
}

TEST(Scene, ClosedDielectricsAreTurnedOutwards) {
  preset::Preset preset = ball_over_floor();
  preset.scene.objects[0].shape->inwards = true;
  const Scene turned = load_scene(preset);
  EXPECT_GT(volume(turned, 0), 0);
  EXPECT_THAT(turned.warnings, ElementsAre("object 'ball': is inside out; its surface is turned round"));
  EXPECT_GT(normal_at(turned.geometry.ellipsoids[0], {0, 1, 0}).y, 0);
  preset.scene.objects[0].material = "wall"; // a room may face inwards
  EXPECT_LT(volume(load_scene(preset), 0), 0);
}

// Turned about any axis and mirrored, a sphere stays the same one; a scale that differs by axis makes an ellipsoid,
// whose half axes turn with it.
TEST(Scene, SpheresAndWhatAScaleMakesOfThem) {
  preset::Preset preset = ball_over_floor();
  preset.scene.objects[0].transform = {{-3, 3, 3}, {10, 20, 30}, {5, 6, 7}};
  const Scene sphere = load_scene(preset);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(sphere.geometry.ellipsoids[0].half_axes[static_cast<std::size_t>(k)][k], 1.5f);
  EXPECT_FALSE(sphere.geometry.ellipsoids[0].inwards);
  EXPECT_NEAR(volume(sphere, 0), 4.0 / 3 * M_PI * 1.5 * 1.5 * 1.5, 1e-5);
  const auto [low, high] = world_bounds(sphere, 0);
  test::expect_near(low, {3.5, 4.5, 5.5});
  test::expect_near(high, {6.5, 7.5, 8.5});

  preset.scene.objects[0].transform = {{2, 4, 6}, {0, 0, 30}, {5, 6, 7}};
  const Scene scene = load_scene(preset);
  const Ellipsoid& ellipsoid = scene.geometry.ellipsoids[0];
  EXPECT_NEAR(volume(scene, 0), 4.0 / 3 * M_PI * 1 * 2 * 3, 1e-5);
  // (x / 1)^2 + (y / 2)^2 = 1, turned by 30 degrees, reaches to sqrt((1 cos 30)^2 + (2 sin 30)^2) along x.
  test::expect_near(world_bounds(scene, 0).second - glm::dvec3(5, 6, 7), {std::sqrt(0.75 + 1), std::sqrt(0.25 + 3), 3});
  const glm::dvec3 tip = glm::dvec3(ellipsoid.centre) + glm::dvec3(std::cos(M_PI / 6), std::sin(M_PI / 6), 0);
  test::expect_near(normal_at(ellipsoid, tip), {std::cos(M_PI / 6), std::sin(M_PI / 6), 0});
  EXPECT_TRUE(contains(ellipsoid, glm::dvec3(ellipsoid.centre) + 0.999 * (tip - glm::dvec3(ellipsoid.centre))));
  EXPECT_FALSE(contains(ellipsoid, glm::dvec3(ellipsoid.centre) + 1.001 * (tip - glm::dvec3(ellipsoid.centre))));
}

// On a floor a ball meets one point of it, and nothing is moved; two balls in one place are parted.
TEST(Scene, BallsTouchInAPoint) {
  preset::Preset preset = ball_over_floor();
  preset.scene.objects[0].transform.translate = {0, -0.5, 0};
  const Scene standing = load_scene(preset);
  EXPECT_THAT(standing.warnings, IsEmpty());
  EXPECT_EQ(standing.geometry.ellipsoids[0].half_axes[0].x, 0.5f);
  preset.scene.objects.push_back(preset.scene.objects[0]);
  preset.scene.objects.back().name = "twin";
  const Scene twins = load_scene(preset);
  EXPECT_THAT(twins.warnings, ElementsAre(HasSubstr("object 'twin' is a copy of object 'ball' in the same place")));
  EXPECT_LT(twins.geometry.ellipsoids[0].half_axes[0].x, 0.5f);
}

TEST(Scene, WarnsOfOpenDielectrics) {
  preset::Preset preset = ball_over_floor();
  preset.scene.objects[1].material = "glass";
  EXPECT_THAT(load_scene(preset).warnings,
              ElementsAre(HasSubstr("object 'floor': dielectric, but not closed: 4 edges")));
}

class SceneFiles : public testing::Test {
protected:
  preset::Preset with_mesh(const std::string& obj) const {
    write_file_whole(folder / "mesh.obj", obj);
    preset::Preset preset = ball_over_floor();
    preset.source = (folder / "p.json").string();
    preset.scene.objects[0].shape.reset();
    preset.scene.objects[0].mesh = "mesh.obj";
    return preset;
  }
  const test::TemporaryFolder temporary;
  const fs::path folder = temporary.path();
};

constexpr const char* tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

TEST_F(SceneFiles, MeshBesideThePreset) {
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
  for (const glm::vec3& n : scene.geometry.normals)
    EXPECT_NEAR(glm::length(n), 1, 1e-6); // made here: the file has none
}

TEST_F(SceneFiles, DropsAndSaysSo) {
  const preset::Preset preset = with_mesh(std::string(tetrahedron) + "f 2 3 4\nf 1 1 2\n");
  const Scene scene = load_scene(preset);
  EXPECT_EQ(scene.objects[0].triangle_count, 4u);
  EXPECT_TRUE(scene.objects[0].closed);
  EXPECT_THAT(scene.warnings, ElementsAre("object 'ball': 1 triangle without area dropped",
                                          "object 'ball': 1 duplicated triangle dropped"));
}

TEST_F(SceneFiles, ShippedMaterialsHaveShortNamesWhichFilesBesideThePresetGoBefore) {
  preset::Dispersion dispersion{.type = preset::Dispersion::Type::file, .file = "N-BK7"};
  const FileFinder finder(folder);
  const auto n_at_d = [&] { return make_curve(dispersion, finder, "p.json#/n").sample(587.5618).n.value(); };
  EXPECT_NEAR(n_at_d(), 1.5168, 1e-5); // Schott's data sheet
  write_file_whole(folder / "N-BK7",
                   "DATA:\n  - type: tabulated n\n    data: |\n        0.40 1.25\n        0.70 1.25\n");
  EXPECT_EQ(n_at_d(), 1.25);
  dispersion.file = "N-BK77";
  EXPECT_THAT(test::refusal_of([&] { n_at_d(); }),
              AllOf(HasSubstr("p.json#/n: 'N-BK77' not found; looked in "), HasSubstr("the program comes with"),
                    HasSubstr(", N-BK7, "), HasSubstr("; did you mean 'N-BK7'?")));
}

TEST(Scene, ShippedMaterialsAreReadByTheNamesOfPresets) {
  const std::vector<ShippedMaterial> shipped = read_shipped_materials();
  EXPECT_EQ(shipped.size(), shipped_materials().size());
  std::set<std::string> metals;
  for (const ShippedMaterial& material : shipped) {
    preset::Material of;
    of.type = material.metal ? preset::Material::Type::conductor : preset::Material::Type::dielectric;
    of.metal = of.dispersion.file = material.name;
    of.dispersion.type = preset::Dispersion::Type::file;
    std::vector<std::string> warnings;
    EXPECT_NO_THROW(make_material("new", of, FileFinder(), "test", warnings)) << material.name;
    if (material.metal) metals.insert(material.name);
  }
  EXPECT_THAT(metals, testing::ElementsAre("aluminium", "brass", "copper", "gold", "silver"));
  const auto glass = std::ranges::find(shipped, "N-BK7", &ShippedMaterial::name);
  ASSERT_NE(glass, shipped.end());
  EXPECT_NEAR(glass->n_d.value(), 1.5168, 1e-5) << "Schott's catalogue";
  EXPECT_NEAR(glass->abbe.value(), 64.17, 0.01);
}

TEST_F(SceneFiles, MaterialFromAFileWithItsRangeAndAbsorption) {
  write_file_whole(folder / "dye.yml",
                   "DATA:\n  - type: tabulated nk\n    data: |\n        0.40 1.6 0.5\n        0.70 1.5 0.0\n");
  preset::Preset preset = with_mesh(tetrahedron);
  preset::Material& glass = preset.scene.materials["glass"];
  glass.dispersion.type = preset::Dispersion::Type::file;
  glass.dispersion.file = "dye.yml";
  const Scene scene = load_scene(preset);
  EXPECT_TRUE(scene.materials[0].absorbs);
  EXPECT_NEAR(scene.materials[0].k[550 - 380], 0.25, 1e-12);
  EXPECT_NEAR(scene.materials[0].n[0], 1.6, 1e-12); // a table holds its ends
  EXPECT_THAT(scene.warnings, ElementsAre(AllOf(HasSubstr("material 'glass': "), HasSubstr("400"))));
  glass.absorption = false;
  EXPECT_FALSE(load_scene(preset).materials[0].absorbs);
  glass.dispersion.outside = preset::Extrapolation::refuse;
  EXPECT_THAT(refusal(preset), HasSubstr("p.json#/scene/materials/glass/dispersion: "));
}

TEST_F(SceneFiles, TheBunnyIsClosedAndWhole) {
  if (!fs::exists("/usr/share/glmark2/models/bunny.obj")) GTEST_SKIP() << "glmark2-data is not installed";
  preset::Preset preset = ball_over_floor();
  preset.scene.objects[0].shape.reset();
  preset.scene.objects[0].mesh = "/usr/share/glmark2/models/bunny.obj";
  const Scene scene = load_scene(preset);
  EXPECT_EQ(scene.objects[0].triangle_count, 69666u);
  EXPECT_TRUE(scene.objects[0].closed);
  EXPECT_THAT(scene.warnings, IsEmpty());
}

TEST(SceneRefusals, PointAtTheRightPlace) {
  using S = preset::Scene;
  using L = preset::Light;
  const std::pair<const char*, std::function<void(S&)>> wrongs[] = {
      {"objects/1/name: 'ball' is also object 0", [](S& s) { s.objects[1].name = "ball"; }},
      {"objects/0/mesh: 'no.obj' not found", [](S& s) { s.objects[0].shape.reset(), s.objects[0].mesh = "no.obj"; }},
      {"objects/0: is 1e-09 units across", [](S& s) { s.objects[0].transform.scale.fill(1e-9); }},
      {"objects/1: reaches 5e+10 units away", [](S& s) { s.objects[1].transform.scale[0] = 1e11; }},
      {"objects/0: has a vertex at", [](S& s) { s.objects[0].transform.scale[0] = 1e300; }},
      {"lights/0/position: (0, 1e+12, 0) is too far away", [](S& s) { s.lights[0].position[1] = 1e12; }},
      {"lights/0/spectrum: ", [](S& s) { s.lights[0].spectrum.illuminant = "D66"; }},
      {"lights/0/direction: (0, 0, 0) has no direction",
       [](S& s) { s.lights[0].type = L::Type::directional, s.lights[0].direction.fill(0); }},
      {"lights/0/up: (0, 1, 0) is parallel",
       [](S& s) { s.lights[0].type = L::Type::area, s.lights[0].up = s.camera.up; }},
      {"materials/a~1b~0c/dispersion: ",
       [](S& s) { s.materials["a/b~c"] = {.type = preset::Material::Type::dielectric, .dispersion = {.n = -1}}; }},
      {"materials/m/metal: water-20C-Daimon has no k",
       [](S& s) { s.materials["m"] = {.type = preset::Material::Type::conductor, .metal = "water"}; }},
      {"materials/m/coating: is on a thin pane",
       [](S& s) {
         s.materials["m"] = {.type = preset::Material::Type::dielectric, .thin = true, .coating = preset::Coating()};
       }},
      {"objects/0: object 'ball' has a texture, but no u, v",
       [](S& s) {
         preset::Material& m = s.materials[s.objects[0].material] = {};
         m.texture.emplace().type = preset::Texture::Type::checkerboard;
       }},
      {"materials/m/texture/file: 'no.png' not found",
       [](S& s) { s.materials["m"].texture.emplace().file = "no.png"; }},
      {"objects/0: object 'ball' has a texture, but no u, v",
       [](S& s) {
         s.materials["wall"].normal_map.emplace().type = preset::Texture::Type::checkerboard,
         s.objects[0].material = "wall";
       }},
      {"materials/mirror/roughness_texture/file: 'no.png' not found",
       [](S& s) {
         s.materials["mirror"].roughness = 1, s.materials["mirror"].roughness_texture.emplace().file = "no.png";
       }},
      {"materials/mirror/roughness_texture: multiplies a roughness of 0",
       [](S& s) { s.materials["mirror"].roughness_texture.emplace().file = "no.png"; }},
      {"materials/glass/tint_texture/file: 'no.png' not found",
       [](S& s) { s.materials["glass"].tint_texture.emplace().file = "no.png"; }},
      {"camera/target: (0, 0, 0) has no direction", [](S& s) { s.camera.target = s.camera.position; }}};
  for (const auto& [says, change] : wrongs) {
    preset::Preset preset = ball_over_floor();
    change(preset.scene);
    EXPECT_THAT(refusal(preset), StartsWith(std::string("p.json#/scene/") + says));
  }
}

TEST(Textures, HaveTheNumbersThatTheyAreOf) {
  const TemporaryFolder folder;
  image::write_png(folder.path() / "p.png", 1, 1, {0.5f, 0.25f, 1}); // sRGB: 188, 137, 255
  const preset::Texture given{.file = (folder.path() / "p.png").string()};
  std::vector<std::string> warnings;
  const auto texels = [&](const Texture& texture) {
    return glm::dvec3((*texture.rgb)[0], (*texture.rgb)[1], (*texture.rgb)[2]) / 65535.0;
  };
  const auto expect_texels = [&](const Texture& texture, const glm::dvec3& rgb) {
    EXPECT_LT(glm::distance(texels(texture), rgb), 3e-3);
  };
  const FileFinder finder(folder.path());
  expect_texels(make_texture(given, Texels::colours, finder, "p.json", "m", warnings), {0.5, 0.25, 1});
  const glm::dvec3 raw(188.0 / 255, 137.0 / 255, 1);
  expect_texels(make_texture(given, Texels::numbers, finder, "p.json", "m", warnings), raw);
  // x and y are scaled, or z is divided: the direction is the same.
  const glm::dvec3 normal = 2.0 * raw - 1.0;
  for (const double scale : {0.5, 1.0, 4.0, -2.0}) {
    const glm::dvec3 scaled = 2.0 * texels(make_normal_map(given, scale, finder, "p.json", "m", warnings)) - 1.0;
    EXPECT_LT(glm::distance(glm::normalize(scaled), glm::normalize(glm::dvec3(scale, scale, 1) * normal)), 3e-3);
  }
  EXPECT_THAT(warnings, IsEmpty());
  ByteStore grey;
  image::write_png16(grey, 1, 1, {1000}, "grey");
  folder.write("grey.png", std::string(reinterpret_cast<const char*>(grey.bytes().data()), grey.bytes().size()));
  EXPECT_THAT(refusal_of([&] { make_normal_map({.file = "grey.png"}, 1, finder, "p.json", "m", warnings); }),
              StartsWith("p.json: is a grey picture"));
}

} // namespace nephroid::scene::scene_test
