// SPDX-License-Identifier: Apache-2.0
// Objects and lamps that are misplaced are told.
#include "scene/placement.h"
#include "tests/support/loaded_scenes.h"

namespace nephroid::scene::placement_test {

using test::shape_object;
using Type = preset::Shape::Type;

preset::Preset table_and_ball() {
  preset::Preset preset{.source = "p.json"};
  preset.scene.materials["wood"];
  preset.scene.materials["glass"].type = preset::Material::Type::dielectric;
  preset.scene.objects = {shape_object("table", Type::quad, "wood", {.scale = {4, 1, 4}}),
                          shape_object("ball", Type::sphere, "glass", {.translate = {0, 2, 0}}),
                          shape_object("block", Type::box, "wood", {.translate = {9, 2, 0}})};
  preset.scene.camera.position = {0, 5, 9};
  preset.scene.lights = {{.position = {3, 3, 0}}};
  return preset;
}

std::vector<std::string> warnings(const preset::Preset& preset) { return load_scene(preset).warnings; }

TEST(Placement, CopiesAreTold) {
  preset::Preset preset = table_and_ball();
  EXPECT_THAT(warnings(preset), IsEmpty());
  for (std::size_t i : {0, 1}) {
    preset::Preset twice = preset;
    twice.scene.objects.push_back(preset.scene.objects[i]);
    twice.scene.objects.back().name = "again";
    EXPECT_THAT(warnings(twice), ElementsAre(HasSubstr("object 'again' is a copy of object '" +
                                                       preset.scene.objects[i].name + "' in the same place")));
    preset::Preset thrice = twice;
    thrice.scene.objects.push_back(thrice.scene.objects.back());
    thrice.scene.objects.back().name = "and again";
    EXPECT_THAT(warnings(thrice), ElementsAre(HasSubstr("'again' is a copy"), HasSubstr("'and again' is a copy")));
    twice.scene.objects.back().transform.translate[1] += 5;
    EXPECT_THAT(warnings(twice), IsEmpty());
  }
}

TEST(Placement, LampsThatCannotShineAreTold) {
  const auto of_lamp = [](const preset::Vec3& position, const preset::Vec3& camera = {0, 5, 9}) {
    preset::Preset preset = table_and_ball();
    preset.scene.lights[0].position = position;
    preset.scene.camera.position = camera;
    return hidden_lamps(load_scene(preset));
  };
  EXPECT_THAT(of_lamp({1, 0, 1}), ElementsAre(HasSubstr("scene.lights.0 lies in the surface of object 'table'")));
  EXPECT_THAT(of_lamp({1, 0.01, 1}), IsEmpty());
  EXPECT_THAT(of_lamp({9, 2.1, 0}),
              ElementsAre(HasSubstr("scene.lights.0 is inside of object 'block', which lets no")));
  EXPECT_THAT(of_lamp({9, 2.1, 0}, {9, 1.9, 0.1}), IsEmpty()) << "the camera is in it, too";
  EXPECT_THAT(of_lamp({0, 2, 0}), IsEmpty()) << "glass lets it out";
}

TEST(Placement, PlanesThatAreCoveredAreTold) {
  const auto of_plane = [](double height, const preset::Vec3& normal) {
    const preset::Preset preset = table_and_ball();
    const Scene scene = load_scene(preset);
    preset::Meter meter;
    meter.type = preset::Meter::Type::plane;
    meter.name = "sheet";
    meter.position = {-1, height, 0};
    meter.normal = normal;
    meter.size = {0.2, 0.2};
    meter.cell = 0.05;
    return covered(make_meter(meter, scene, Location("test")), scene, build_bvh(scene.geometry));
  };
  EXPECT_EQ(of_plane(0.001, {0, 1, 0}), std::nullopt);
  EXPECT_THAT(of_plane(-0.001, {0, 1, 0}), Optional(HasSubstr("'sheet' looks at object 'table' from close by")));
  EXPECT_THAT(of_plane(0.001, {0, -1, 0}), Optional(HasSubstr("'sheet' looks at object 'table' from close by")));
  EXPECT_EQ(of_plane(0.1, {0, -1, 0}), std::nullopt) << "two cells away light comes from the sides";
}

} // namespace nephroid::scene::placement_test
