// SPDX-License-Identifier: Apache-2.0
// Imports of pictures that say how rough a surface is, what passes it and how its normal leans.
#include "image/image.h"
#include "scene/scene.h"
#include "tests/import/imports_scenes.h"

namespace nephroid::imported_pictures_test {

class ImportedPictures : public test::ImportsScenes {
protected:
  preset::Preset mitsuba(const std::string& scene) {
    return imported("<scene version=\"3.0.0\">" + scene + "</scene>", "in.xml");
  }
  preset::Preset pbrt(const std::string& world) { return imported("WorldBegin\n" + world, "in.pbrt"); }
};

/// The middle texel of a texture, of an import in this folder.
double texel_of(const preset::Texture& texture, const fs::path& folder) {
  const image::Image picture = image::read_image(folder / texture.file);
  EXPECT_TRUE(picture.integers);
  return picture.data.at(0);
}

// A preset's roughness is the root of alpha. Integers that are not raw are sRGB, of which 0.5 is 188 / 255.
TEST_F(ImportedPictures, AreOfRoughnessTintAndNormalsInMitsuba) {
  image::write_png(folder.path() / "p.png", 1, 1, {0.5f, 0.5f, 0.5f});
  folder.write("body.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 0 1\n"
                           "f 1/1 3/2 2/3\nf 1/1 2/2 4/3\nf 1/1 4/2 3/3\nf 2/1 3/2 4/3\n");
  const auto bitmap = [](const std::string& name, const std::string& raw) {
    return "<texture type='bitmap' name='" + name +
           "'><string name='filename' value='p.png'/><boolean name='raw' value='" + raw + "'/></texture>";
  };
  const auto on = [](const std::string& bsdf) { return "<shape type='rectangle'>" + bsdf + "</shape>"; };
  const std::string ggx = "<string name='distribution' value='ggx'/>", map = bitmap("normalmap", "true");
  const preset::Preset p =
      mitsuba(on("<bsdf type='roughconductor'>" + ggx + bitmap("alpha", "true") + "</bsdf>") +
              on("<bsdf type='roughconductor'>" + ggx + bitmap("alpha", "false") + "</bsdf>") +
              "<shape type='obj'><string name='filename' value='body.obj'/><bsdf type='roughdielectric'>" + ggx +
              bitmap("alpha", "true") + bitmap("specular_transmittance", "false") + "</bsdf></shape>" +
              on("<bsdf type='normalmap'>" + map + "<bsdf type='diffuse' id='wall'/></bsdf>") + on("<ref id='wall'/>") +
              on("<bsdf type='normalmap'>" + map + "<bsdf type='plastic'/></bsdf>") +
              on("<bsdf type='roughplastic'>" + ggx + bitmap("alpha", "true") + "</bsdf>"));
  const double raw = 188.0 / 255;
  for (const std::size_t object : {0u, 1u}) {
    EXPECT_EQ(material_of(p, object).roughness, 1);
    ASSERT_TRUE(material_of(p, object).roughness_texture);
    EXPECT_NEAR(texel_of(*material_of(p, object).roughness_texture, folder.path()), std::sqrt(object == 0 ? raw : 0.5),
                4e-3);
  }
  std::size_t glass = 0;
  while (material_of(p, glass).type != preset::Material::Type::dielectric) ++glass;
  EXPECT_TRUE(material_of(p, glass).roughness_texture);
  ASSERT_TRUE(material_of(p, glass).tint_texture);
  EXPECT_EQ(material_of(p, glass).tint_texture->file, fs::absolute(folder.path() / "p.png").string());
  std::size_t with_map = 0, matt = 0;
  for (std::size_t i = 0; i < p.scene.objects.size(); ++i) {
    matt += material_of(p, i).type == preset::Material::Type::diffuse;
    if (!material_of(p, i).normal_map) continue;
    ++with_map;
    const image::Image normals = image::read_image(folder.path() / material_of(p, i).normal_map->file);
    EXPECT_NEAR(normals.data.at(0), raw, 1e-6);
    EXPECT_NEAR(normals.data.at(1), 1 - raw, 1e-6) << "Mitsuba's y goes down in the picture";
  }
  EXPECT_EQ(matt, 2u);
  EXPECT_EQ(with_map, 1u) << "the same bsdf without its map has none";
  EXPECT_THAT(made.notes, IsSupersetOf({HasSubstr("the normalmap is left out: here only diffuse"),
                                        HasSubstr("the texture of alpha is left out: 0.1 takes its place")}));
  EXPECT_THAT(made.notes, Not(Contains(HasSubstr("raw"))));
  EXPECT_NO_THROW(scene::load_scene(p));
}

TEST_F(ImportedPictures, AreOfNoUseWithoutPlaces) {
  image::write_png(folder.path() / "p.png", 1, 1, {0.5f, 0.5f, 0.5f});
  const preset::Preset p = mitsuba("<shape type='sphere'><bsdf type='roughconductor'><texture type='bitmap' "
                                   "name='alpha'><string name='filename' value='p.png'/></texture></bsdf></shape>");
  EXPECT_FALSE(material_of(p, 0).roughness_texture);
  EXPECT_EQ(material_of(p, 0).roughness, 0.5);
  EXPECT_THAT(made.notes, Contains(HasSubstr("has no u, v: a roughness of 0.5 takes its place")));
  EXPECT_NO_THROW(scene::load_scene(p));
}

// Alpha is the root of PBRT's roughness, and a preset's roughness the root of alpha.
TEST_F(ImportedPictures, AreOfRoughnessAndNormalsInPbrt) {
  image::write_png(folder.path() / "p.png", 1, 1, {0.5f, 0.5f, 0.5f});
  const std::string patch = "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0]\n";
  const preset::Preset p =
      pbrt("Texture \"rough\" \"float\" \"imagemap\" \"string filename\" \"p.png\" \"float scale\" .81\n"
           "Texture \"plain\" \"float\" \"imagemap\" \"string filename\" \"p.png\" \"string encoding\" "
           "\"linear\"\n"
           "Material \"conductor\" \"rgb reflectance\" [.8 .8 .8] \"texture roughness\" \"rough\"\n" +
           patch +
           "Material \"conductor\" \"rgb reflectance\" [.8 .8 .8] \"texture roughness\" \"plain\" "
           "\"bool remaproughness\" false\n" +
           patch + "Material \"diffuse\" \"string normalmap\" \"p.png\"\n" + patch +
           "Material \"coateddiffuse\" \"texture roughness\" \"rough\" \"string normalmap\" \"p.png\"\n" + patch);
  const double expected[] = {std::pow(0.5, 0.25), std::pow(188.0 / 255, 0.5)};
  for (const std::size_t object : {0u, 1u}) {
    EXPECT_NEAR(material_of(p, object).roughness, object == 0 ? std::pow(0.81, 0.25) : 1, 1e-9);
    ASSERT_TRUE(material_of(p, object).roughness_texture);
    const image::Image picture = image::read_image(folder.path() / material_of(p, object).roughness_texture->file);
    EXPECT_NEAR(picture.data.at(0), expected[object], 2e-3);
  }
  ASSERT_TRUE(material_of(p, 2).normal_map);
  EXPECT_EQ(material_of(p, 2).normal_map->file, fs::absolute(folder.path() / "p.png").string());
  EXPECT_THAT(made.notes, IsSupersetOf({HasSubstr("the texture \"roughness\" is left out: 0 takes its place"),
                                        HasSubstr("its \"normalmap\" is left out")}));
  EXPECT_NO_THROW(scene::load_scene(p));
}

} // namespace nephroid::imported_pictures_test
