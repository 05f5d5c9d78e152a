// SPDX-License-Identifier: Apache-2.0
// Importing glTF: small files written here, and what becomes of them against values worked out in comments; and files
// that are cut, missing their data, or lie about it.
#include "formats/import/gltf_scene.h"
#include "formats/import/import.h"
#include "image/image.h"
#include "optics/dispersion.h"
#include "optics/dispersion_file.h"
#include "optics/spectrum.h"
#include "preset/read.h"
#include "scatter/spectra.h"
#include "scene/scene.h"
#include "tests/support/gltf.h"
#include "tests/support/meshes.h"
#include "tests/support/test.h"

#include <numbers>

namespace nephroid::gltf_import_test {

using preset::Light;
using preset::Material;
using Json = nlohmann::json;
using test::GltfImport;
using test::triangle;
using test::triangle_bytes;
using test::word;

TEST_F(GltfImport, ATriangleBecomesAnObjectWithAMeshOfItsOwn) {
  const preset::Preset p = imported(triangle());
  ASSERT_EQ(p.scene.objects.size(), 1u);
  const preset::Object& object = p.scene.objects[0];
  EXPECT_EQ(object.name, "tri");
  EXPECT_EQ(object.material, "wall");
  EXPECT_EQ(*object.mesh, "out-meshes/tri.ply");
  EXPECT_EQ(p.scene.materials.at("wall").reflectance.value, 0.5);
  EXPECT_EQ(p.unit, preset::Preset::Unit::m);
  const scene::Mesh mesh = scene::load_mesh(folder.path() / *object.mesh);
  EXPECT_EQ(mesh.triangles.size(), 1u);
  EXPECT_THAT(mesh.positions, UnorderedElementsAre(glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)));
  EXPECT_THAT(made.notes, ElementsAre(HasSubstr("no camera"), HasSubstr("no lights")));
  EXPECT_THAT(made.summary(), HasSubstr("1 object, 1 mesh, 1 light; the file has no camera"));
}

TEST_F(GltfImport, WhatEmitsShines) {
  Json json = triangle();
  Json& material = json["materials"][0];
  material["emissiveFactor"] = {1, 1, 1};
  material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 1000;
  const preset::Preset p = imported(json);
  ASSERT_EQ(p.scene.lights.size(), 1u);
  EXPECT_EQ(p.scene.lights[0].type, preset::Light::Type::mesh);
  EXPECT_EQ(p.scene.lights[0].object, "tri");
  EXPECT_EQ(p.scene.objects[0].material, "wall");
  const double k = formats::lumens_per_watt(scatter::make_light_spectrum(p.scene.lights[0].spectrum, "spectrum"));
  EXPECT_NEAR(p.scene.lights[0].power_w * k, 1000 * std::numbers::pi * 0.5, 1e-3); // cd/m^2 of half a square metre
  material["emissiveTexture"]["index"] = 0;
  json["textures"] = {{{"source", 0}}};
  json["images"] = {{{"uri", "glow.png"}}};
  image::write_png_bytes(folder.path() / "glow.png", 2, 1, {0, 0, 0, 255, 255, 255, 255, 255});
  const double whole = p.scene.lights[0].power_w;
  EXPECT_NEAR(imported(json).scene.lights[0].power_w, whole / 2, 1e-5 * whole);
  EXPECT_THAT(made.notes,
              testing::Contains(HasSubstr("material 'wall': the picture of its light is taken by its mean")));
}

TEST_F(GltfImport, BinaryFilesAndBuffersBesideTheFileAreRead) {
  import(glb(triangle()), "in.glb");
  EXPECT_EQ(scene::load_mesh(folder.path() / "out-meshes/tri.ply").triangles.size(), 1u);
  fs::remove_all(folder.path() / "out-meshes");
  Json json = triangle();
  json["buffers"][0]["uri"] = "my%20data.bin";
  folder.write("my data.bin", triangle_bytes());
  imported(json);
  EXPECT_EQ(scene::load_mesh(folder.path() / "out-meshes/tri.ply").triangles.size(), 1u);
}

TEST_F(GltfImport, NodesPlaceTheirMeshesWhichAreWrittenOnce) {
  Json json = triangle();
  // The outer node turns by 90 degrees about z and is at (5, 0, 0); the inner one is at (1, 2, 3) in it and twice as
  // large: the inner origin (1, 2, 3) turns to (-2, 1, 3) and moves to (3, 1, 3).
  json["nodes"] =
      Json::parse(R"([{"translation":[5,0,0],"rotation":[0,0,0.7071067811865476,0.7071067811865476],"children":[1,2]},
    {"mesh":0,"name":"a","translation":[1,2,3],"scale":[2,2,2]},{"mesh":0,"name":"a"}])");
  const preset::Preset p = imported(json);
  ASSERT_EQ(p.scene.objects.size(), 2u);
  EXPECT_EQ(made.meshes, 1u);
  EXPECT_EQ(p.scene.objects[0].mesh, p.scene.objects[1].mesh);
  EXPECT_EQ(p.scene.objects[1].name, "a 2");
  const preset::Transform& t = p.scene.objects[0].transform;
  EXPECT_THAT(t.translate, ElementsAre(DoubleNear(3, 1e-12), DoubleNear(1, 1e-12), DoubleNear(3, 1e-12)));
  EXPECT_THAT(t.rotate_deg, ElementsAre(DoubleNear(0, 1e-9), DoubleNear(0, 1e-9), DoubleNear(90, 1e-9)));
  EXPECT_THAT(t.scale, ElementsAre(DoubleNear(2, 1e-12), DoubleNear(2, 1e-12), DoubleNear(2, 1e-12)));
}

TEST_F(GltfImport, EveryTurnIsSaidByThreeAngles) {
  for (const double x : {-170.0, -90.0, 0.0, 33.0, 90.0})
    for (const double y : {-90.0, -45.0, 0.0, 60.0, 90.0})
      for (const double z : {-120.0, 0.0, 77.0})
        for (const double mirror : {1.0, -1.0}) {
          const glm::dmat3 turn = scene::rotation({x, y, z});
          const glm::dmat4 matrix{glm::dvec4(turn[0] * mirror * 3.0, 0),
                                  glm::dvec4(turn[1] * 2.0, 0),
                                  glm::dvec4(turn[2], 0),
                                  {1, 2, 3, 1}};
          const auto t = formats::transform_of(matrix);
          ASSERT_TRUE(t);
          const glm::dmat3 again = scene::rotation(t->rotate_deg);
          for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row)
              EXPECT_NEAR(again[column][row] * t->scale[static_cast<std::size_t>(column)], matrix[column][row], 1e-9)
                  << x << " " << y << " " << z;
        }
  EXPECT_FALSE(formats::transform_of(glm::dmat4{{1, 0, 0, 0}, {0.5, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}))
      << "a shear";
  EXPECT_FALSE(formats::transform_of(glm::dmat4{{1, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}})) << "flat";
}

TEST_F(GltfImport, AShearedMeshIsWrittenAsItIsThen) {
  Json json = triangle();
  json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 0, 0, 7, 1}; // (x, y, z) -> (x + y / 2, y, z + 7)
  const preset::Preset p = imported(json);
  preset::Transform place;
  place.translate = {0, 0, 7};
  EXPECT_EQ(p.scene.objects[0].transform, place);
  EXPECT_THAT(scene::load_mesh(folder.path() / *p.scene.objects[0].mesh).positions,
              UnorderedElementsAre(glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0.5f, 1, 0)));
}

TEST_F(GltfImport, TheCameraLooksAlongMinusZ) {
  Json json = triangle();
  json["cameras"] = Json::parse(R"([{"type":"perspective","perspective":{"yfov":0.5,"aspectRatio":1.5,"znear":0.1}}])");
  json["nodes"].push_back({{"camera", 0}, {"translation", {0, 1, 5}}});
  json["scenes"][0]["nodes"] = {0, 1};
  const preset::Camera camera = imported(json).scene.camera;
  EXPECT_NEAR(camera.fov_deg, 28.6478897565412, 1e-9); // half a radian
  EXPECT_THAT(camera.resolution, ElementsAre(768, 512));
  EXPECT_THAT(camera.position, ElementsAre(0, 1, 5));
  EXPECT_THAT(camera.target, ElementsAre(0, 1, DoubleNear(0, 1e-6))); // as far as the triangle, at z = 0
  EXPECT_THAT(camera.up, ElementsAre(0, 1, 0));
  json["cameras"] = Json::parse(R"([{"type":"orthographic","orthographic":{"xmag":3,"ymag":2,"znear":0,"zfar":9}}])");
  const preset::Camera parallel = imported(json).scene.camera;
  EXPECT_EQ(parallel.projection, preset::Camera::Projection::orthographic);
  EXPECT_EQ(parallel.height, 4);
  EXPECT_THAT(parallel.resolution, ElementsAre(768, 512));
}

TEST_F(GltfImport, CandelaAndLuxBecomeWatts) {
  // The sum of the CIE 1931 ybar over 380..780 nm in steps of 1 nm is 106.86, so equal power has 683 * 106.86 / 401 =
  // 182.0 lm/W. A line at 555 nm has 683.
  optics::Spectrum equal{}, line{};
  equal.fill(1);
  line[555 - 380] = 2;
  EXPECT_NEAR(formats::lumens_per_watt(equal), 182.0, 0.1);
  EXPECT_NEAR(formats::lumens_per_watt(line), 683, 0.1);
  const double k = formats::lumens_per_watt(optics::illuminant("D65"));
  EXPECT_NEAR(k, 200, 10); // daylight within 380..780 nm

  Json json = triangle();
  json["extensions"]["KHR_lights_punctual"]["lights"] = Json::parse(R"([{"type":"point","intensity":100},
    {"type":"spot","intensity":100,"spot":{"innerConeAngle":0.5235987755982988,"outerConeAngle":0.5235987755982988}},
    {"type":"directional","intensity":1000,"color":[1,0.1,0.1]}])");
  for (const int light : {0, 1, 2}) {
    json["nodes"].push_back(
        {{"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}, {"translation", {0, 4, 0}}});
    json["scenes"][0]["nodes"].push_back(1 + light);
  }
  json["nodes"][2]["rotation"] = {-0.7071067811865476, 0, 0, 0.7071067811865476}; // -z turns to -y
  const std::vector<Light> lights = imported(json).scene.lights;
  json["extensions"]["KHR_lights_punctual"]["lights"][1]["spot"]["innerConeAngle"] = 0;
  EXPECT_NEAR(imported(json).scene.lights.at(1).power_w, 84.1787214 / 3 / k, 1e-6); // fades all the way
  ASSERT_EQ(lights.size(), 3u);
  EXPECT_EQ(lights[0].type, Light::Type::point);
  EXPECT_NEAR(lights[0].power_w, 4 * std::numbers::pi * 100 / k, 1e-9);
  EXPECT_THAT(lights[0].position, ElementsAre(0, 4, 0));
  EXPECT_EQ(lights[0].spectrum.illuminant, "D65");
  EXPECT_EQ(lights[1].type, Light::Type::spot);
  EXPECT_NEAR(lights[1].half_angle_deg, 30, 1e-9);
  EXPECT_NEAR(lights[1].power_w, 84.1787214 / k, 1e-6); // 2 pi (1 - cos 30 degrees) 100 lm
  EXPECT_THAT(lights[1].direction, ElementsAre(DoubleNear(0, 1e-9), DoubleNear(-1, 1e-9), DoubleNear(0, 1e-9)));
  EXPECT_EQ(lights[2].type, Light::Type::directional);
  EXPECT_EQ(lights[2].spectrum.type, preset::LightSpectrum::Type::table);
  EXPECT_THAT(lights[2].direction, ElementsAre(DoubleNear(0, 1e-9), DoubleNear(0, 1e-9), DoubleNear(-1, 1e-9)));
  // Its luminance is 0.2126 + 0.7152 * 0.1 + 0.0722 * 0.1 = 0.29134 of white's, whatever its spectrum.
  EXPECT_NEAR(683 * formats::luminous_irradiance(lights[2], {}), 291.34, 0.5);
  EXPECT_NEAR(683 * formats::luminous_irradiance(lights[0], {0, 2, 0}), 25, 1e-6); // 100 cd at 2 m
}

TEST_F(GltfImport, GlassBendsAsItsAbbeNumberSays) {
  // N-BK7: n_d = 1.5168, V_d = 64.17, so n_F - n_C = 0.5168 / 64.17 = 0.0080536.
  const preset::Dispersion d = formats::dispersion_of(1.5168, 20 / 64.17);
  ASSERT_EQ(d.type, preset::Dispersion::Type::cauchy);
  const auto n = [&](double um) { return d.coefficients[0] + d.coefficients[1] / (um * um); };
  EXPECT_NEAR(n(0.5875618), 1.5168, 1e-12);
  EXPECT_NEAR(n(0.4861327) - n(0.6562725), 0.0080536, 1e-7);
  EXPECT_EQ(formats::dispersion_of(1.7, 0).n, 1.7);

  Json json = triangle();
  json["materials"][0]["extensions"] =
      Json::parse(R"({"KHR_materials_transmission":{"transmissionFactor":1},"KHR_materials_ior":{"ior":1.7},
    "KHR_materials_dispersion":{"dispersion":0.3},"KHR_materials_volume":{"thicknessFactor":1,"attenuationDistance":2}})");
  const Material glass = imported(json).scene.materials.at("wall");
  EXPECT_EQ(glass.type, Material::Type::dielectric);
  EXPECT_EQ(glass.dispersion.type, preset::Dispersion::Type::cauchy) << "white attenuation absorbs nothing";
  EXPECT_THAT(made.notes, Not(Contains(HasSubstr("thin film"))));
}

TEST_F(GltfImport, WhatMayBeMeantAsGlassHasANoteThatSaysHowToMakeItGlass) {
  const auto advice =
      Contains(AllOf(HasSubstr("may be meant as glass"),
                     HasSubstr(R"(={"type": "dielectric", "dispersion": 1.5}')"))); // the default of KHR_materials_ior
  imported(triangle());
  EXPECT_THAT(made.notes, Not(advice));
  Json named = triangle(), blended = triangle(), transmits = triangle(), nearly_opaque = triangle();
  named["materials"][0]["name"] = "Wine Glass";
  imported(named);
  EXPECT_THAT(made.notes, advice);
  blended["materials"][0]["alphaMode"] = "BLEND";
  blended["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.2};
  imported(blended);
  EXPECT_THAT(made.notes, advice);
  transmits["materials"][0]["extensions"]["KHR_materials_transmission"]["transmissionFactor"] = 0.4;
  imported(transmits);
  EXPECT_THAT(made.notes, advice);
  nearly_opaque["materials"][0]["alphaMode"] = "BLEND";
  nearly_opaque["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.9};
  imported(nearly_opaque);
  EXPECT_THAT(made.notes, AllOf(Not(advice), Contains(HasSubstr("is opaque here"))));

  // The advice is a --set that the preset takes.
  const std::string name = imported(named).scene.materials.begin()->first;
  const preset::Preset glass = preset::read_preset(
      made.preset.string(), {"scene.materials." + name + R"(={"type": "dielectric", "dispersion": 1.5})"});
  EXPECT_EQ(glass.scene.materials.at(name).type, Material::Type::dielectric);
}

TEST_F(GltfImport, GlassAbsorbsAsItsVolumeSays) {
  Json json = triangle();
  json["materials"][0]["extensions"] =
      Json::parse(R"({"KHR_materials_transmission":{"transmissionFactor":1},"KHR_materials_ior":{"ior":1.7},
    "KHR_materials_volume":{"thicknessFactor":1,"attenuationDistance":2,"attenuationColor":[0.25,0.25,0.25]}})");
  const preset::Preset read = imported(json);
  const preset::Dispersion& named = read.scene.materials.at("wall").dispersion;
  ASSERT_EQ(named.type, preset::Dispersion::Type::file);
  const auto curve_of = [&] { return optics::load_dispersion(made.preset.parent_path() / named.file); };
  const auto left = [](const optics::DispersionCurve& curve, double nm, double metres) {
    return std::exp(-4 * std::numbers::pi * curve.sample(nm).k.value() / (nm * 1e-9) * metres);
  };
  for (const double nm : {380.0, 555.0, 780.0}) {
    EXPECT_NEAR(left(curve_of(), nm, 2), 0.25, 1e-5) << nm;
    EXPECT_NEAR(left(curve_of(), nm, 1), 0.5, 1e-5) << nm;
    EXPECT_NEAR(curve_of().sample(nm).n.value(), 1.7, 1e-12) << nm;
  }

  json["materials"][0]["extensions"]["KHR_materials_volume"]["attenuationColor"] = {0.9, 0.1, 0};
  json["materials"][0]["extensions"]["KHR_materials_dispersion"] = {{"dispersion", 0.3}};
  imported(json);
  EXPECT_GT(left(curve_of(), 640, 2), 0.7);
  EXPECT_LT(left(curve_of(), 450, 2), 0.1);
  const preset::Dispersion clear = formats::dispersion_of(1.7, 0.3);
  EXPECT_NEAR(curve_of().sample(500).n.value(), clear.coefficients[0] + clear.coefficients[1] / 0.25, 1e-12);
}

TEST_F(GltfImport, MetalIsAMirrorAndColoursAreReflectances) {
  Json json = triangle();
  json["materials"][0]["pbrMetallicRoughness"] = {
      {"metallicFactor", 1}, {"roughnessFactor", 0}, {"baseColorFactor", {1, 0, 0, 1}}};
  const Material mirror = imported(json).scene.materials.at("wall");
  EXPECT_EQ(mirror.type, Material::Type::mirror);
  ASSERT_EQ(mirror.reflectance.type, preset::Reflectance::Type::table);
  EXPECT_LT(mirror.reflectance.table.at(7)[1], 0.1) << "red glass keeps blue: 450 nm";
  EXPECT_GT(mirror.reflectance.table.at(26)[1], 0.9) << "640 nm";
  json["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = 1;
  EXPECT_EQ(imported(json).scene.materials.at("wall").roughness, 1);
  json["meshes"][0]["primitives"][0].erase("material");
  EXPECT_TRUE(imported(json).scene.materials.contains("plain"));
}

// In glTF no light goes through metal, which a material is by default.
// glTF counts v from the top. Turned by 90 degrees there, and shifted: (u, v) -> (-v + .25, u). From the bottom, with w
// = 1 - v: (w - .75, 1 - u).
TEST_F(GltfImport, MattSurfacesHaveTexturesOfTheFileOrBesideIt) {
  Json json = triangle();
  const float places[] = {0, 0, 1, 0, 0, 1};
  const std::string bytes(reinterpret_cast<const char*>(places), sizeof places),
      png = image::png(1, 1, {0.5f, 0.25f, 1});
  json["buffers"].push_back(
      {{"byteLength", sizeof places}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}});
  json["buffers"].push_back(
      {{"byteLength", png.size()}, {"uri", "data:application/octet-stream;base64," + base64(png)}});
  json["bufferViews"].push_back({{"buffer", 1}, {"byteLength", sizeof places}});
  json["bufferViews"].push_back({{"buffer", 2}, {"byteLength", png.size()}});
  json["accessors"].push_back({{"bufferView", 2}, {"componentType", 5126}, {"count", 3}, {"type", "VEC2"}});
  json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 2;
  json["images"] = {{{"bufferView", 3}, {"mimeType", "image/png"}}, {{"uri", "b%20c.png"}}};
  json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33071}}};
  json["textures"] = {{{"source", 0}, {"sampler", 0}}, {{"source", 1}}};
  Json& pbr = json["materials"][0]["pbrMetallicRoughness"];
  pbr["baseColorTexture"] = {{"index", 0}};
  pbr["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {{"rotation", std::numbers::pi / 2},
                                                                    {"offset", {0.25, 0}}};
  preset::Preset p = imported(json);
  const auto texture = [&] { return p.scene.materials.begin()->second.texture; };
  ASSERT_TRUE(texture());
  EXPECT_EQ(texture()->file, "out-meshes/wall.png");
  EXPECT_EQ(texture()->wrap, preset::Texture::Wrap::clamp);
  const scene::Scene scene = scene::load_scene(p);
  const scatter::Texture& made_texture = *scene.materials[0].texture;
  for (const glm::dvec2& at : {glm::dvec2(0, 0), {1, 0}, {0.5, 0.25}}) {
    const glm::dvec2 place = made_texture.linear * at + made_texture.offset;
    EXPECT_NEAR(place.x, at.y - 0.75, 1e-9);
    EXPECT_NEAR(place.y, 1 - at.x, 1e-9);
  }
  EXPECT_EQ(scene.geometry.texcoords.at(0), (scene::Texcoords{{{0, 1}, {1, 1}, {0, 0}}}));
  EXPECT_THAT(made.notes, Each(Not(HasSubstr("left out"))));

  pbr["baseColorTexture"] = {{"index", 1}};
  p = imported(json);
  EXPECT_FALSE(texture());
  EXPECT_THAT(made.notes, Contains(HasSubstr("b c.png is not there and left out")));
  image::write_png(folder.path() / "b c.png", 1, 1, {0.5f, 0.25f, 1});
  p = imported(json);
  ASSERT_TRUE(texture());
  EXPECT_EQ(fs::path(texture()->file).filename(), "b c.png");
  pbr["baseColorTexture"]["texCoord"] = 1;
  json["materials"][0]["normalTexture"] = {{"index", 1}, {"scale", 0.5}};
  p = imported(json);
  EXPECT_FALSE(texture());
  EXPECT_THAT(made.notes, Contains(HasSubstr("its texture is left out: its mesh has several sets")));
  ASSERT_TRUE(p.scene.materials.at("wall").normal_map);
  EXPECT_EQ(p.scene.materials.at("wall").normal_scale, 0.5);
  EXPECT_EQ(fs::path(p.scene.materials.at("wall").normal_map->file).filename(), "b c.png");

  // Metal has a picture of its roughness, glass of its tint too, and neither has normals.
  pbr = {{"metallicFactor", 1}, {"roughnessFactor", 0.5}, {"metallicRoughnessTexture", {{"index", 1}}}};
  p = imported(json);
  EXPECT_EQ(p.scene.materials.at("wall").roughness, 0.5);
  ASSERT_TRUE(p.scene.materials.at("wall").roughness_texture);
  EXPECT_THAT(made.notes, Contains(HasSubstr("material 'wall': the metalness of metallicRoughnessTexture, "
                                             "normalTexture left out")));
  pbr["metallicFactor"] = 0;
  pbr["baseColorTexture"] = {{"index", 1}};
  json["materials"][0]["extensions"] = {{"KHR_materials_transmission", {{"transmissionFactor", 1}}},
                                        {"KHR_materials_volume", {{"thicknessFactor", 1}}}};
  p = imported(json);
  EXPECT_TRUE(p.scene.materials.at("wall").roughness_texture);
  EXPECT_TRUE(p.scene.materials.at("wall").tint_texture);
  EXPECT_THAT(made.notes, Contains("material 'wall': normalTexture left out"));
  EXPECT_NO_THROW(scene::load_scene(p));
}

TEST_F(GltfImport, MetalLetsNoLightThrough) {
  Json json = triangle();
  json["materials"][0]["extensions"]["KHR_materials_transmission"]["transmissionFactor"] = 0.8;
  EXPECT_EQ(imported(json).scene.materials.at("wall").type, Material::Type::dielectric);
  EXPECT_THAT(made.notes, Contains(HasSubstr("lets 0.8 of the light through")));
  json["materials"][0]["pbrMetallicRoughness"].erase("metallicFactor");
  EXPECT_EQ(imported(json).scene.materials.at("wall").type, Material::Type::mirror);
  EXPECT_THAT(made.notes, Contains(HasSubstr("no light goes through it in the file either")));
}

TEST_F(GltfImport, GlossIsThatOfPlastic) {
  Json json = triangle();
  json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = 0;
  json["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = 0.2;
  Material wall = imported(json).scene.materials.at("wall");
  EXPECT_THAT(made.notes, Contains(HasSubstr("the colours of the corners of 'tri' are left out")));
  EXPECT_EQ(wall.type, Material::Type::plastic);
  EXPECT_EQ(wall.roughness, 0.2);
  json["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = 0.8;
  EXPECT_EQ(imported(json).scene.materials.at("wall").type, Material::Type::diffuse);
  json["materials"][0]["extensions"]["KHR_materials_clearcoat"]["clearcoatFactor"] = 1;
  wall = imported(json).scene.materials.at("wall");
  EXPECT_EQ(wall.type, Material::Type::plastic);
  EXPECT_EQ(wall.roughness, 0);
  json["materials"][0].erase("extensions");
  json["materials"][0]["pbrMetallicRoughness"]["roughnessFactor"] = 0.2;
  json["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] = 1;
  EXPECT_EQ(imported(json).scene.materials.at("wall").roughness, 0.2);
}

// Whose names are alike but for a blank.
TEST_F(GltfImport, EveryGlassThatAbsorbsIsAFileOfItsOwn) {
  Json json = triangle();
  const Json glass = Json::parse(
      R"({"pbrMetallicRoughness":{"metallicFactor":0,"roughnessFactor":0},"extensions":{"KHR_materials_transmission":
      {"transmissionFactor":1},"KHR_materials_volume":{"thicknessFactor":1,"attenuationDistance":1}}})");
  json["materials"] = {glass, glass};
  for (std::size_t i : {0u, 1u}) {
    json["materials"][i]["name"] = i == 0 ? "my glass" : "my-glass";
    json["materials"][i]["extensions"]["KHR_materials_volume"]["attenuationColor"] = {0.5, 0.5, i == 0 ? 0.5 : 1.0};
    json["meshes"][0]["primitives"][i] = json["meshes"][0]["primitives"][0];
    json["meshes"][0]["primitives"][i]["material"] = i;
  }
  const preset::Preset p = imported(json);
  EXPECT_NE(p.scene.materials.at("my glass").dispersion.file, p.scene.materials.at("my-glass").dispersion.file);
}

TEST_F(GltfImport, WhatIsWrongIsSaidAtItsPlace) {
  const auto with = [&](const char* pointer, const Json& value) {
    Json json = triangle();
    json[Json::json_pointer(pointer)] = value;
    return refusal(json);
  };
  EXPECT_THAT(with("/nodes/0/children", Json{0}),
              HasSubstr("#/nodes/0: the node has two parents, or nodes go round in a circle"));
  EXPECT_THAT(with("/nodes/0/mesh", 7), HasSubstr("#/nodes/0/mesh: is 7, and there are 1 meshes"));
  EXPECT_THAT(with("/nodes/0/mesh", -1), HasSubstr("#/nodes/0/mesh: is of a wrong kind"));
  EXPECT_THAT(with("/nodes/0/translation", "up"), HasSubstr("#/nodes/0/translation"));
  EXPECT_THAT(with("/accessors/0/count", 1000000000),
              HasSubstr("#/accessors/0: its 1000000000 items end at byte 12000000000 of a buffer view of 36"));
  EXPECT_THAT(with("/accessors/0/count", 1e18), HasSubstr("#/accessors/0/count: is of a wrong kind"));
  EXPECT_THAT(with("/bufferViews/0/byteLength", 4000000000u),
              HasSubstr("#/bufferViews/0: ends at byte 4000000000 of a buffer of 42"));
  EXPECT_THAT(with("/buffers/0/uri", "gone.bin"), HasSubstr("#/buffers/0/uri: there is no file"));
  EXPECT_THAT(with("/buffers/0/uri", "in.gltf"), HasSubstr(" of 3"))
      << "the file itself is no buffer of triangles: its text is no index of a vertex";
  EXPECT_THAT(with("/asset/version", "1.0"), HasSubstr("#/asset/version: is \"1.0\""));
  EXPECT_THAT(with("/extensionsRequired", Json{"KHR_draco_mesh_compression"}),
              HasSubstr("compressed by KHR_draco_mesh_compression"));
  EXPECT_THAT(with("/meshes/0/primitives/0/mode", 0), HasSubstr("has no triangles in its scene"));
  EXPECT_THAT(with("/scenes", Json::array()), HasSubstr("has no scene"));
  EXPECT_THAT(with("/scene", 3), HasSubstr("#/scene: is 3, and there are 1 scenes"));
  Json json = triangle();
  json["buffers"][0].erase("uri");
  EXPECT_THAT(refusal(json), HasSubstr("#/buffers/0: has no \"uri\""));
  folder.write("short.bin", "abc");
  EXPECT_THAT(with("/buffers/0/uri", "short.bin"), HasSubstr("#/buffers/0/byteLength: is 42, and there are 3 bytes"));
}

TEST_F(GltfImport, ACutFileIsOneError) {
  const std::string text = triangle().dump(), binary = glb(triangle());
  for (std::size_t length = 0; length < text.size(); length += 29) {
    const Error error = test::error_of([&] { import(text.substr(0, length)); });
    EXPECT_EQ(error.kind(), ErrorKind::bad_input) << length;
  }
  for (std::size_t length = 0; length < binary.size(); length += 29) {
    const Error error = test::error_of([&] { import(binary.substr(0, length), "in.glb"); });
    EXPECT_EQ(error.kind(), ErrorKind::bad_input) << length;
  }
  EXPECT_THAT(test::error_of([&] { import(std::string(100000, '[')); }).line(),
              HasSubstr("is nested deeper than 64 levels"));
  EXPECT_FALSE(fs::exists(folder.path() / "out.json"));
}

TEST_F(GltfImport, FilesOfOtherKindsAreCalledWhatTheyAre) {
  const auto said = [&](const std::string& name, const std::string& bytes) {
    return refusal_of([&] { import(bytes, name); });
  };
  const std::string scenes = "; expected glTF (.gltf, .glb), Mitsuba (.xml), PBRT (.pbrt) or GemCad (.asc)";
  EXPECT_THAT(said("stone.gem", "GemCad 5.0\ng 96 0.0\n"),
              AllOf(HasSubstr("stone.gem: is a cutting list of GemCad, which is not read" + scenes +
                              "; run `nephroid import` on its .asc"),
                    Not(HasSubstr("JSON"))));
  EXPECT_THAT(said("part", "ISO-10303-21;\nHEADER;\n"), HasSubstr("is a CAD model, which is not read" + scenes));
  EXPECT_THAT(said("part.STEP", "x"), HasSubstr("is a CAD model, which is not read"));
  EXPECT_THAT(said("cup.obj", "v 0 0 0\n"), HasSubstr("is a mesh and no scene" + scenes));
  EXPECT_THAT(said("room.blend", "BLENDER-v300"), HasSubstr("is a scene of another kind, which is not read"));
  EXPECT_THAT(said("n.csv", "nm,n\n400,1.5\n"), HasSubstr("n.csv: is no scene that is read here" + scenes));
  EXPECT_THAT(said("words.gltf", "words"), HasSubstr("words.gltf: is no scene that is read here"));
}

} // namespace nephroid::gltf_import_test
