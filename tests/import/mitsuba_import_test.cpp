// SPDX-License-Identifier: Apache-2.0
// What Mitsuba's scenes mean: names of files and of objects, what is inside of what, flags, media, spectra, meshes of
// its own. Expected values are worked out in comments.
#include "image/image.h"
#include "scatter/spectra.h"
#include "scene/mesh.h"
#include "scene/scene.h"
#include "tests/import/imports_scenes.h"

#include <zlib.h>

namespace nephroid::mitsuba_import_test {

using Type = preset::Material::Type;

/// A tetrahedron, facing outwards.
const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";

class MitsubaImport : public test::ImportsScenes {
protected:
  preset::Preset imported(const std::string& inner, const std::string& name = "in.xml") {
    return ImportsScenes::imported("<scene version=\"3.0.0\">\n" + inner + "</scene>", name);
  }
  std::string refusal(const std::string& inner) {
    return test::refusal_of([&] { imported(inner); });
  }
  std::vector<double> indices(const std::string& inner) { return ImportsScenes::indices(imported(inner)); }
};

std::string ball(double radius, const std::string& inside, const std::string& outside, const std::string& more = {}) {
  return fmt::format(R"(<shape type="sphere"><float name="radius" value="{}"/>{}<bsdf type="dielectric">
    <string name="int_ior" value="{}"/><string name="ext_ior" value="{}"/></bsdf></shape>)",
                     radius, more, inside, outside);
}

TEST_F(MitsubaImport, EveryValueThatIsLeftOutIsSaid) {
  imported("<shape type='sphere'>\n<float name='glitter' value='1'/>\n"
           "<bsdf type='diffuse'><rgb name='reflectance' value='.1'/>\n<float name='sheen' value='1'/></bsdf></shape>\n"
           "<emitter type='point'><float name='sampling_weight' value='2'/>\n<float name='fade' value='1'/></emitter>\n"
           "<shape type='cube'><emitter type='area'><rgb name='radiance' value='1'/>\n"
           "<boolean name='hidden' value='true'/></emitter>\n<bsdf type='conductor'>"
           "<string name='material' value='Au'/><float name='specular_reflectance' value='1'/>"
           "<float name='ext_eta' value='1'/></bsdf></shape>\n"
           "<shape type='cube'><bsdf type='conductor'>\n"
           "<string name='material' value='Au'/><float name='ext_eta' value='1.33'/></bsdf></shape>");
  EXPECT_THAT(made.notes, IsSupersetOf({HasSubstr("in.xml:9: its \"hidden\" is left out"),
                                        HasSubstr("in.xml:11: its ext_eta is left out: around it is air"),
                                        HasSubstr("in.xml:3: its \"glitter\" is left out"),
                                        HasSubstr("in.xml:5: its \"sheen\" is left out"),
                                        HasSubstr("in.xml:7: its \"fade\" is left out")}));
  EXPECT_THAT(made.notes, Each(Not(AnyOf(HasSubstr("reflectance"), HasSubstr("sampling_weight")))));
  EXPECT_THAT(made.notes, Contains(HasSubstr("ext_eta")).Times(1));
}

TEST_F(MitsubaImport, ADoubledFileIsRefused) {
  EXPECT_THAT(refusal("</scene>\n<scene>"), HasSubstr("in.xml:3: a second <scene> begins behind the scene's end"));
}

TEST_F(MitsubaImport, NamesOfAnIncludedFileAreLookedUpFromTheScene) {
  folder.write("meshes/t.obj", tetrahedron);
  folder.write("parts/glass.xml", R"(<scene version="3.0.0"><include filename="parts/one.xml"/>
    <shape type="obj"><string name="filename" value="meshes/t.obj"/><ref id="later"/></shape></scene>)");
  folder.write("parts/one.xml", R"(<bsdf type="dielectric" id="later"/>)"); // a file may be one object
  const preset::Preset p = imported(R"(<include filename="parts/glass.xml"/>)");
  ASSERT_EQ(p.scene.objects.size(), 1u);
  EXPECT_EQ(material_of(p, 0).type, Type::dielectric);
}

TEST_F(MitsubaImport, FoldersOfPathAreSearched) {
  folder.write("common/t.obj", tetrahedron);
  const preset::Preset p = imported(
      R"(<path value="../common"/><shape type="obj"><string name="filename" value="t.obj"/></shape>)", "scenes/in.xml");
  EXPECT_EQ(p.scene.objects.size(), 1u);
  EXPECT_THAT(refusal(R"(<path value="nowhere"/>)"), HasSubstr("in.xml:2: the folder"));
}

TEST_F(MitsubaImport, IdsAreResolvedAfterReading) {
  const preset::Preset p = imported(R"(<shape type="rectangle"><ref id="shine"/></shape>
    <shape type="sphere"><ref id="wrapped"/><ref name="interior" id="dye"/></shape>
    <shape type="disk"><bsdf type="diffuse"><ref name="reflectance" id="rouge"/></bsdf></shape>
    <alias id="red" as="rouge"/><texture type="uniform" id="red"><float name="value" value="0.25"/></texture>
    <emitter type="area" id="shine"><rgb name="radiance" value="10"/></emitter>
    <bsdf type="twosided" id="wrapped"><ref id="glass"/></bsdf><bsdf type="dielectric" id="glass"/>
    <medium type="homogeneous" id="dye"><float name="sigma_t" value="2"/><float name="albedo" value="0"/></medium>)");
  EXPECT_THAT(made.notes, ElementsAre(HasSubstr("no camera")));
  ASSERT_EQ(p.scene.lights.size(), 1u);
  ASSERT_EQ(p.scene.objects.size(), 5u); // with two backs
  EXPECT_EQ(p.scene.lights[0].object, p.scene.objects[0].name);
  EXPECT_EQ(material_of(p, 1).dispersion.type, preset::Dispersion::Type::file); // for its k
  EXPECT_EQ(material_of(p, 2).reflectance.value, 0.25);
}

TEST_F(MitsubaImport, WhatRefersToItselfIsRefused) {
  EXPECT_THAT(refusal(R"(<include filename="in.xml"/>)"), AllOf(HasSubstr("in.xml:2: "), HasSubstr("includes itself")));
  EXPECT_THAT(refusal(R"(<shape type="sphere"><ref id="a"/></shape><bsdf type="twosided" id="a"><ref id="a"/></bsdf>)"),
              HasSubstr("\"a\" refers to itself"));
  EXPECT_THAT(refusal(R"(<shape type="sphere"><ref id="a"/></shape>
    <bsdf type="twosided" id="a"><ref id="b"/></bsdf><bsdf type="twosided" id="b"><ref id="a"/></bsdf>)"),
              HasSubstr("materials go round in a circle"));
  EXPECT_THAT(refusal(R"(<shape type="shapegroup" id="g"><shape type="instance"><ref id="h"/></shape></shape>
    <shape type="shapegroup" id="h"><shape type="instance"><ref id="g"/></shape></shape>
    <shape type="instance"><ref id="g"/></shape>)"),
              HasSubstr("instances go round in a circle"));
  EXPECT_THAT(refusal(R"(<shape type="sphere"><ref id="nobody"/></shape>)"),
              HasSubstr("in.xml:2: nothing has the id \"nobody\""));
  EXPECT_THAT(refusal(R"(<bsdf type="diffuse" id="a"/><bsdf type="null" id="a"/>)"), HasSubstr("given twice"));
}

TEST_F(MitsubaImport, InstancesOfInstancesStandWhereTheyAreMeant) {
  const preset::Preset p =
      imported(R"(<shape type="shapegroup" id="one"><shape type="sphere"><ref id="glass"/></shape></shape>
    <shape type="shapegroup" id="two"><shape type="instance"><ref id="one"/><transform name="to_world">
      <translate x="1"/></transform></shape></shape>
    <shape type="instance"><ref id="two"/><transform name="to_world"><scale value="2"/></transform></shape>
    <shape type="instance"><ref id="two"/><transform name="to_world"><translate y="5"/></transform></shape>
    <bsdf type="dielectric" id="glass"/>)");
  ASSERT_EQ(p.scene.objects.size(), 2u);
  EXPECT_EQ(p.scene.objects[0].transform.translate, (preset::Vec3{2, 0, 0}));
  EXPECT_EQ(p.scene.objects[1].transform.translate, (preset::Vec3{1, 5, 0}));
}

TEST_F(MitsubaImport, TheInsideOfASurfaceHasItsOwnIndex) {
  EXPECT_THAT(indices(ball(1, "1.5", "vacuum") + ball(0.6, "1", "1.5")), ElementsAre(1.5, 1)); // a bubble
  // The same bubble by its surface turned round: what is in the bsdf is around it.
  EXPECT_THAT(indices(ball(1, "1.5", "1") + ball(0.6, "1.5", "1", R"(<boolean name="flip_normals" value="true"/>)")),
              ElementsAre(1.5, 1));
  // A liquid says that it is in glass. It wins where it reaches into it.
  EXPECT_THAT(indices(ball(1, "1.5", "1") + ball(0.6, "1.33", "1.5")), ElementsAre(1.5, 1.33));
  const preset::Preset p = preset::read_preset(made.preset.string());
  EXPECT_GT(p.scene.objects[1].priority, p.scene.objects[0].priority);
  EXPECT_TRUE(made.notes.size() == 2) << made.summary(); // no camera, no lights
}

TEST_F(MitsubaImport, ALoneObjectInAMediumIsARatioAndANote) {
  EXPECT_THAT(indices(ball(1, "1.5", "1.25")), ElementsAre(DoubleNear(1.2, 1e-12)));
  EXPECT_THAT(made.notes, Contains(HasSubstr("in the file it is in n = 1.25, which is nowhere")));
}

/// Those of a cube of edge 1 from (x, y, 0), and its sides: -y, +y, -x, +x, -z, +z.
std::string corners(double x, double y) {
  std::string text;
  for (int i = 0; i < 8; ++i) text += fmt::format("v {} {} {}\n", x + (i & 1), y + (i >> 1 & 1), i >> 2);
  return text;
}
const std::string sides = "f 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\nf 1 3 4 2\nf 5 6 8 7\n";

// Such a mesh is read about its own middle. That must not put it into what is elsewhere.
TEST_F(MitsubaImport, MeshesFarFromTheOriginLieWhereTheyAre) {
  folder.write("glass.obj", corners(100, 0) + sides);
  folder.write("other.obj", corners(200, 0) + sides);
  const auto cube = [](const char* file, const char* inside, const char* outside, double scale) {
    return fmt::format(R"(<shape type="obj"><string name="filename" value="{}.obj"/><transform name="to_world">
      <translate x="-100.5" y="-0.5" z="-0.5"/><scale value="{}"/></transform><bsdf type="dielectric">
      <float name="int_ior" value="{}"/><float name="ext_ior" value="{}"/></bsdf></shape>)",
                       file, scale, inside, outside);
  };
  EXPECT_THAT(indices(cube("glass", "1.5", "1", 1) + cube("other", "1.33", "1.25", 0.5)),
              ElementsAre(1.5, DoubleNear(1.33 / 1.25, 1e-12)));
  EXPECT_THAT(made.notes, Contains(HasSubstr("in the file it is in n = 1.25, which is nowhere")));
  EXPECT_THAT(indices(cube("glass", "1.5", "1", 1) + cube("glass", "1.33", "1.5", 0.5)), ElementsAre(1.5, 1.33));
}

/// Water on a block of glass, each 1 x 1 x 1: the glass' sides in air, the water's in air, and what parts them.
TEST_F(MitsubaImport, SurfacesBetweenMediaBecomeBodies) {
  const std::string bottom = sides.substr(0, 10), top = sides.substr(10, 10), around = sides.substr(20);
  const auto surface = [](const char* file, const char* inside, const char* outside) {
    return fmt::format(R"(<shape type="obj"><string name="filename" value="{}.obj"/>
      <boolean name="face_normals" value="true"/><bsdf type="dielectric">
      <float name="int_ior" value="{}"/><float name="ext_ior" value="{}"/></bsdf></shape>)",
                       file, inside, outside);
  };
  const std::string between = surface("between", "1.33", "1.5");
  std::string turned = surface("between", "1.5", "1.33");
  turned.insert(turned.find("<bsdf"), R"(<boolean name="flip_normals" value="true"/>)");
  for (const auto& [parting, x] : {std::pair(between, 0), {turned, 0}, {between, 500000}}) {
    folder.write("glass.obj", corners(x, -1) + bottom + around);
    folder.write("water.obj", corners(x, 0) + top + around);
    folder.write("between.obj", corners(x, 0) + bottom); // its normal looks down, from the water to the glass
    const preset::Preset p = imported(surface("glass", "1.5", "1") + surface("water", "1.33", "1") + parting);
    ASSERT_EQ(p.scene.objects.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
      const scene::MeshReport report = scene::inspect(scene::load_mesh(folder.path() / *p.scene.objects[i].mesh));
      EXPECT_TRUE(report.closed());
      EXPECT_NEAR(report.signed_volume, 1, 2e-3); // the water reaches a little into the glass
      EXPECT_NEAR(p.scene.objects[i].transform.translate[0], x, 1);
    }
    EXPECT_EQ(material_of(p, 0).dispersion.n, 1.33);
    EXPECT_EQ(material_of(p, 1).dispersion.n, 1.5);
    EXPECT_GT(p.scene.objects[1].priority, p.scene.objects[0].priority);
    EXPECT_THAT(made.notes, Not(Contains(HasSubstr("hole"))));
  }
}

TEST_F(MitsubaImport, ALiquidThatTouchesItsGlassReachesIntoIt) {
  const auto block = [](double y, const char* inside, const char* outside) {
    return fmt::format(R"(<shape type="cube"><transform name="to_world"><translate y="{}"/></transform>
      <bsdf type="dielectric"><float name="int_ior" value="{}"/><float name="ext_ior" value="{}"/></bsdf></shape>)",
                       y, inside, outside);
  };
  const preset::Preset p = imported(block(-1, "1.5", "1") + block(1, "1.33", "1.5"));
  EXPECT_EQ(material_of(p, 1).dispersion.n, 1.33);
  const auto volume = [&](std::size_t i) {
    return scene::inspect(scene::load_mesh(folder.path() / *p.scene.objects.at(i).mesh)).signed_volume;
  };
  EXPECT_NEAR(volume(0), 8, 1e-5);
  // Every corner of 2 x 2 x 2 goes out by 2e-4 of the diagonal, 2 sqrt(3), along (1, 1, 1) / sqrt(3).
  EXPECT_NEAR(volume(1), std::pow(2 + 2 * 4e-4, 3), 1e-4);
  EXPECT_GT(p.scene.objects[1].priority, p.scene.objects[0].priority);
}

TEST_F(MitsubaImport, WrongIndicesAreRefused) {
  EXPECT_THAT(refusal(ball(1, "kryptonite", "air")), HasSubstr("no index of refraction is called \"kryptonite\""));
  EXPECT_THAT(refusal(ball(1, "-1", "air")), HasSubstr("an index of refraction is above 0"));
}

TEST_F(MitsubaImport, MeshesWithoutNormalsAreSmoothUnlessFacesAreAskedFor) {
  folder.write("t.obj", tetrahedron);
  const std::string mesh = R"(<shape type="obj"><string name="filename" value="t.obj"/>)";
  const preset::Preset p =
      imported(mesh + "</shape>" + mesh + R"(<boolean name="face_normals" value="true"/></shape><shape type="cube"/>)");
  EXPECT_EQ(p.scene.objects[0].normals, preset::Object::Normals::smooth);
  EXPECT_EQ(p.scene.objects[1].normals, preset::Object::Normals::faceted);
  EXPECT_EQ(p.scene.objects[2].normals, preset::Object::Normals::faceted);
}

TEST_F(MitsubaImport, ANullSurfaceIsNone) {
  const preset::Preset p = imported(R"(<shape type="cube"><bsdf type="null"/></shape><shape type="sphere"/>)");
  EXPECT_EQ(p.scene.objects.size(), 1u);
}

TEST_F(MitsubaImport, AThinPaneIsThinGlass) {
  const preset::Preset p = imported(R"(<shape type="rectangle"><bsdf type="thindielectric"/></shape>
    <shape type="sphere"><bsdf type="thindielectric"/><boolean name="flip_normals" value="true"/></shape>)");
  ASSERT_EQ(p.scene.objects.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(material_of(p, i).thin);
    EXPECT_NEAR(
        scatter::make_curve(material_of(p, i).dispersion, FileFinder(folder.path()), "n").sample(589.3).n.value(),
        1.5046 / 1.000277, 1e-5);
  }
  EXPECT_THAT(made.notes, Each(Not(HasSubstr("infinitely"))));
}

TEST_F(MitsubaImport, AMediumInGlassAbsorbs) {
  const preset::Preset p =
      imported(R"(<shape type="cube"><bsdf type="dielectric"/><medium type="homogeneous" name="interior">
    <float name="sigma_t" value="3"/><float name="albedo" value="0.5"/><float name="scale" value="2"/></medium></shape>
    <shape type="cube"><bsdf type="dielectric"/></shape>)");
  const std::string file = read_file(folder.path() / material_of(p, 0).dispersion.file);
  // Of 6 a metre half is absorbed: k = 3 l / (4 pi), at 500 nm 1.19366e-07.
  EXPECT_THAT(file, HasSubstr("0.50 1.19366e-07"));
  EXPECT_THAT(made.notes, Contains(HasSubstr("the medium scatters in the file, and only absorbs here")));
  EXPECT_EQ(material_of(p, 1).dispersion.type, preset::Dispersion::Type::constant);
}

TEST_F(MitsubaImport, GlassMayHaveATint) {
  const preset::Preset p = imported(R"(<shape type="cube"><bsdf type="dielectric">
    <float name="specular_transmittance" value="0.7"/><float name="specular_reflectance" value="0.5"/></bsdf></shape>
    <shape type="cube"><bsdf type="principled"><rgb name="base_color" value="0.36 0.36 0.36"/>
    <float name="spec_trans" value="1"/><float name="roughness" value="0"/></bsdf></shape>)");
  EXPECT_NEAR(material_of(p, 0).tint.value, 0.7, 1e-12);
  EXPECT_NEAR(material_of(p, 1).tint.value, 0.6, 1e-12) << "each surface takes the root";
  EXPECT_THAT(made.notes, Contains(HasSubstr("in.xml:2: its specular_reflectance is left out")));
}

// Mitsuba counts v from a picture's top, and turns that of OBJ files round. Its map is v' = 3 v + .25 there, so from
// the bottom 1 - v' = 3 (1 - v) - 2.25.
TEST_F(MitsubaImport, MattSurfacesHaveTextures) {
  image::write_png(folder.path() / "p.png", 1, 1, {0.5f, 0.25f, 1});
  folder.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 .25\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
  const std::string bsdf = R"(<bsdf type="diffuse" id="card"><texture type="bitmap" name="reflectance">
    <string name="filename" value="p.png"/><string name="wrap_mode" value="mirror"/><transform name="to_uv">
    <scale x="2" y="3"/><translate x=".5" y=".25"/></transform></texture></bsdf>)";
  const std::string file = R"(<string name="filename" value="t.obj"/>)", card = R"(<ref id="card"/>)";
  const preset::Preset p = imported(bsdf + "<shape type='rectangle'>" + card + "</shape><shape type='obj'>" + file +
                                    card + "</shape><shape type='sphere'>" + card + "</shape>" +
                                    R"(<shape type="rectangle"><bsdf type="plastic"><texture type="checkerboard"
    name="diffuse_reflectance"><rgb name="color0" value=".5 .25 1"/></texture></bsdf></shape>)");
  ASSERT_TRUE(material_of(p, 0).texture);
  const preset::Texture& texture = *material_of(p, 0).texture;
  EXPECT_EQ(texture.wrap, preset::Texture::Wrap::mirror);
  EXPECT_EQ(texture.file, fs::absolute(folder.path() / "p.png").string());
  EXPECT_EQ(material_of(p, 0).reflectance.value, 1);
  EXPECT_NEAR(texture.scale[0], 2, 1e-12);
  EXPECT_NEAR(texture.scale[1], 3, 1e-12);
  EXPECT_NEAR(texture.offset[0], 0.5, 1e-12);
  EXPECT_NEAR(texture.offset[1], -2.25, 1e-12);
  const scene::Scene scene = scene::load_scene(p);
  const std::vector<scene::Texcoords>& texcoords = scene.geometry.texcoords;
  ASSERT_EQ(texcoords.size(), 2u + 1 + 2);
  EXPECT_EQ(texcoords[0][0], glm::vec2(0, 1)); // at (-1, -1), where v is 0 there
  EXPECT_EQ(texcoords[2][0], glm::vec2(0, 0.25));
  EXPECT_FALSE(material_of(p, 2).texture);
  EXPECT_THAT(made.notes,
              Contains(HasSubstr("what pictures say of it is left out, as the surface has no u, v: grey of 0.5")));
  ASSERT_TRUE(material_of(p, 3).texture);
  EXPECT_EQ(material_of(p, 3).texture->colour1, (preset::Vec3{0.5, 0.25, 1}));
  EXPECT_NEAR(material_of(p, 3).texture->colour0[0], 0.2, 1e-12);
}

TEST_F(MitsubaImport, PlasticHasItsCoat) {
  const preset::Preset p = imported(R"(<shape type="cube"><bsdf type="plastic"/></shape><shape type="cube">
    <bsdf type="roughplastic"><float name="int_ior" value="1.8"/><string name="ext_ior" value="water"/>
    <float name="alpha" value="0.09"/><boolean name="nonlinear" value="true"/></bsdf></shape>)");
  EXPECT_EQ(material_of(p, 0).type, Type::plastic);
  EXPECT_NEAR(material_of(p, 0).dispersion.n, 1.49, 1e-3);
  EXPECT_EQ(material_of(p, 0).roughness, 0);
  EXPECT_EQ(material_of(p, 0).reflectance.value, 0.5);
  EXPECT_EQ(material_of(p, 1).type, Type::plastic);
  EXPECT_NEAR(material_of(p, 1).dispersion.n, 1.8 / 1.333, 1e-3);
  EXPECT_NEAR(material_of(p, 1).roughness, 0.3, 1e-12);
  EXPECT_LT(material_of(p, 1).reflectance.value, 0.4) << "light that goes back and forth below the coat";
}

TEST_F(MitsubaImport, SpectraStaySpectra) {
  folder.write("lamp.spd", "# nm, W\n400 1\n500, 3\n\n600 0\n");
  const std::string at = "<shape type=\"sphere\"/>", light = R"(<emitter type="point">)";
  const auto spectrum_of = [&](const std::string& intensity) {
    return imported(at + light + intensity + "</emitter>").scene.lights.at(0);
  };
  const preset::Light body =
      spectrum_of(R"(<spectrum type="blackbody" name="intensity"><float name="temperature" value="3000"/></spectrum>)");
  EXPECT_EQ(body.spectrum.type, preset::LightSpectrum::Type::blackbody);
  EXPECT_EQ(body.spectrum.temperature_k, 3000);
  EXPECT_EQ(spectrum_of(R"(<blackbody name="intensity" temperature="3000K"/>)"), body); // of version 0.6
  // Triangles of 1 W/nm of each a nanometre, times 4 pi: 400 to 500 nm has (1 + 3) / 2 100, 500 to 600 nm 3 / 2 100.
  // Added up at every nanometre: 200 + 2 (the mean of both ends) + 150 - 1.5.
  const preset::Light listed = spectrum_of(R"(<spectrum name="intensity" value="400:1, 500:3, 600:0"/>)");
  EXPECT_EQ(listed.spectrum.type, preset::LightSpectrum::Type::table);
  EXPECT_NEAR(listed.power_w, 4 * std::numbers::pi * 350.5, 0.01);
  EXPECT_EQ(spectrum_of(R"(<spectrum name="intensity" filename="lamp.spd"/>)"), listed);
  EXPECT_EQ(
      spectrum_of(R"(<spectrum name="intensity" type="irregular"><string name="wavelengths" value="400, 500, 600"/>
    <string name="values" value="1, 3, 0"/></spectrum>)"),
      listed);
  EXPECT_EQ(spectrum_of(R"(<spectrum name="intensity" type="regular"><float name="wavelength_min" value="400"/>
    <float name="wavelength_max" value="600"/><string name="values" value="1, 3, 0"/></spectrum>)"),
            listed);
  EXPECT_EQ(spectrum_of(R"(<spectrum name="intensity" value="2"/>)").spectrum.illuminant, "E");
  EXPECT_EQ(spectrum_of(R"(<spectrum name="intensity" type="d65"/>)"),
            spectrum_of(R"(<rgb name="intensity" value="1"/>)"));
  const preset::Preset p = imported(R"(<shape type="sphere"><bsdf type="diffuse">
    <spectrum name="reflectance" value="300:0, 500:1, 900:1"/></bsdf></shape>)");
  EXPECT_THAT(material_of(p, 0).reflectance.table,
              ElementsAre(std::array{380., 0.4}, std::array{500., 1.}, std::array{780., 1.}));
  EXPECT_THAT(refusal(at + light + R"(<spectrum name="intensity" value="400:1, blue"/></emitter>)"),
              HasSubstr("\"blue\" is no value of a spectrum"));
}

TEST_F(MitsubaImport, AnIndexMayBeASpectrum) {
  const preset::Preset p = imported(R"(<shape type="sphere"><bsdf type="dielectric">
    <spectrum name="int_ior" value="400:1.54, 700:1.51"/><float name="ext_ior" value="1"/></bsdf></shape>)");
  EXPECT_THAT(material_of(p, 0).dispersion.table, ElementsAre(std::array{400., 1.54}, std::array{700., 1.51}));
}

// Mitsuba's sky has -x to the north and -y to the east; turned about x by -90 degrees, its up, z, is +y, so that -y is
// +z. Of 2026-06-21, 11 h at UTC+2 in Berlin Mitsuba 3.9.1 has the sun at (.3751, -.4869, .7888).
TEST_F(MitsubaImport, ASunAndSkyIsASky) {
  const std::string place = R"(<float name="latitude" value="52.52"/><float name="longitude" value="13.405"/>
<float name="timezone" value="2"/><integer name="year" value="2026"/><integer name="month" value="6"/>
<integer name="day" value="21"/><float name="hour" value="11"/>)";
  const auto scene = [](const std::string& emitter) { return "<shape type=\"sphere\"/>" + emitter; };
  const std::string turned =
      R"(<transform name="to_world"><rotate x="1" angle="-90"/></transform><float name="turbidity" value="4"/>)";
  const preset::Environment sky =
      imported(scene("<emitter type=\"sunsky\">" + turned + place +
                     R"(<float name="sun_scale" value="0.5"/><float name="sky_scale" value="2"/></emitter>)"),
               "in.xml")
          .scene.environment.value();
  EXPECT_EQ(sky.type, preset::Environment::Type::sky);
  EXPECT_TRUE(sky.lights);
  EXPECT_EQ(sky.turbidity, 4);
  EXPECT_EQ(sky.radiance, 2);
  EXPECT_EQ(sky.sun_scale, 0.5);
  const preset::Vec3 truth{0.3751, 0.7888, 0.4869};
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(sky.sun_direction.value()[axis], truth[axis], 3e-4);
  EXPECT_THAT(made.notes, Contains(HasSubstr("Preetham's model in place of Hosek's")));

  const auto environment = [&](const std::string& emitter) {
    fs::remove(folder.path() / "out.json");
    return imported(scene(emitter), "in.xml").scene.environment;
  };
  const std::string up = R"(<vector name="sun_direction" x="0" y="1" z="0"/>)";
  EXPECT_EQ(environment("<emitter type=\"sun\">" + turned + up + "</emitter>")->radiance, 0);
  EXPECT_EQ(environment("<emitter type=\"sky\">" + turned + up + "</emitter>")->sun_scale, 0);
  EXPECT_EQ(
      environment("<emitter type=\"sky\">" + turned + R"(<vector name="sun_direction" x="0" y="-1" z="0"/></emitter>)"),
      std::nullopt);
  EXPECT_THAT(made.notes, Contains(HasSubstr("the sun is below the horizon, as up is the z of its to_world")));
}

TEST_F(MitsubaImport, AFlatTransformIsRefused) {
  EXPECT_THAT(
      refusal(R"(<shape type="sphere"><transform name="to_world"><scale x="1" y="0" z="1"/></transform></shape>)"),
      HasSubstr("in.xml:2: its transform has no inverse"));
}

TEST_F(MitsubaImport, NotesAreKeptWhereTheImportFails) {
  EXPECT_THAT(refusal("<shape type=\"hair\"/>"), AllOf(HasSubstr("has no triangles"), HasSubstr("said before: "),
                                                       HasSubstr("the shape hair is left out")));
}

/// A .serialized file (the manual of Mitsuba's shape plugin "serialized") of these meshes, with their names.
class Serialized {
public:
  explicit Serialized(std::uint16_t version) : version_(version) {}

  template <class Number>
  void add(std::uint32_t flags, const std::vector<Number>& numbers, const std::vector<std::uint32_t>& corners,
           std::uint64_t vertices) {
    std::string data;
    put(data, flags);
    if (version_ == 4) data += std::string("name") + '\0';
    put(data, vertices);
    put(data, std::uint64_t{corners.size() / 3});
    for (const Number n : numbers) put(data, n);
    for (const std::uint32_t c : corners) put(data, c);
    starts_.push_back(bytes_.size());
    put(bytes_, std::uint16_t{0x041C});
    put(bytes_, version_);
    uLongf size = compressBound(data.size());
    std::string packed(size, '\0');
    compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(data.data()), data.size());
    bytes_ += packed.substr(0, size);
  }
  std::string bytes() const {
    std::string all = bytes_;
    for (const std::uint64_t start : starts_)
      if (version_ == 4)
        put(all, start);
      else
        put(all, static_cast<std::uint32_t>(start));
    put(all, static_cast<std::uint32_t>(starts_.size()));
    return all;
  }

private:
  template <class T>
  static void put(std::string& to, T value) {
    to.append(reinterpret_cast<const char*>(&value), sizeof value);
  }

  std::uint16_t version_;
  std::string bytes_;
  std::vector<std::uint64_t> starts_;
};

/// Two meshes: one triangle, and a square with normals and texture coordinates in double precision.
std::string two_meshes(std::uint16_t version) {
  Serialized file(version);
  file.add<float>(0x1010, {0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}, 3);
  file.add<double>(0x2003,
                   {0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 1, 1, 0, 1},
                   {0, 1, 2, 0, 2, 3}, 4);
  return file.bytes();
}

TEST_F(MitsubaImport, ItsOwnMeshesAreRead) {
  for (const std::uint16_t version : {3, 4}) {
    folder.write("two.serialized", two_meshes(version));
    const std::string shape = R"(<shape type="serialized"><string name="filename" value="two.serialized"/>)";
    const preset::Preset p = imported(shape + "</shape>" + shape + R"(<integer name="shapeIndex" value="1"/></shape>)");
    ASSERT_EQ(p.scene.objects.size(), 4u); // with their backs
    EXPECT_EQ(scene::load_mesh(folder.path() / *p.scene.objects[0].mesh).triangles.size(), 1u);
    EXPECT_EQ(p.scene.objects[0].normals, preset::Object::Normals::faceted); // so say its flags
    const scene::Mesh square = scene::load_mesh(folder.path() / *p.scene.objects[1].mesh);
    EXPECT_EQ(square.triangles.size(), 2u);
    EXPECT_EQ(square.normals.size(), 4u);
    EXPECT_THAT(refusal(shape + R"(<integer name="shape_index" value="2"/></shape>)"), HasSubstr("has no mesh 2"));
  }
}

TEST_F(MitsubaImport, ABrokenSerializedMeshIsRefused) {
  const std::string shape = R"(<shape type="serialized"><string name="filename" value="m.serialized"/></shape>)";
  const std::string whole = two_meshes(4);
  folder.write("m.serialized", whole.substr(0, 20));
  EXPECT_THAT(refusal(shape), HasSubstr("its packed bytes end too early"));
  folder.write("m.serialized", "obj?" + whole);
  EXPECT_THAT(refusal(shape), HasSubstr("is no serialized mesh"));
  Serialized far(4);
  far.add<float>(0x1000, {0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 3}, 3);
  folder.write("m.serialized", far.bytes());
  EXPECT_THAT(refusal(shape), HasSubstr("a vertex that is not there"));
  Serialized promising(4);
  promising.add<float>(0x1000, {0, 0, 0}, {0, 0, 0}, std::uint64_t{1} << 40);
  folder.write("m.serialized", promising.bytes());
  EXPECT_THAT(refusal(shape), HasSubstr("which is too many"));
}

} // namespace nephroid::mitsuba_import_test
