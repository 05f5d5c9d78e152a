// SPDX-License-Identifier: Apache-2.0
// Importing Mitsuba and PBRT scenes: one scene written in both, and what becomes of it against values worked out in
// comments; what is left out; files that are broken.
#include "formats/import/import.h"
#include "preset/read.h"
#include "scene/scene.h"
#include "tests/support/test.h"

#include <numbers>

namespace nephroid::scene_import_test {

using std::numbers::pi;

const std::string mitsuba = R"(<scene version="3.0.0">
<default name="size" value="4"/>
<sensor type="perspective"><string name="fov_axis" value="x"/><float name="fov" value="90"/>
<transform name="to_world"><lookat origin="1,3,6" target="1,3,0" up="0,1,0"/></transform>
<film type="hdrfilm"><integer name="width" value="200"/><integer name="height" value="100"/></film></sensor>
<bsdf type="twosided" id="grey"><bsdf type="diffuse"><rgb name="reflectance" value="0.25"/></bsdf></bsdf>
<shape type="rectangle"><transform name="to_world"><rotate x="1" angle="-90"/><scale value="$size"/></transform><ref id="grey"/></shape>
<shape type="sphere"><point name="center" x="2" y="1" z="0"/><bsdf type="dielectric"><float name="int_ior" value="1.5"/>
<string name="ext_ior" value="vacuum"/></bsdf></shape>
<emitter type="point"><point name="position" x="-2" y="3" z="1"/><rgb name="intensity" value="10"/></emitter>
</scene>)";

/// The same, left-handed: x is turned round. fov is that of the shorter edge: 2 atan(1/2) = 53.13010235 degrees.
const std::string pbrt = R"(Film "rgb" "integer xresolution" 200 "integer yresolution" 100
LookAt -1 3 6  -1 3 0  0 1 0
Camera "perspective" "float fov" [ 53.13010235 ]
WorldBegin
Material "diffuse" "rgb reflectance" [ 0.25 0.25 0.25 ]
Shape "trianglemesh" "point3 P" [ -4 0 4  4 0 4  4 0 -4  -4 0 -4 ] "integer indices" [ 0 1 2 0 2 3 ]
AttributeBegin
  Translate -2 1 0
  Material "dielectric" "float eta" 1.5
  Shape "sphere"
AttributeEnd
LightSource "point" "point3 from" [ 2 3 1 ] "rgb I" [ 10 10 10 ]
)";

class SceneImport : public testing::Test {
protected:
  preset::Preset imported(const std::string& text, const std::string& name) {
    made = formats::import_scene(folder.write(name, text), folder.path() / "out.json");
    return preset::read_preset(made.preset.string());
  }
  std::string refusal(const std::string& text, const std::string& name) {
    const std::string line = test::refusal_of([&] { imported(text, name); });
    EXPECT_FALSE(fs::exists(folder.path() / "out.json"));
    return line;
  }
  test::TemporaryFolder folder;
  formats::Imported made;
};

TEST_F(SceneImport, OneSceneInBothFormatsIsOnePreset) {
  for (const bool from_mitsuba : {true, false}) {
    SCOPED_TRACE(from_mitsuba);
    const preset::Preset p = from_mitsuba ? imported(mitsuba, "in.xml") : imported(pbrt, "in.pbrt");
    EXPECT_TRUE(made.notes.empty()) << made.summary();
    EXPECT_THAT(p.scene.camera.position, ElementsAre(DoubleNear(1, 1e-9), DoubleNear(3, 1e-9), DoubleNear(6, 1e-9)));
    EXPECT_NEAR(p.scene.camera.target[0], 1, 1e-9);
    EXPECT_NEAR(p.scene.camera.fov_deg, 53.13010235, 1e-6);
    EXPECT_EQ(p.scene.camera.resolution, (std::array{200, 100}));
    ASSERT_EQ(p.scene.objects.size(), 2u);
    EXPECT_EQ(p.scene.materials.at(p.scene.objects[0].material).reflectance.value, 0.25);
    EXPECT_NEAR(p.scene.materials.at(p.scene.objects[1].material).dispersion.n, 1.5, 1e-12);
    EXPECT_NEAR(p.scene.objects[1].transform.translate[0], 2, 1e-9);
    ASSERT_EQ(p.scene.lights.size(), 1u);
    EXPECT_NEAR(p.scene.lights[0].position[0], -2, 1e-9);
    // 10 of the luminance that is white, in every direction; D65 has about 683 / 200 watts to a luminous watt.
    EXPECT_NEAR(p.scene.lights[0].power_w / p.white.value(), 4 * pi * 10 * 683 / 200, 0.03 * 4 * pi * 10 * 683 / 200);
    fs::remove(folder.path() / "out.json");
  }
}

std::string with(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

// The window from 0 to 4 and -0.5 to 1.5 is as high as the one from -1 to 1, with its middle at (2, 0.5): half its
// width and a quarter of its height away.
TEST_F(SceneImport, LensesAndShiftsAreTaken) {
  const std::string lens = R"(<float name="aperture_radius" value="0.1"/><float name="focus_distance" value="5"/>)",
                    shift = R"(<float name="principal_point_offset_x" value="0.5"/>)"
                            R"(<float name="principal_point_offset_y" value="-0.25"/>)";
  for (const bool from_mitsuba : {true, false}) {
    SCOPED_TRACE(from_mitsuba);
    const preset::Camera camera =
        (from_mitsuba ? imported(with(mitsuba, R"("perspective">)", R"("thinlens">)" + lens + shift), "in.xml")
                      : imported(with(pbrt, "\"float fov\"",
                                      "\"float lensradius\" 0.1 \"float focaldistance\" 5 \"float screenwindow\" "
                                      "[ 0 4 -0.5 1.5 ] \"float fov\""),
                                 "in.pbrt"))
            .scene.camera;
    EXPECT_TRUE(made.notes.empty()) << made.summary();
    EXPECT_NEAR(camera.aperture, 0.2, 1e-12);
    EXPECT_NEAR(camera.focus_distance.value(), 5, 1e-12);
    EXPECT_NEAR(camera.shift[0], 0.5, 1e-12);
    EXPECT_NEAR(camera.shift[1], 0.25, 1e-12);
    EXPECT_NEAR(camera.fov_deg, 53.13010235, 1e-6);
    fs::remove(folder.path() / "out.json");
  }
}

// Mitsuba's picture is 2 wide, PBRT's 2 along its shorter edge, times the transform's scale.
TEST_F(SceneImport, OrthographicCamerasAreTaken) {
  const preset::Camera a = imported(with(with(mitsuba, R"("perspective">)", R"("orthographic">)"),
                                         R"("to_world"><lookat)", R"("to_world"><scale value="3"/><lookat)"),
                                    "in.xml")
                               .scene.camera;
  EXPECT_EQ(a.projection, preset::Camera::Projection::orthographic);
  EXPECT_NEAR(a.height.value(), 3, 1e-9);
  fs::remove(folder.path() / "out.json");
  const preset::Camera b =
      imported(with(with(pbrt, "perspective", "orthographic"), "\"float fov\" [ 53.13010235 ]", ""), "in.pbrt")
          .scene.camera;
  EXPECT_EQ(b.projection, preset::Camera::Projection::orthographic);
  EXPECT_NEAR(b.height.value(), 2, 1e-9);
}

TEST_F(SceneImport, SurfacesStayAndShine) {
  const preset::Preset p =
      imported(R"(<scene version="3.0.0"><shape type="sphere" id="bulb"><float name="radius" value="2"/>
      <emitter type="area"/></shape>
    <shape type="rectangle"><emitter type="area"/></shape>
    <shape type="cube"><boolean name="flipNormals" value="true"/><emitter type="area"/></shape></scene>)",
               "in.xml");
  ASSERT_EQ(p.scene.objects.size(), 5u) << "the backs of the rectangle and the cube are black";
  ASSERT_EQ(p.scene.lights.size(), 3u);
  const std::vector<preset::Light>& lights = p.scene.lights;
  for (const std::size_t i : {0, 1, 2}) {
    EXPECT_EQ(lights[i].type, preset::Light::Type::mesh);
    EXPECT_EQ(lights[i].object, p.scene.objects[i].name);
  }
  EXPECT_EQ(p.scene.materials.at(p.scene.objects[0].material).reflectance.value, 0.5); // as without a lamp
  EXPECT_NEAR(lights[0].power_w / lights[1].power_w, 4 * pi * 4 / 4, 1e-6);            // areas
  EXPECT_NEAR(lights[2].power_w / lights[1].power_w, 6, 1e-6);
  const scene::Scene scene = scene::load_scene(p); // the cube shines to its inside
  EXPECT_LT(scene::signed_volume(scene.geometry, scene.objects[2].first_triangle, 12), 0);
}

TEST_F(SceneImport, AFlatLampThatShinesOnBothSidesIsTwo) {
  const preset::Preset p = imported(R"(WorldBegin
    AreaLightSource "diffuse" "rgb L" [ 1 1 1 ] "bool twosided" true
    Shape "disk" "float radius" 2)",
                                    "in.pbrt");
  ASSERT_EQ(p.scene.lights.size(), 2u);
  const scene::Scene scene = scene::load_scene(p);
  std::vector<glm::vec3> normals;
  for (const scene::Object& disk : scene.objects) {
    const glm::uvec3 t = scene::triangles_of(scene, disk).front();
    const std::vector<glm::vec3>& at = scene.geometry.positions;
    normals.push_back(glm::normalize(glm::cross(at[t.y] - at[t.x], at[t.z] - at[t.x])));
    EXPECT_GT(normals.back().z * (disk.bounds.centre.z + (normals.size() == 1 ? 1e-6f : 0)), 0) << "apart";
  }
  EXPECT_NEAR(glm::dot(normals[0], normals[1]), -1, 1e-6);
  EXPECT_EQ(p.scene.lights[0].power_w, p.scene.lights[1].power_w);
}

TEST_F(SceneImport, WhatIsLeftOutIsSaidWithItsLine) {
  std::string text = mitsuba;
  text.replace(text.find("</scene>"), 8, "<shape type=\"hair\"/>\n</scene>");
  const preset::Preset p = imported(text, "in.xml");
  EXPECT_THAT(made.notes, ElementsAre(HasSubstr("in.xml:11: the shape hair is left out")));
  EXPECT_EQ(p.not_imported, made.notes) << "the preset keeps them";
  EXPECT_EQ(read_file(folder.path() / "out-not-imported.txt"), made.notes[0] + "\n") << "and a text beside it";
  imported(pbrt + "Shape \"curve\"\nLightSource \"projection\"\n", "in.pbrt");
  EXPECT_THAT(made.notes,
              ElementsAre(HasSubstr("in.pbrt:13: the shape curve"), HasSubstr("in.pbrt:14: the light projection")));
}

TEST_F(SceneImport, BrokenFilesAreRefusedAtTheirLine) {
  EXPECT_THAT(refusal("<scene>\n<shape type=\"sphere\">\n</scene>", "in.xml"),
              HasSubstr("in.xml:3: its XML is broken"));
  EXPECT_THAT(refusal("<scene>\n<shape type=\"$no\"/></scene>", "in.xml"), HasSubstr("in.xml:2: $no has no value"));
  EXPECT_THAT(refusal("WorldBegin\nAttributeEnd", "in.pbrt"),
              HasSubstr("in.pbrt:2: AttributeEnd has no AttributeBegin"));
  EXPECT_THAT(refusal("Translate 1\n2 x", "in.pbrt"), HasSubstr("in.pbrt:1: \"x\" of \"the transform\" is no number"));
  EXPECT_THAT(refusal("Shape \"sphere", "in.pbrt"), HasSubstr("in.pbrt:1: a string has no end"));
}

} // namespace nephroid::scene_import_test
