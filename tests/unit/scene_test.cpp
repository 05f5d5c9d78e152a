// SPDX-License-Identifier: Apache-2.0
// Loading a scene: places and orientation of objects, materials and spectra, what contains what, warnings and refusals.
#include "base/error.h"
#include "base/files.h"
#include "optics/wavelength.h"
#include "preset/preset.h"
#include "scene/materials.h"
#include "scene/mesh.h"
#include "scene/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <numeric>
#include <random>

namespace nephroid::scene {
namespace {

namespace fs = std::filesystem;
using preset::Shape;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

preset::Object shape_object(const std::string& name, Shape::Type type, const std::string& material)
{
  preset::Object object;
  object.name = name;
  object.shape = Shape{};
  object.shape->type = type;
  object.material = material;
  return object;
}

/// A glass ball of diameter 1 at the origin over a wall, a point light above.
preset::Preset simple()
{
  preset::Preset preset;
  preset.source = "p.json";
  preset.scene.materials["glass"].type = preset::Material::Type::dielectric;
  preset.scene.materials["mirror"].type = preset::Material::Type::mirror;
  preset.scene.materials["wall"];
  preset.scene.objects = {shape_object("ball", Shape::Type::sphere, "glass"), shape_object("floor", Shape::Type::quad, "wall")};
  preset.scene.objects[0].shape->segments = 32;
  preset.scene.objects[1].transform.scale = {10, 1, 10};
  preset.scene.objects[1].transform.translate = {0, -1, 0};
  preset.scene.lights.resize(1);
  preset.scene.lights[0].position = {0, 3, 0};
  return preset;
}

std::string refusal(const preset::Preset& preset)
{
  try {
    load_scene(preset);
    return "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::bad_input) << error.line();
    return error.line();
  }
}

/// Lowest and highest corner of an object's triangles in the preset's coordinates.
std::pair<glm::dvec3, glm::dvec3> world_bounds(const Scene& scene, std::size_t index)
{
  const Object& object = scene.objects[index];
  glm::dvec3 low(1e300), high(-1e300);
  for (std::uint32_t t = object.first_triangle; t < object.first_triangle + object.triangle_count; ++t)
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 p = scene.origin + glm::dvec3(scene.geometry.positions[scene.geometry.triangles[t][i]]);
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  return {low, high};
}

double volume(const Scene& scene, std::size_t index)
{
  return signed_volume(scene.geometry, scene.objects[index].first_triangle, scene.objects[index].triangle_count);
}

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance)
{
  EXPECT_LT(glm::distance(a, b), tolerance) << a.x << " " << a.y << " " << a.z;
}

TEST(Scene, HoldsWhatThePresetSays)
{
  const Scene scene = load_scene(simple());
  EXPECT_THAT(scene.warnings, IsEmpty());
  ASSERT_EQ(scene.objects.size(), 2u);
  EXPECT_EQ(scene.objects[0].triangle_count, 32u * 15 * 2);
  EXPECT_EQ(scene.objects[1].first_triangle, scene.objects[0].triangle_count);
  EXPECT_EQ(scene.geometry.triangles.size(), scene.object_of_triangle.size());
  EXPECT_EQ(scene.object_of_triangle.front(), 0u);
  EXPECT_EQ(scene.object_of_triangle.back(), 1u);
  EXPECT_EQ(scene.geometry.normals.size(), scene.geometry.positions.size());
  EXPECT_TRUE(scene.objects[0].closed);
  EXPECT_FALSE(scene.objects[1].closed);
  EXPECT_NEAR(scene.objects[0].bounds.radius, 0.5, 1e-5);
  EXPECT_EQ(scene.materials[static_cast<std::size_t>(scene.objects[1].material)].name, "wall");
  EXPECT_NEAR(scene.objects[1].bounds.radius, std::sqrt(50.0), 1e-4);
}

// The ball's middle becomes the origin; everything else keeps its distance from it, to the precision of a float near 0.
TEST(Scene, MovesToItsOriginAndBack)
{
  for (const glm::dvec3& away : {glm::dvec3(0), glm::dvec3(1e6, -2e6, 3e6)}) {
    preset::Preset preset = simple();
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
    EXPECT_NEAR(volume(scene, 0), volume(load_scene(simple()), 0), 1e-9);
  }
}

TEST(Scene, OriginWithoutAnythingThatBends)
{
  preset::Preset preset = simple();
  preset.scene.objects.erase(preset.scene.objects.begin());
  expect_near(load_scene(preset).origin, {0, -1, 0}, 1e-12); // the floor's middle
  preset.scene.objects.clear();
  preset.scene.lights.clear();
  preset.scene.camera.target = {7, 8, 9};
  const Scene empty = load_scene(preset);
  expect_near(empty.origin, {7, 8, 9}, 1e-12);
  EXPECT_TRUE(empty.geometry.triangles.empty());
}

// Scale, then rotate about x, y, z, then translate. The box's corner (1, 2, 3)/2 -> scaled (2, 2, 3)/2 -> about x by 90:
// (x, -z, y) -> about z by 90: (-y, x, z). Extents 2, 2, 3 become 2, 3, 2 and then 3, 2, 2.
TEST(Scene, TransformsInOrder)
{
  preset::Preset preset = simple();
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

TEST(Scene, MirroringKeepsTrianglesOutwards)
{
  preset::Preset preset = simple();
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
    const glm::vec3 n = glm::normalize(glm::cross(scene.geometry.positions[v.y] - a, scene.geometry.positions[v.z] - a));
    EXPECT_GT(glm::dot(n, scene.geometry.normals[v.x]), 0.9999f);
  }
}

// An ellipsoid's normals are those of the inverse transpose: at p they point along p / (semi-axes squared).
TEST(Scene, NormalsOfAStretchedBall)
{
  preset::Preset preset = simple();
  preset.scene.objects[0].transform.scale = {4, 1, 2};
  preset.scene.objects[0].normals = preset::Object::Normals::smooth;
  const Scene scene = load_scene(preset);
  EXPECT_TRUE(scene.objects[0].smooth);
  for (std::uint32_t t = 0; t < scene.objects[0].triangle_count; ++t) {
    const std::uint32_t v = scene.geometry.triangles[t].x;
    expect_near(scene.geometry.normals[v], glm::normalize(glm::dvec3(scene.geometry.positions[v]) / glm::dvec3(16, 1, 4)), 1e-5);
  }
}

TEST(Scene, HoldsAtAMillimetreAndAKilometre)
{
  for (double scale : {1e-3, 1.0, 1e3}) {
    preset::Preset preset = simple();
    for (preset::Object& object : preset.scene.objects)
      for (std::size_t i = 0; i < 3; ++i) {
        object.transform.scale[i] *= scale;
        object.transform.translate[i] *= scale;
      }
    const Scene scene = load_scene(preset);
    EXPECT_THAT(scene.warnings, IsEmpty());
    EXPECT_NEAR(volume(scene, 0) / std::pow(scale, 3), volume(load_scene(simple()), 0), 1e-6);
    EXPECT_TRUE(scene.objects[0].closed);
  }
}

TEST(Scene, WarnsWherePrecisionIsLost)
{
  preset::Preset preset = simple();
  preset.scene.objects.push_back(shape_object("far", Shape::Type::box, "mirror"));
  preset.scene.objects.back().transform.translate = {0, 0, 1e6};
  EXPECT_THAT(load_scene(preset).warnings, Contains(HasSubstr("object 'far': is 1 units across but 500000 away")));
}

// Nested balls of glass: the light in the middle is inside both, the outer (larger) one first; the camera between them is in one.
TEST(Scene, KnowsWhatContainsLightAndCamera)
{
  preset::Preset preset = simple();
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

TEST(Scene, ClosedDielectricsAreTurnedOutwards)
{
  preset::Preset preset = simple();
  preset.scene.objects[0].shape->inwards = true;
  const Scene turned = load_scene(preset);
  EXPECT_GT(volume(turned, 0), 0);
  EXPECT_THAT(turned.warnings, ElementsAre("object 'ball': was inside out; its triangles are turned round"));
  EXPECT_GT(glm::dot(turned.geometry.normals[5], turned.geometry.positions[5]), 0);
  preset.scene.objects[0].material = "wall"; // a room may face inwards
  EXPECT_LT(volume(load_scene(preset), 0), 0);
}

TEST(Scene, WarnsOfOpenDielectrics)
{
  preset::Preset preset = simple();
  preset.scene.objects[1].material = "glass";
  EXPECT_THAT(load_scene(preset).warnings, ElementsAre(HasSubstr("object 'floor': dielectric, but not closed: 4 edges")));
}

TEST(Scene, AreaLightHasItsEdges)
{
  preset::Preset preset = simple();
  preset::Light& light = preset.scene.lights[0];
  light.type = preset::Light::Type::area;
  light.direction = {0, -2, 0};
  light.up = {0, 1, 1};
  light.size = {3, 5};
  const Light area = load_scene(preset).lights[0];
  expect_near(area.direction, {0, -1, 0}, 1e-7);
  expect_near(area.edge_v, {0, 0, 5}, 1e-6);
  expect_near(area.edge_u, {3, 0, 0}, 1e-6);
  expect_near(glm::cross(area.edge_u, area.edge_v), {0, -15, 0}, 1e-5);

  light.size = {3, 100};
  light.position = {0, 0.3, 0}; // in the ball, its corners outside
  EXPECT_THAT(load_scene(preset).warnings, ElementsAre(HasSubstr("light 0: reaches through the surface of a dielectric")));
}

TEST(Scene, LightsKeepTheirFigures)
{
  preset::Preset preset = simple();
  preset::Light& light = preset.scene.lights[0];
  light.type = preset::Light::Type::spot;
  light.half_angle_deg = 60;
  light.power_w = 7;
  light.spectrum.illuminant = "F10";
  const Light spot = load_scene(preset).lights[0];
  EXPECT_NEAR(spot.cos_half_angle, 0.5, 1e-12);
  EXPECT_EQ(spot.power_w, 7);
  EXPECT_NEAR(std::accumulate(spot.spectrum.begin(), spot.spectrum.end(), 0.0), 1, 1e-12);
  light.type = preset::Light::Type::directional;
  light.irradiance_w_m2 = 1361;
  EXPECT_EQ(load_scene(preset).lights[0].irradiance_w_m2, 1361);
}

TEST(Scene, MaterialsOnTheWavelengths)
{
  preset::Preset preset = simple();
  // Schott N-BK7: n_d(587.5618 nm) = 1.5168.
  preset::Dispersion& glass = preset.scene.materials["glass"].dispersion;
  glass.type = preset::Dispersion::Type::sellmeier;
  glass.b = {1.03961212, 0.231792344, 1.01046945};
  glass.c_um2 = {0.00600069867, 0.0200179144, 103.560653};
  preset.scene.materials["wall"].reflectance.value = 0.25;
  const Scene scene = load_scene(preset);
  EXPECT_NEAR(scene.materials[0].n[588 - optics::first_nm], 1.5168, 5e-5);
  EXPECT_FALSE(scene.materials[0].absorbs);
  EXPECT_EQ(scene.materials[1].type, Material::Type::mirror);
  EXPECT_DOUBLE_EQ(scene.materials[1].reflectance[200], 0.8);
  EXPECT_DOUBLE_EQ(scene.materials[2].reflectance[0], 0.25);
}

TEST(Scene, EveryKindOfDispersionSpectrumAndReflectance)
{
  const FileFinder finder;
  const auto index_at = [&](const preset::Dispersion& d, double nm) { return *make_curve(d, finder, "w").sample(nm).n; };
  preset::Dispersion d;
  d.n = 1.33;
  EXPECT_DOUBLE_EQ(index_at(d, 500), 1.33);
  d.type = preset::Dispersion::Type::cauchy;
  d.coefficients = {1.5, 0.01}; // 1.5 + 0.01 / 0.25 at 500 nm
  EXPECT_NEAR(index_at(d, 500), 1.54, 1e-12);
  d.type = preset::Dispersion::Type::table;
  d.table = {{400, 1.6}, {600, 1.5}};
  EXPECT_NEAR(index_at(d, 450), 1.575, 1e-12);
  d.type = preset::Dispersion::Type::points;
  EXPECT_NEAR(index_at(d, 600), 1.5, 1e-12);

  preset::LightSpectrum s;
  s.type = preset::LightSpectrum::Type::lines;
  s.table = {{500, 3}, {600.5, 1}};
  const optics::Spectrum lines = make_light_spectrum(s, "w");
  EXPECT_NEAR(lines[120], 0.75, 1e-12);
  EXPECT_NEAR(lines[220], 0.125, 1e-12);
  s.type = preset::LightSpectrum::Type::table;
  s.table = {{380, 1}, {780, 1}};
  EXPECT_NEAR(make_light_spectrum(s, "w")[7], 1.0 / 401, 1e-15);
  s.type = preset::LightSpectrum::Type::blackbody;
  s.temperature_k = 3000;
  EXPECT_GT(make_light_spectrum(s, "w")[400], 5 * make_light_spectrum(s, "w")[0]); // reddish

  preset::Reflectance r;
  r.type = preset::Reflectance::Type::table;
  r.table = {{400, 0}, {600, 1}};
  EXPECT_NEAR(make_reflectance(r, "w")[120], 0.5, 1e-12);
  r.type = preset::Reflectance::Type::patch;
  r.patch = "blue sky";
  EXPECT_GT(make_reflectance(r, "w")[450 - 380], make_reflectance(r, "w")[650 - 380]);

  EXPECT_EQ(outside_policy(preset::Outside::automatic), optics::Outside::automatic);
  EXPECT_EQ(outside_policy(preset::Outside::hold), optics::Outside::hold);
  EXPECT_EQ(outside_policy(preset::Outside::extrapolate), optics::Outside::extrapolate);
  EXPECT_EQ(outside_policy(preset::Outside::refuse), optics::Outside::refuse);
}

class SceneFiles : public testing::Test {
protected:
  void SetUp() override { fs::create_directories(folder); }
  void TearDown() override { fs::remove_all(folder); }
  preset::Preset with_mesh(const std::string& obj) const
  {
    write_file_whole(folder / "mesh.obj", obj);
    preset::Preset preset = simple();
    preset.source = (folder / "p.json").string();
    preset.scene.objects[0].shape.reset();
    preset.scene.objects[0].mesh = "mesh.obj";
    return preset;
  }
  fs::path folder = fs::temp_directory_path() / fmt::format("nephroid_scene_test_{}", std::random_device{}());
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

struct Wrong {
  const char* says;
  std::function<void(preset::Scene&)> change;
};

TEST(Scene, RefusesAtTheRightPlace)
{
  using S = preset::Scene;
  const Wrong wrongs[] = {
      {"p.json#/scene/objects/0/material: there is no material 'glas'; one of glass, mirror, wall; did you mean 'glass'?",
       [](S& s) { s.objects[0].material = "glas"; }},
      {"p.json#/scene/objects/0/material: there is no material 'glass'; scene.materials is empty", [](S& s) { s.materials.clear(); }},
      {"p.json#/scene/objects/1/name: 'ball' is also object 0", [](S& s) { s.objects[1].name = "ball"; }},
      {"p.json#/scene/objects/0: has neither 'mesh' nor 'shape'", [](S& s) { s.objects[0].shape.reset(); }},
      {"p.json#/scene/objects/0: has both 'mesh' and 'shape'", [](S& s) { s.objects[0].mesh = "a.obj"; }},
      {"p.json#/scene/objects/0/mesh: 'no.obj' not found",
       [](S& s) {
         s.objects[0].shape.reset();
         s.objects[0].mesh = "no.obj";
       }},
      {"p.json#/scene/objects/0/shape/radius: 0 is out of range", [](S& s) { s.objects[0].shape->radius = 0; }},
      {"p.json#/scene/objects/0/transform/scale/1: the factor is 0", [](S& s) { s.objects[0].transform.scale[1] = 0; }},
      {"p.json#/scene/objects/0/transform/rotate_deg/2: is not", [](S& s) { s.objects[0].transform.rotate_deg[2] = std::nan(""); }},
      {"p.json#/scene/objects/0: is 1e-09 units across",
       [](S& s) {
         s.objects[0].transform.scale = {1e-9, 1e-9, 1e-9};
       }},
      {"p.json#/scene/objects/1: reaches 5e+10 units away",
       [](S& s) {
         s.objects[1].transform.scale = {1e11, 1, 1};
       }},
      {"p.json#/scene/objects/0: has a vertex at",
       [](S& s) {
         s.objects[0].transform.scale = {1e300, 1, 1};
       }},
      {"p.json#/scene/lights/0/position: (0, 1e+12, 0) is too far away", [](S& s) { s.lights[0].position[1] = 1e12; }},
      {"p.json#/scene/lights/0/power_w: the power is -1", [](S& s) { s.lights[0].power_w = -1; }},
      {"p.json#/scene/lights/0/spectrum: ", [](S& s) { s.lights[0].spectrum.illuminant = "D66"; }},
      {"p.json#/scene/lights/0/direction: (0, 0, 0) has no direction",
       [](S& s) {
         s.lights[0].type = preset::Light::Type::directional;
         s.lights[0].direction = {0, 0, 0};
       }},
      {"p.json#/scene/lights/0/half_angle_deg: the half angle is 0",
       [](S& s) {
         s.lights[0].type = preset::Light::Type::spot;
         s.lights[0].half_angle_deg = 0;
       }},
      {"p.json#/scene/lights/0/size/1: the edge length is 0",
       [](S& s) {
         s.lights[0].type = preset::Light::Type::area;
         s.lights[0].size[1] = 0;
       }},
      {"p.json#/scene/lights/0/up: (0, 1, 0) is parallel",
       [](S& s) {
         s.lights[0].type = preset::Light::Type::area;
         s.lights[0].up = {0, 1, 0};
       }},
      {"p.json#/scene/materials/wall/reflectance: the reflectance is 1.5", [](S& s) { s.materials["wall"].reflectance.value = 1.5; }},
      {"p.json#/scene/materials/a~1b~0c/dispersion: ",
       [](S& s) {
         s.materials["a/b~c"].type = preset::Material::Type::dielectric;
         s.materials["a/b~c"].dispersion.n = -1;
       }},
      {"p.json#/scene/camera/target: is where the camera stands", [](S& s) { s.camera.target = s.camera.position; }},
  };
  for (const Wrong& wrong : wrongs) {
    preset::Preset preset = simple();
    wrong.change(preset.scene);
    EXPECT_THAT(refusal(preset), testing::StartsWith(wrong.says));
  }
}

TEST(Scene, LoadsTheBunnyQuickly)
{
  if (!fs::exists("/usr/share/glmark2/models/bunny.obj")) GTEST_SKIP() << "glmark2-data is not installed";
  preset::Preset preset = simple();
  preset.scene.objects[0].shape.reset();
  preset.scene.objects[0].mesh = "/usr/share/glmark2/models/bunny.obj";
  const Scene scene = load_scene(preset);
  EXPECT_EQ(scene.objects[0].triangle_count, 69666u);
  EXPECT_TRUE(scene.objects[0].closed);
  EXPECT_THAT(scene.warnings, IsEmpty());
}

} // namespace
} // namespace nephroid::scene
