// SPDX-License-Identifier: Apache-2.0
// What PBRT's scenes mean: names of files and of materials, what is inside of what, attributes, media, spectra, meshes.
// Expected values are worked out in comments.
#include "base/inflate.h"
#include "image/image.h"
#include "optics/colour.h"
#include "optics/dispersion.h"
#include "scatter/spectra.h"
#include "scene/mesh.h"
#include "scene/scene.h"
#include "tests/import/imports_scenes.h"

#include <numbers>
#include <zlib.h>

namespace nephroid::pbrt_import_test {

using std::numbers::pi;
using Type = preset::Material::Type;

std::string gzipped(const std::string& text) {
  z_stream z{};
  deflateInit2(&z, Z_DEFAULT_COMPRESSION, Z_DEFLATED, MAX_WBITS + 16, 8, Z_DEFAULT_STRATEGY);
  std::string packed(deflateBound(&z, text.size()), '\0');
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  z.avail_in = static_cast<uInt>(text.size());
  z.next_out = reinterpret_cast<Bytef*>(packed.data());
  z.avail_out = static_cast<uInt>(packed.size());
  deflate(&z, Z_FINISH);
  packed.resize(z.total_out);
  deflateEnd(&z);
  return packed;
}

const std::string triangle = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                             "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                             "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

class PbrtImport : public test::ImportsScenes {
protected:
  preset::Preset imported(const std::string& text) { return ImportsScenes::imported(text, "in.pbrt"); }
  std::string refusal(const std::string& text) {
    return test::refusal_of([&] { imported(text); });
  }
  std::vector<double> indices(const std::string& text) { return ImportsScenes::indices(imported(text)); }
};

TEST_F(PbrtImport, NamesOfAnIncludedFileAreLookedUpFromTheScene) {
  folder.write("geometry/t.ply", triangle);
  folder.write("geometry/t2.ply.gz", gzipped(triangle) + gzipped("")); // gzip may follow gzip
  folder.write("parts/shapes.pbrt.gz", gzipped("Shape \"plymesh\" \"string filename\" \"geometry/t.ply\"\n"
                                               "Shape \"plymesh\" \"string filename\" \"geometry/t2.ply.gz\""));
  EXPECT_EQ(imported("Include \"parts/shapes.pbrt.gz\"").scene.objects.size(), 2u);
}

// Whose files' names are alike but for a blank, or in their first 60 characters.
TEST_F(PbrtImport, EveryMeshFileIsAMeshOfItsOwn) {
  const std::string deep = std::string(70, 'd') + "/",
                    larger = std::string(triangle).replace(triangle.find("1 0 0"), 1, "2");
  for (const char* name : {"a b.ply", "c.ply"}) folder.write(deep + name, triangle);
  for (const char* name : {"a-b.ply", "c/c.ply"}) folder.write(deep + name, larger);
  std::string scene;
  for (const char* name : {"a b.ply", "a-b.ply", "c.ply", "c/c.ply", "./c.ply"})
    scene += "Shape \"plymesh\" \"string filename\" \"" + deep + name + "\"\n";
  const preset::Preset p = imported(scene);
  ASSERT_EQ(p.scene.objects.size(), 5u);
  EXPECT_EQ(made.meshes, 4u);
  EXPECT_EQ(*p.scene.objects[2].mesh, *p.scene.objects[4].mesh);
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_EQ(scene::load_mesh(folder.path() / *p.scene.objects[i].mesh).positions[1].x, i % 2 == 0 ? 1 : 2) << i;
  EXPECT_EQ(p.scene.objects[1].name, "a-b");
}

// The parameters of a directive that nothing here reads.
TEST_F(PbrtImport, EveryParameterThatIsLeftOutIsSaid) {
  imported("Film \"rgb\" \"string filename\" \"x.exr\" \"float diagonale\" 3\nWorldBegin\n"
           "LightSource \"infinite\"\nLightSource \"infinite\"\n"
           "Material \"diffuse\" \"texture displacement\" \"bumps\" \"rgb reflectance\" [.1 .2 .3]\n"
           "Shape \"sphere\" \"float phimax\" 180\nShape \"disk\" \"float innerradius\" .2\n"
           "Shape \"sphere\" \"float radius\" 1 \"float zmin\" -1 \"float zmax\" 1 \"float phimax\" 360\n");
  EXPECT_THAT(made.notes,
              IsSupersetOf({HasSubstr("in.pbrt:1: its \"diagonale\" is left out"),
                            HasSubstr("in.pbrt:4: a second light infinite is left out"),
                            HasSubstr("in.pbrt:5: its \"displacement\" is left out"),
                            HasSubstr("in.pbrt:6: a part of a sphere"), HasSubstr("in.pbrt:7: a part of a disk")}));
  EXPECT_THAT(made.notes, Each(Not(AnyOf(HasSubstr("in.pbrt:8"), HasSubstr("filename"), HasSubstr("reflectance")))));
}

// Version 3 has a metal of its own, and the Kd of its plastic is .25 by default.
TEST_F(PbrtImport, MaterialsOfVersion3AreWhatTheyAreThere) {
  const preset::Preset p = imported("Material \"metal\" Shape \"sphere\"\nMaterial \"plastic\" Shape \"sphere\"\n"
                                    "Material \"mix\" Shape \"sphere\"\n"
                                    "Material \"coateddiffuse\" \"float eta\" 1.4 Shape \"sphere\"\n");
  EXPECT_EQ(material_of(p, 0).type, Type::conductor);
  EXPECT_EQ(material_of(p, 0).metal, "copper");
  EXPECT_EQ(material_of(p, 1).reflectance.value, 0.25);
  EXPECT_EQ(material_of(p, 1).type, Type::plastic);
  EXPECT_EQ(material_of(p, 3).type, Type::plastic);
  EXPECT_EQ(material_of(p, 3).dispersion.n, 1.4);
  EXPECT_EQ(material_of(p, 3).roughness, 0);
  // 0.5 (1 - inner) / (1 - 0.5 inner), with the part 0.5289 of light from within that the coat reflects
  EXPECT_NEAR(material_of(p, 3).reflectance.value, 0.3202, 2e-3);
  EXPECT_THAT(made.notes, IsSupersetOf({HasSubstr("its coat reflects as one of n = 1.5 does"),
                                        HasSubstr("mix is left out: a matt surface of 0.5 takes its place")}));
}

TEST_F(PbrtImport, AnIndexMayBeOneOfEachColour) {
  EXPECT_THAT(indices("Material \"dielectric\" \"rgb eta\" [1.33 1.33 1.33] Shape \"sphere\""), ElementsAre(1.33));
}

TEST_F(PbrtImport, AMaterialMayBeNamedBeforeItIsMade) {
  EXPECT_THAT(indices("NamedMaterial \"a/b\" Shape \"sphere\" NamedMaterial \"a-b\" Shape \"sphere\"\n"
                      "MakeNamedMaterial \"a/b\" \"string type\" \"dielectric\" \"float eta\" 1.4\n"
                      "MakeNamedMaterial \"a-b\" \"string type\" \"glass\" \"float index\" 1.6\n"),
              ElementsAre(1.4, 1.6));
  EXPECT_THAT(refusal("\nNamedMaterial \"nobody\" Shape \"sphere\""),
              HasSubstr("in.pbrt:2: there is no material \"nobody\""));
}

TEST_F(PbrtImport, WhatRefersToItselfIsRefused) {
  EXPECT_THAT(refusal("\nInclude \"in.pbrt\""), AllOf(HasSubstr("in.pbrt:2: "), HasSubstr("includes itself")));
  EXPECT_THAT(refusal("ObjectBegin \"o\" Shape \"sphere\" ObjectInstance \"o\" ObjectEnd"),
              HasSubstr("in.pbrt:1: the object \"o\" is in itself"));
}

TEST_F(PbrtImport, InstancesOfInstancesStandWhereTheyAreMeant) {
  const preset::Preset p = imported("ObjectBegin \"a\" Shape \"sphere\" ObjectEnd\n"
                                    "ObjectBegin \"b\" Translate 1 0 0 ObjectInstance \"a\" ObjectEnd\n"
                                    "Scale 2 2 2 ObjectInstance \"b\" Translate 0 3 0 ObjectInstance \"b\"");
  ASSERT_EQ(p.scene.objects.size(), 2u);
  EXPECT_EQ(p.scene.objects[0].transform.translate, (preset::Vec3{2, 0, 0}));
  EXPECT_EQ(p.scene.objects[1].transform.translate, (preset::Vec3{2, 6, 0}));
}

TEST_F(PbrtImport, AnIndexIsARatioToWhatIsAround) {
  const std::string glass = "Material \"dielectric\" \"float eta\" 1.5 Shape \"sphere\"\n";
  const auto inner = [](const char* eta) {
    return fmt::format("Material \"dielectric\" \"float eta\" {} Shape \"sphere\" \"float radius\" 0.5", eta);
  };
  EXPECT_THAT(indices(glass + inner("0.6666666667")), ElementsAre(1.5, DoubleNear(1, 1e-9))); // a bubble
  EXPECT_THAT(indices(glass + inner("0.8866666667")), ElementsAre(1.5, DoubleNear(1.33, 1e-9)));
  EXPECT_THAT(made.notes, Contains(HasSubstr("its eta is a ratio, and it lies in n = 1.5: n = 1.33 inside")));
  // ReverseOrientation: what is in the material is around the surface.
  EXPECT_THAT(indices(glass + "ReverseOrientation " + inner("1.5")), ElementsAre(1.5, DoubleNear(1, 1e-9)));
  EXPECT_THAT(indices(inner("0.75")), ElementsAre(0.75));
}

TEST_F(PbrtImport, NamedGlassesDisperse) {
  const preset::Preset p = imported("Material \"dielectric\" \"spectrum eta\" \"glass-SF11\" Shape \"sphere\"");
  // Schott's data sheet of N-SF11: n_d = 1.78472, V_d = 25.68.
  const auto curve = scatter::make_curve(material_of(p, 0).dispersion, FileFinder(), "test");
  const auto n = [&](double nm) { return curve.sample(nm).n.value(); };
  EXPECT_NEAR(n(optics::line_d_nm), 1.78472, 1e-5);
  EXPECT_NEAR((n(optics::line_d_nm) - 1) / (n(optics::line_f_nm) - n(optics::line_c_nm)), 25.68, 0.01);
  EXPECT_THAT(
      material_of(imported("Material \"dielectric\" \"spectrum eta\" [ 400 1.54 700 1.51 ] Shape \"sphere\""), 0)
          .dispersion.table,
      ElementsAre(std::array{400., 1.54}, std::array{700., 1.51}));
}

TEST_F(PbrtImport, AMediumInGlassAbsorbsAndAnInterfaceIsNoSurface) {
  const preset::Preset p =
      imported("MakeNamedMedium \"dye\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ 3 3 3 ]\n"
               "  \"rgb sigma_s\" [ 0 0 0 ] \"float scale\" 2\n"
               "Material \"dielectric\"\nAttributeBegin MediumInterface \"dye\" \"\"\n"
               "Shape \"sphere\" AttributeEnd Shape \"sphere\"\n"
               "Material \"interface\" Shape \"sphere\" Material \"\" Shape \"sphere\"");
  ASSERT_EQ(p.scene.objects.size(), 2u);
  // k = 6 l / (4 pi), at 500 nm 2.38732e-07.
  EXPECT_THAT(read_file(folder.path() / material_of(p, 0).dispersion.file), HasSubstr("0.50 2.38732e-07"));
  EXPECT_EQ(material_of(p, 1).dispersion.type, preset::Dispersion::Type::constant);
  EXPECT_EQ(made.notes.size(), 2u) << made.summary(); // no camera, no lights
}

TEST_F(PbrtImport, TintsAndThinPanes) {
  const preset::Preset p =
      imported("Material \"glass\" \"rgb Kt\" [ 0.2 0.9 0.2 ] Shape \"sphere\"\n"
               "Material \"thindielectric\" Shape \"trianglemesh\" \"point3 P\" [ 0 0 0 1 0 0 0 1 0 ]");
  EXPECT_EQ(material_of(p, 0).tint.type, preset::Reflectance::Type::table);
  EXPECT_FALSE(material_of(p, 0).thin);
  EXPECT_TRUE(material_of(p, 1).thin);
  EXPECT_EQ(made.notes.size(), 2u) << made.summary(); // no camera, no lights
}

TEST_F(PbrtImport, MetalsAreConductors) {
  const preset::Preset p =
      imported("Material \"conductor\" \"spectrum eta\" \"metal-Ag-eta\" \"spectrum k\" \"metal-Ag-k\"\n"
               "Shape \"sphere\" Material \"conductor\" \"spectrum eta\" [ 400 1 700 2 ]\n"
               "\"spectrum k\" [ 400 3 700 3 ] Shape \"sphere\"\n"
               "Material \"conductor\" \"spectrum eta\" \"metal-MgO-eta\" Shape \"sphere\"\n"
               "Material \"conductor\" \"rgb reflectance\" [ .5 .5 .5 ] Shape \"sphere\"");
  EXPECT_EQ(material_of(p, 0).metal, "silver");
  EXPECT_EQ(material_of(p, 1).type, Type::conductor);
  EXPECT_EQ(material_of(p, 2).type, Type::mirror);
  EXPECT_THAT(made.notes, Contains(HasSubstr("the metal is left out: a mirror of 0.9")));
  EXPECT_EQ(material_of(p, 3).reflectance.value, 0.5);
  const preset::Preset rough = imported("Material \"dielectric\" \"float roughness\" 0.25 Shape \"sphere\"\n"
                                        "Material \"dielectric\" \"float roughness\" 0.25\n"
                                        "\"bool remaproughness\" false Shape \"sphere\"\n"
                                        "Material \"dielectric\" \"float uroughness\" 0.2 Shape \"sphere\"");
  EXPECT_NEAR(material_of(rough, 0).roughness, std::sqrt(0.5), 1e-12) << "alpha is the root of PBRT's roughness";
  EXPECT_NEAR(material_of(rough, 1).roughness, 0.5, 1e-12);
  EXPECT_THAT(made.notes, Contains(HasSubstr("its two roughnesses 0.2 and 0 are one")));
  imported("Texture \"t\" \"float\" \"imagemap\" \"string filename\" \"a.png\"\n"
           "Material \"dielectric\" \"texture roughness\" \"t\" Shape \"sphere\"");
  EXPECT_THAT(made.notes, Contains(HasSubstr("the texture \"roughness\" is left out: 0 takes its place")));
}

TEST_F(PbrtImport, AttributesHoldUntilTheirBlockEnds) {
  const preset::Preset p = imported("AttributeBegin Attribute \"shape\" \"float radius\" 3 Shape \"sphere\"\n"
                                    "Shape \"sphere\" \"float radius\" 2 AttributeEnd Shape \"sphere\"");
  ASSERT_EQ(p.scene.objects.size(), 3u);
  EXPECT_EQ(p.scene.objects[0].transform.scale[0], 3);
  EXPECT_EQ(p.scene.objects[1].transform.scale[0], 2);
  EXPECT_EQ(p.scene.objects[2].transform.scale[0], 1);
}

TEST_F(PbrtImport, ALampMayHaveTwoSidesAndAPower) {
  const std::string square = "Shape \"bilinearmesh\" \"point3 P\" [ 0 0 0 2 0 0 0 2 0 2 2 0 ]\n",
                    ball = "Shape \"sphere\"\n";
  const auto lights = [&](const std::string& light) {
    return imported(ball + "AreaLightSource \"diffuse\" " + light + " " + square).scene.lights;
  };
  const auto one = lights("\"rgb L\" [ 5 5 5 ]"), two = lights("\"rgb L\" [ 5 5 5 ] \"bool twosided\" true");
  ASSERT_EQ(one.size(), 1u);
  ASSERT_EQ(two.size(), 2u);
  EXPECT_EQ(two[0], one[0]);
  EXPECT_EQ(two[1].power_w, one[0].power_w);
  EXPECT_EQ(two[1].direction[2], -one[0].direction[2]);
  // L = 5 sends 5 pi 4 from 2 x 2; a power counts in the same unit, whatever the area.
  EXPECT_NEAR(lights("\"float power\" 20")[0].power_w, one[0].power_w / pi, 1e-9 * one[0].power_w);
  EXPECT_NEAR(lights("\"float power\" 20 \"bool twosided\" true")[1].power_w, one[0].power_w / pi / 2,
              1e-9 * one[0].power_w);
}

TEST_F(PbrtImport, SpectraStaySpectra) {
  const auto light = [&](const std::string& intensity) {
    return imported("Shape \"sphere\" LightSource \"point\" " + intensity).scene.lights.at(0);
  };
  const preset::Light body = light("\"blackbody I\" 3000 \"float scale\" 2");
  EXPECT_EQ(body.spectrum.temperature_k, 3000);
  EXPECT_EQ(light("\"spectrum I\" \"stdillum-A\"").spectrum.illuminant, "A");
  const preset::Light listed = light("\"spectrum I\" [ 400 1 500 3 600 0 ]");
  EXPECT_EQ(listed.spectrum.type, preset::LightSpectrum::Type::table);
  folder.write("lamp.spd", "400 1\n500 3\n600 0\n");
  EXPECT_EQ(light("\"spectrum I\" \"lamp.spd\""), listed);
  // Version 4 gives every spectrum the luminance of white: as large as rgb 1 1 1 has, times the scale.
  const auto luminous = [](const preset::Light& l) {
    const auto watts = scatter::make_light_spectrum(l.spectrum, "test");
    return optics::to_xyz(watts)[1] * l.power_w;
  };
  const double white = luminous(light("\"rgb I\" [ 1 1 1 ]"));
  EXPECT_NEAR(luminous(listed), white, 1e-3 * white);
  EXPECT_NEAR(luminous(body), 2 * white, 1e-3 * white);
  const preset::Preset p = imported("Material \"matte\" \"spectrum Kd\" [ 300 0 500 1 900 1 ] Shape \"sphere\"");
  EXPECT_THAT(material_of(p, 0).reflectance.table,
              ElementsAre(std::array{380., 0.4}, std::array{500., 1.}, std::array{780., 1.}));
}

/// Loop's limit of an octahedron: a vertex with n = 4 neighbours goes to (1 - n w) v + w sum, w = 1 / (n + 3 / (8 b)),
/// b = (5/8 - (3/8)^2) / 4. The neighbours' sum is 0 by symmetry, so 1 becomes 1 - 4 w.
TEST_F(PbrtImport, ASubdivisionSurfaceIsItsLimit) {
  const preset::Preset p = imported("Material \"dielectric\" Shape \"loopsubdiv\" \"integer levels\" 2\n"
                                    "\"point3 P\" [ 1 0 0 -1 0 0 0 1 0 0 -1 0 0 0 1 0 0 -1 ] \"integer indices\" [\n"
                                    "0 2 4 2 1 4 1 3 4 3 0 4 2 0 5 1 2 5 3 1 5 0 3 5 ]");
  const scene::Mesh mesh = scene::load_mesh(folder.path() / *p.scene.objects.at(0).mesh);
  EXPECT_EQ(mesh.triangles.size(), 8u * 16);
  EXPECT_TRUE(scene::inspect(mesh).closed());
  EXPECT_GT(scene::inspect(mesh).signed_volume, 0);
  const double beta = (5.0 / 8 - 9.0 / 64) / 4, limit = 1 - 4 / (4 + 3 / (8 * beta));
  float highest = 0;
  for (const glm::vec3& v : mesh.positions) highest = std::max(highest, v.x);
  EXPECT_NEAR(highest, limit, 1e-5);
}

TEST_F(PbrtImport, FlatTransformsAndUnknownSystemsAreRefused) {
  EXPECT_THAT(refusal("Scale 1 0 1\nShape \"sphere\""), HasSubstr("in.pbrt:2: its transform has no inverse"));
  EXPECT_THAT(refusal("CoordSysTransform \"moon\""), HasSubstr("there is no coordinate system \"moon\""));
}

TEST_F(PbrtImport, PackedFilesThatAreCutOrTooLargeAreRefused) {
  const std::string zeros = gzipped(std::string(std::size_t{3} << 20, ' '));
  folder.write("cut.pbrt.gz", zeros.substr(0, 100));
  EXPECT_THAT(refusal("Include \"cut.pbrt.gz\""), HasSubstr("its packed bytes end too early"));
  folder.write("cut.pbrt.gz", triangle);
  EXPECT_THAT(refusal("Include \"cut.pbrt.gz\""), HasSubstr("its packed bytes are damaged"));
  EXPECT_THAT(test::refusal_of([&] { inflated(zeros + zeros, "bomb.gz", std::size_t{5} << 20); }),
              HasSubstr("bomb.gz: holds more than 5 MiB"));
}

TEST_F(PbrtImport, MattSurfacesHaveTextures) {
  image::write_png(folder.path() / "p.png", 1, 1, {0.5f, 0.25f, 1});
  const std::string patch = "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0]\n";
  const preset::Preset p =
      imported("Texture \"wood\" \"spectrum\" \"imagemap\" \"string filename\" \"p.png\" \"float uscale\" 2 \"float "
               "vdelta\" .5\n"
               "Texture \"half\" \"spectrum\" \"scale\" \"texture tex\" \"wood\" \"float scale\" .5\n"
               "Texture \"board\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [1 .5 .25] \"float uscale\" 4\n"
               "Texture \"lost\" \"spectrum\" \"imagemap\" \"string filename\" \"no.png\"\n"
               "Material \"diffuse\" \"texture reflectance\" \"half\"\n" +
               patch + "Material \"diffuse\" \"texture reflectance\" \"board\"\n" + patch +
               "Material \"diffuse\" \"texture reflectance\" \"lost\"\n" + patch);
  ASSERT_TRUE(material_of(p, 0).texture);
  EXPECT_EQ(material_of(p, 0).texture->scale, (std::array<double, 2>{2, 1}));
  EXPECT_EQ(material_of(p, 0).texture->offset, (std::array<double, 2>{0, 0.5}));
  EXPECT_NEAR(material_of(p, 0).reflectance.value, 0.5, 1e-12);
  ASSERT_TRUE(material_of(p, 1).texture);
  EXPECT_EQ(material_of(p, 1).texture->colour0, (preset::Vec3{1, 0.5, 0.25}));
  EXPECT_EQ(material_of(p, 1).texture->colour1, (preset::Vec3{0, 0, 0}));
  EXPECT_EQ(material_of(p, 1).texture->scale, (std::array<double, 2>{2, 0.5})) << "a field is one unit there";
  EXPECT_FALSE(material_of(p, 2).texture);
  EXPECT_THAT(made.notes, Contains(HasSubstr("no.png is not there and left out")));
  const scene::Scene scene = scene::load_scene(p);
  for (std::size_t t = 0; t < 2; ++t) // of a patch whose u, v are its x, y
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const glm::vec3 at = scene.geometry.positions[scene.geometry.triangles[t][static_cast<int>(corner)]];
      const glm::vec2 uv = scene.geometry.texcoords[t][corner];
      EXPECT_NEAR(at.x + scene.origin.x, uv.x, 1e-6);
      EXPECT_NEAR(at.y + scene.origin.y, uv.y, 1e-6);
    }
}

} // namespace nephroid::pbrt_import_test
