// SPDX-License-Identifier: Apache-2.0
// Imports of pictures that say how rough a surface is, what passes it and how its normal leans.
#include "image/image.h"
#include "scene/scene.h"
#include "tests/import/imports_scenes.h"

namespace nephroid::imported_pictures_test {

class ImportedPictures : public test::ImportsScenes {
protected:
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
    matt += material_of(p, i).type == preset::Material::Type::diffuse && p.scene.objects[i].material != "black back";
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

// Version 0.6: u and v times their scales, plus their offsets. From the bottom 1 - v' = 3 (1 - v) - 2.25.
TEST_F(ImportedPictures, AnOldTextureHasScalesAndOffsets) {
  image::write_png(folder.path() / "p.png", 1, 1, {0.5f, 0.25f, 1});
  const preset::Preset p = mitsuba(R"(<shape type='rectangle'><bsdf type="diffuse"><texture type="bitmap"
    name="reflectance"><string name="filename" value="p.png"/><float name="uscale" value="2"/>
    <float name="vscale" value="3"/><float name="uoffset" value=".5"/><float name="voffset" value=".25"/></texture>
    </bsdf></shape>)");
  const preset::Texture& texture = *material_of(p, 0).texture;
  EXPECT_THAT(texture.scale, ElementsAre(DoubleNear(2, 1e-12), DoubleNear(3, 1e-12)));
  EXPECT_THAT(texture.offset, ElementsAre(DoubleNear(0.5, 1e-12), DoubleNear(-2.25, 1e-12)));
}

/// Of reflectances, as they are after the import: linear.
float first_texel(const preset::Texture& texture, const fs::path& folder) {
  const image::Image picture = image::read_image(folder / texture.file);
  EXPECT_FALSE(picture.integers);
  return picture.data.at(0);
}

// 188 of 255 is .737 where it is no sRGB, and 1 minus that where it is turned round.
TEST_F(ImportedPictures, MayBeLinearAndInverted) {
  image::write_png(folder.path() / "p.png", 1, 1, {0.5f, 0.5f, 0.5f});
  const preset::Preset m = mitsuba(R"(<shape type="rectangle"><bsdf type="twosided"><bsdf type="diffuse"><texture
    type="bitmap" name="reflectance"><string name="filename" value="p.png"/><boolean name="raw" value="true"/></texture>
    </bsdf></bsdf></shape>)");
  EXPECT_NEAR(first_texel(*material_of(m, 0).texture, folder.path()), 188.0 / 255, 1e-6);
  EXPECT_THAT(made.notes, Each(Not(HasSubstr("raw"))));
  const auto with = [&](const std::string& more) {
    const preset::Preset p = pbrt("Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"p.png\" " + more +
                                  "\nMaterial \"diffuse\" \"texture reflectance\" \"t\"\n"
                                  "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0]\n");
    return first_texel(*material_of(p, 0).texture, folder.path());
  };
  EXPECT_NEAR(with("\"string encoding\" \"linear\""), 188.0 / 255, 1e-6);
  EXPECT_NEAR(with("\"bool invert\" true"), 0.5, 4e-3);
  EXPECT_NEAR(with("\"bool invert\" true \"string encoding\" \"linear\""), 1 - 188.0 / 255, 1e-6);
}

// A lamp, a mirror or a number of the sky has no texture here: what it has on the mean is taken.
TEST_F(ImportedPictures, AreTakenByTheirMeanWhereNothingElseIs) {
  image::write_exr(folder.path() / "p.exr", {2, 1, {"R", "G", "B"}, {0.5f, 0.5f, 0.5f, 0, 0, 0}});
  image::write_png(folder.path() / "p.png", 2, 1, {0.5f, 0.5f, 0.5f, 0, 0, 0});
  const auto power = [](const preset::Preset& p) { return p.scene.lights.at(0).power_w / p.white.value(); };
  const auto glowing = [&](const std::string& radiance) {
    return power(mitsuba("<shape type='rectangle'><emitter type='area'>" + radiance + "</emitter></shape>"));
  };
  const double plain = glowing("<rgb name='radiance' value='1'/>");
  const auto bitmap = [](const char* file, const char* more) {
    return fmt::format("<texture name='radiance' type='bitmap'><string name='filename' value='{}'/>{}</texture>", file,
                       more);
  };
  EXPECT_NEAR(glowing(bitmap("p.exr", "")) / plain, 0.25, 1e-6);
  EXPECT_THAT(made.notes, Contains(HasSubstr("this texture is taken by its mean")));
  EXPECT_NEAR(glowing(bitmap("p.png", "")) / plain, 0.25, 2e-3);
  EXPECT_NEAR(glowing(bitmap("p.png", "<boolean name='raw' value='true'/>")) / plain, 188.0 / 510, 1e-6);
  const auto lamp = [&](const std::string& light) {
    return power(pbrt("AreaLightSource \"diffuse\" " + light + "\nShape \"sphere\"\n"));
  };
  EXPECT_NEAR(lamp("\"string filename\" \"p.exr\" \"float scale\" 3") / lamp("\"rgb L\" [3 3 3]"), 0.25, 1e-6);
}

} // namespace nephroid::imported_pictures_test
