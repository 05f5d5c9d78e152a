// SPDX-License-Identifier: Apache-2.0
// `nephroid export`: irradiance under a pane of glass against its closed form, the glTF file read back by `nephroid
// import`, and what is refused.
#include "image/image.h"
#include "measure/lab.h"
#include "optics/colour.h"
#include "optics/spectrum.h"
#include "preset/read.h"
#include "scene/scene.h"
#include "tests/support/program_test.h"

#include <glm/glm.hpp>

#include <cmath>
#include <numbers>

namespace nephroid::export_test {

constexpr double index = 1.5, irradiance = 10;

/// Light from above through a pane that covers the middle half of a floor, each way, and stands between it and every
/// camera. A card lies in a quarter of its light.
const std::string pane = R"({"engine": "spectral", "unit": "m", "white": 2, "scene": {
  "camera": {"position": [3, 4, 5], "target": [0, 0, 0], "fov_deg": 30, "resolution": [64, 32]},
  "materials": {"glass": {"type": "dielectric", "dispersion": {"type": "cauchy", "coefficients": [1.5, 0]}},
                "grey": {"type": "diffuse", "reflectance": 0.3}},
  "objects": [
    {"name": "floor", "shape": {"type": "quad", "size": [4, 1, 2]}, "material": "grey", "transform": {"rotate_deg": [0, 30, 0]}},
    {"name": "card", "shape": {"type": "quad", "size": [0.5, 1, 3]}, "material": "grey",
     "transform": {"rotate_deg": [0, 30, 0], "translate": [-0.5, 0.1, 0]}},
    {"name": "pane", "shape": {"type": "plate", "size": [2, 0.1, 1]}, "material": "glass",
     "transform": {"rotate_deg": [0, 30, 0], "translate": [0, 1, 0]}}],
  "lights": [{"type": "directional", "irradiance_w_m2": 10, "direction": [0, -1, 0]},
             {"type": "spot", "power_w": 3, "position": [0, -3, 0], "direction": [0, -1, 0], "half_angle_deg": 20, "spectrum": "A"}]}})";

class Export : public ProgramTest {
protected:
  /// Luminous W/m^2 at a place of the floor, along its edges of 4 m and 2 m from its middle.
  double floor_at(double along, double across) const {
    const nlohmann::json about = of("x/caustics.json")["caustics"][0];
    const auto vector = [&](const char* name) { return glm::dvec3(about[name][0], about[name][1], about[name][2]); };
    const double turn = 30 * std::numbers::pi / 180;
    const glm::dvec3 place(along * std::cos(turn) + across * std::sin(turn), 0,
                           across * std::cos(turn) - along * std::sin(turn));
    const glm::dvec3 way = place - vector("corner_m"), right = vector("across_m"), down = vector("down_m");
    const image::Image map = image::read_image(folder / "x" / about["file"].get<std::string>());
    const int column = static_cast<int>(glm::dot(way, right) / glm::dot(right, right) * map.width),
              row = static_cast<int>(glm::dot(way, down) / glm::dot(down, down) * map.height);
    double sum = 0; // of 5 x 5 pixels: neighbours share their noise
    for (int y = row - 2; y <= row + 2; ++y)
      for (int x = column - 2; x <= column + 2; ++x)
        sum += measure::luminance(&map.data[static_cast<std::size_t>(3 * (y * map.width + x))]);
    return sum / 25;
  }
};

TEST_F(Export, IrradianceUnderAPaneIsItsClosedForm) {
  write("pane.json", pane);
  const Ended ended = run({"export", "pane.json", "-o", "x", "--size", "64", "--seconds", "8"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  // Two cores came within 1 % in a quarter of this time.
  // All reflections between both sides of the pane together: (1 - R) / (1 + R) = 2 n / (n^2 + 1).
  const double luminous = irradiance * optics::to_xyz(optics::illuminant("D65"))[1],
               through = luminous * 2 * index / (index * index + 1);
  EXPECT_NEAR(floor_at(0.5, 0), through, 0.02 * through);
  EXPECT_EQ(floor_at(-0.5, 0), 0) << "the card is in the way of light, and its own light is not the floor's";
  EXPECT_EQ(floor_at(1.5, 0.5), 0) << "no light through glass";
  const nlohmann::json about = of("x/caustics.json");
  EXPECT_EQ(about["white"], 2);
  ASSERT_EQ(about["caustics"].size(), 2u) << "floor and card";
  EXPECT_NEAR(about["caustics"][0]["luminous_w"].get<double>(), through * 1.5,
              0.02 * through); // a half, and a half of that: 2 x 1 - 0.5 x 1
  EXPECT_NEAR(about["caustics"][1]["luminous_w"].get<double>(), through * 0.5, 0.02 * through);
}

TEST_F(Export, UnitsAndExposureChangeNoLight) {
  write("pane.json", pane);
  ASSERT_EQ(run({"export", "pane.json", "-o", "x", "--size", "64", "--seconds", "4"}).exit_code, 0);
  const nlohmann::json metres = of("x/caustics.json")["caustics"][0];
  const double watts = metres["luminous_w"], there = floor_at(0.5, 0);
  const std::string film =
      R"(animation={"frames": 2, "tracks": [{"path": "white", "keys": [{"frame": 0, "value": 5}]}]})";
  const Ended ended = run({"export", "pane.json", "-o", "x", "--size", "64", "--seconds", "4", "--set", film});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(of("x/caustics.json")["white"], 5);
  EXPECT_NEAR(floor_at(0.5, 0), there, 0.02 * there);
  ASSERT_EQ(run({"export", "pane.json", "-o", "x", "--size", "64", "--seconds", "4", "--set", "unit=cm"}).exit_code, 0);
  const nlohmann::json centimetres = of("x/caustics.json")["caustics"][0];
  EXPECT_NEAR(centimetres["luminous_w"].get<double>(), 1e-4 * watts, 0.02e-4 * watts) << "of the same irradiance";
  for (std::size_t axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(centimetres["across_m"][axis].get<double>(), 0.01 * metres["across_m"][axis].get<double>(), 1e-9);
}

TEST_F(Export, WhatIsImportedAgainIsTheSame) {
  write("pane.json", pane);
  ASSERT_EQ(run({"export", "pane.json", "-o", "x", "--size", "8", "--seconds", "0.1"}).exit_code, 0);
  const Ended imported = run({"import", "x/scene.glb", "-o", "back.json"});
  ASSERT_EQ(imported.exit_code, 0) << imported.err;
  const preset::Preset before = preset::read_preset((folder / "pane.json").string()),
                       after = preset::read_preset((folder / "back.json").string());
  ASSERT_EQ(after.scene.objects.size(), before.scene.objects.size());
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(after.scene.objects[i].name, before.scene.objects[i].name);
  EXPECT_NEAR(after.scene.materials.at(after.scene.objects[2].material).dispersion.n, index, 1e-6);
  EXPECT_NEAR(after.scene.materials.at(after.scene.objects[1].material).reflectance.value, 0.3, 1e-4);
  EXPECT_NEAR(after.scene.camera.fov_deg, 30, 1e-4);
  EXPECT_EQ(after.scene.camera.resolution, (std::array{1024, 512})) << "glTF has the shape alone";
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(after.scene.camera.position[axis], before.scene.camera.position[axis], 1e-5);
    EXPECT_NEAR(after.scene.lights[1].position[axis], before.scene.lights[1].position[axis], 1e-5);
    EXPECT_NEAR(after.scene.lights[1].direction[axis], before.scene.lights[1].direction[axis], 1e-5);
  }
  EXPECT_NEAR(after.scene.lights[0].irradiance_w_m2, irradiance, 1e-3);
  EXPECT_NEAR(after.scene.lights[1].half_angle_deg, 20, 1e-3);
  // Another spectrum of the same colour: what an eye sees of it stays.
  const double luminous = 3 * optics::to_xyz(optics::illuminant("A"))[1];
  const nlohmann::json back = nlohmann::json::parse(preset::to_json(after));
  std::vector<std::array<double, 2>> table;
  for (const auto& row : back["scene"]["lights"][1]["spectrum"]["table"]) table.push_back({row[0], row[1]});
  EXPECT_NEAR(after.scene.lights[1].power_w * optics::to_xyz(optics::light_table(table))[1], luminous, 0.01 * luminous);
}

TEST_F(Export, ObjectsOfOneMeshFileAreInstances) {
  write("wedge.obj", "v 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
  const std::string object = R"({"mesh": "wedge.obj", "material": "glass", "name": ")";
  const std::string scene =
      R"({"engine": "spectral", "unit": "cm", "white": 2, "scene": {"camera": {"position": [3, 4, 25], "target": [0, 0, 0]},
  "materials": {"glass": {"type": "dielectric", "dispersion": 1.5}, "grey": {"type": "diffuse"}}, "objects": [)" +
      object + R"(first", "transform": {"rotate_deg": [10, 20, 30], "scale": [1, 2, 3]}},)" + object +
      R"(mirrored", "transform": {"rotate_deg": [0, 90, 0], "scale": [-2, 1, 1], "translate": [0, 3, 40]}},
  {"name": "floor", "shape": {"type": "quad", "size": [40, 1, 40]}, "material": "grey", "transform": {"translate": [0, -30, 0]}}],
  "lights": [{"type": "directional", "irradiance_w_m2": 10, "direction": [0, -1, 0]}]}})";
  write("wedges.json", scene);
  const Ended ended = run({"export", "wedges.json", "-o", "w", "--size", "8", "--seconds", "0.1"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  ASSERT_EQ(run({"import", "w/scene.glb", "-o", "back.json"}).exit_code, 0);
  const preset::Preset before = preset::read_preset((folder / "wedges.json").string()),
                       after = preset::read_preset((folder / "back.json").string());
  ASSERT_EQ(after.scene.objects.size(), 3u);
  EXPECT_EQ(after.scene.objects[0].mesh, after.scene.objects[1].mesh);
  const scene::Scene was = scene::load_scene(before), is = scene::load_scene(after);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(after.scene.objects[i].name, before.scene.objects[i].name);
    const scene::Bounds a = scene::bounds_of(was, was.objects[i]), b = scene::bounds_of(is, is.objects[i]);
    for (int axis = 0; axis < 3; ++axis) { // centimetres there, metres here
      EXPECT_NEAR(b.low[axis] + is.origin[axis], 0.01 * (a.low[axis] + was.origin[axis]), 1e-6) << i;
      EXPECT_NEAR(b.high[axis] + is.origin[axis], 0.01 * (a.high[axis] + was.origin[axis]), 1e-6) << i;
    }
  }
  EXPECT_THAT(is.warnings, Not(Contains(HasSubstr("inside out"))));
}

TEST_F(Export, SaysWhatIsWrongInOneLineAndWritesNothing) {
  write("pane.json", pane);
  fs::create_directory(folder / "taken");
  write("taken/letter.txt", "mine");
  for (const Wrong& wrong : std::vector<Wrong>{
           {{"export", "pane.json", "-o", "x", "--receiver", "wall"},
            "no flat matt object is called 'wall'; one of: floor, card"},
           {{"export", "pane.json", "-o", "taken"}, "holds files that are not of an export"},
           {{"export", "pane.json", "-o", "x", "--size", "0"}, "--size"},
           {{"export", "pane.json", "-o", "x", "--set", "scene.lights=[]"}, "has no caustic: the scene has no light"},
           {{"export", "inverse/shapes", "-o", "x"}, "run it first, then export view.json of its folder"},
           {{"export", "nothing.json", "-o", "x"}, "nothing.json"}}) {
    expect_refused(run(wrong.arguments), wrong);
    EXPECT_FALSE(fs::exists(folder / "x"));
  }
  EXPECT_EQ(bytes("taken/letter.txt"), "mine");
}

TEST_F(Export, AnOlderExportIsReplacedAndWhatIsBesideItStays) {
  write("pane.json", pane);
  ASSERT_EQ(run({"export", "pane.json", "-o", "x", "--size", "8", "--seconds", "0.1"}).exit_code, 0);
  write("x/mine.blend", "mine");
  ASSERT_EQ(run({"export", "pane.json", "-o", "x", "--size", "8", "--seconds", "0.1", "--receiver", "card"}).exit_code,
            0);
  EXPECT_FALSE(fs::exists(folder / "x/caustic-0-floor.exr"));
  EXPECT_TRUE(fs::exists(folder / "x/caustic-1-card.exr"));
  EXPECT_EQ(bytes("x/mine.blend"), "mine");
}

} // namespace nephroid::export_test
