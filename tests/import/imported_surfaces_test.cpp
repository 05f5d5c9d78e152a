// SPDX-License-Identifier: Apache-2.0
// Metals, backs, blends and masks of surfaces, crops of the picture, and what moves.
#include "scatter/spectra.h"
#include "scene/scene.h"
#include "tests/import/imports_scenes.h"

#include <glm/glm.hpp>

namespace nephroid::imported_surfaces_test {

class ImportedSurfaces : public test::ImportsScenes {
protected:
  preset::Preset pbrt(const std::string& world) { return imported("WorldBegin\n" + world, "in.pbrt"); }
  static double reflectance(const preset::Preset& p, std::size_t object, std::size_t wavelength = 200) {
    return scatter::make_reflectance(material_of(p, object).reflectance, "test")[wavelength];
  }
};

std::string matt(double reflectance) {
  return fmt::format("<bsdf type='diffuse'><rgb name='reflectance' value='{}'/></bsdf>", reflectance);
}
std::string twosided(const std::string& bsdfs) { return "<bsdf type='twosided'>" + bsdfs + "</bsdf>"; }
std::string rectangle(const std::string& bsdf) { return "<shape type='rectangle'>" + bsdf + "</shape>"; }

TEST_F(ImportedSurfaces, OfMetalAreConductors) {
  const preset::Preset p = mitsuba(R"(<shape type="cube"><bsdf type="conductor"><string name="material" value="Au"/>
    </bsdf></shape><shape type="cube"><bsdf type="roughconductor" id="own"><spectrum name="eta" value="400:0.5, 700:0.2"/>
    <spectrum name="k" value="3"/></bsdf></shape><shape type="cube"><bsdf type="conductor">
    <string name="material" value="none"/></bsdf></shape><shape type="cube"><bsdf type="conductor">
    <string name="material" value="Cr"/></bsdf></shape>)");
  EXPECT_EQ(material_of(p, 0).type, preset::Material::Type::conductor);
  EXPECT_EQ(material_of(p, 0).metal, "gold");
  EXPECT_EQ(material_of(p, 1).type, preset::Material::Type::conductor);
  EXPECT_THAT(read_file(folder.path() / material_of(p, 1).metal), HasSubstr("0.55 0.35 3"));
  EXPECT_EQ(scene::load_scene(p).materials.size(), p.scene.materials.size()) << "beyond 400 and 700 nm n is held";
  EXPECT_EQ(material_of(p, 2).type, preset::Material::Type::mirror);
  EXPECT_EQ(material_of(p, 3).type, preset::Material::Type::mirror);
  EXPECT_THAT(made.notes, Contains(HasSubstr("the metal is left out: a mirror of its specular_reflectance")));
  EXPECT_NEAR(material_of(p, 1).roughness, std::sqrt(0.1), 1e-12) << "Mitsuba's alpha is .1 where nothing is said";
  EXPECT_THAT(made.notes, Contains(HasSubstr("its facets have the distribution GGX here, not Beckmann's")));
}

// Light of (n - 1)^2 + k^2 over (n + 1)^2 + k^2 comes back: .8 of n = 1 and k = 4.
TEST_F(ImportedSurfaces, OfMetalWithAFactorAreMirrors) {
  const preset::Preset p = mitsuba(R"(<shape type="cube"><bsdf type="roughconductor"><float name="eta" value="1"/>
    <float name="k" value="4"/><float name="specular_reflectance" value=".3"/><float name="alpha" value=".25"/></bsdf>
    </shape><shape type="cube"><bsdf type="conductor"><string name="material" value="Ag"/>
    <float name="specular_reflectance" value=".5"/></bsdf></shape>)");
  EXPECT_EQ(material_of(p, 0).type, preset::Material::Type::mirror);
  EXPECT_NEAR(reflectance(p, 0), 0.24, 1e-6);
  EXPECT_NEAR(material_of(p, 0).roughness, 0.5, 1e-12);
  EXPECT_NEAR(reflectance(p, 1), 0.5 * 0.98, 0.01) << "silver";
  EXPECT_THAT(made.notes, Contains(HasSubstr("the metal is a mirror that reflects alike at all angles")));
}

// Mitsuba's surfaces are black from behind where they are not twosided, and a twosided may have two materials. The back
// is a surface of its own: behind the front, on the side that its normal leaves.
TEST_F(ImportedSurfaces, HaveABackOfTheirOwn) {
  const preset::Preset p =
      mitsuba(rectangle(matt(0.6)) + rectangle(twosided(matt(0.8) + matt(0.1))) + rectangle(twosided(matt(0.5))) +
              "<shape type='rectangle'><boolean name='flip_normals' value='true'/>" + matt(0.7) +
              "</shape><shape type='sphere'>" + matt(0.2) + "</shape>");
  ASSERT_EQ(p.scene.objects.size(), 8u);
  const double expected[] = {0.6, 0.8, 0.5, 0.7, 0.2, 0, 0.1, 0}, behind[] = {0, 0, 0, 0, 0, -1, -1, 1};
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_NEAR(reflectance(p, i), expected[i], 1e-9) << i;
    const double z = p.scene.objects[i].transform.translate[2];
    EXPECT_EQ(z > 0 ? 1 : z < 0 ? -1 : 0, behind[i]) << i;
    EXPECT_LT(std::abs(z), 2e-5) << "two walls of a hundredth of a thousandth are apart";
  }
  EXPECT_EQ(mitsuba(rectangle(twosided(matt(0.5) + "<bsdf type='null'/>"))).scene.objects.size(), 1u);
  EXPECT_EQ(mitsuba("<bsdf type='diffuse' id='black back'><rgb name='reflectance' value='.9'/></bsdf>"
                    "<shape type='rectangle'><ref id='black back'/></shape>")
                .scene.objects.size(),
            2u);
}

// The back of what is curved is a surface, too, where somebody may see it: the outside of what faces inwards, the
// inside of what is open or has the camera in it.
TEST_F(ImportedSurfaces, HaveABackWhereTheyAreCurved) {
  const auto backs = [&](const std::string& shapes) {
    const preset::Preset p = mitsuba("<sensor type='perspective'/>" + shapes);
    return std::ranges::count(p.scene.objects, "black back", &preset::Object::material);
  };
  const std::string flipped = "<boolean name='flip_normals' value='true'/>",
                    sphere = "<shape type='sphere'><float name='radius' value='", cube = "<shape type='cube'>",
                    far = "<transform name='to_world'><translate x='900'/></transform>",
                    wide = "<transform name='to_world'><scale value='900'/></transform>";
  EXPECT_EQ(backs(sphere + "1'/>" + far + matt(0.2) + "</shape>"), 0);
  EXPECT_EQ(backs(sphere + "900'/>" + matt(0.2) + "</shape>"), 1) << "the camera is in it";
  EXPECT_EQ(backs(sphere + "1'/>" + far + flipped + matt(0.2) + "</shape>"), 1);
  EXPECT_EQ(backs(cube + far + matt(0.2) + "</shape>"), 0);
  EXPECT_EQ(backs(cube + wide + matt(0.2) + "</shape>"), 1) << "the camera is in it";
  EXPECT_EQ(backs(cube + far + flipped + matt(0.2) + "</shape>"), 1);
  EXPECT_EQ(backs("<shape type='cylinder'>" + matt(0.2) + "</shape>"), 1) << "it is open";
  EXPECT_EQ(backs("<shape type='cylinder'>" + twosided(matt(0.2)) + "</shape>"), 0);
  const preset::Preset ball = mitsuba(sphere + "2'/>" + flipped + matt(0.2) + "</shape>");
  ASSERT_EQ(ball.scene.objects.size(), 2u);
  const double front = ball.scene.objects[0].transform.scale[0], back = ball.scene.objects[1].transform.scale[0];
  EXPECT_GT(back, front) << "the back is around what faces inwards";
  EXPECT_LT(back, front + 1e-4);
}

TEST_F(ImportedSurfaces, OfOneKindAreBlended) {
  const auto blend = [](const std::string& bsdfs) {
    return rectangle(twosided("<bsdf type='blendbsdf'><float name='weight' value='.75'/>" + bsdfs + "</bsdf>"));
  };
  EXPECT_NEAR(reflectance(mitsuba(blend(matt(0.8) + twosided(matt(0)))), 0), 0.2, 1e-9);
  EXPECT_THAT(made.notes, Each(Not(HasSubstr("blend"))));
  EXPECT_EQ(material_of(mitsuba(blend(matt(0.8) + "<bsdf type='conductor'/>")), 0).type,
            preset::Material::Type::mirror);
  EXPECT_THAT(made.notes, Contains(HasSubstr("the heavier one is taken")));
  EXPECT_EQ(material_of(mitsuba(blend("<bsdf type='dielectric'/>" + matt(0.3))), 0).type,
            preset::Material::Type::diffuse);
  EXPECT_THAT(made.notes, Contains(HasSubstr("the blendbsdf is left out: the heavier material in it is taken")));
  EXPECT_NEAR(reflectance(mitsuba(blend("<bsdf type='null'/>" + matt(0.3))), 0), 0.3, 1e-9);
  std::string deep = matt(0.5);
  for (int i = 0; i < 40; ++i) deep = "<bsdf type='blendbsdf'>" + deep + matt(0.5) + "</bsdf>";
  EXPECT_THAT(test::refusal_of([&] { mitsuba(rectangle(deep)); }), HasSubstr("blends are more than 8 deep"));
  const std::string parts = "MakeNamedMaterial \"a\" \"string type\" \"diffuse\" \"rgb reflectance\" [.8 .8 .8]\n"
                            "MakeNamedMaterial \"b\" \"string type\" \"diffuse\" \"rgb reflectance\" [0 0 0]\n";
  EXPECT_NEAR(reflectance(pbrt(parts + "Material \"mix\" \"string materials\" [\"a\" \"b\"] \"float amount\" .75\n"
                                       "Shape \"sphere\""),
                          0),
              0.2, 1e-9);
  EXPECT_NEAR(reflectance(pbrt(parts + "Material \"mix\" \"string namedmaterial1\" \"a\" \"string namedmaterial2\" "
                                       "\"b\" \"rgb amount\" [.25 .25 .25]\nShape \"sphere\""),
                          0),
              0.2, 1e-9);
  EXPECT_THAT(test::refusal_of([&] { pbrt("Material \"mix\" \"string materials\" [\"a\" \"b\"] Shape \"sphere\""); }),
              HasSubstr("there is no material \"a\" to mix"));
}

TEST_F(ImportedSurfaces, ThatGoRoundInACircleAreRefused) {
  const auto refusal = [](const auto& import) { return test::refusal_of(import); };
  const std::string glass = "MakeNamedMaterial \"glass\" \"string type\" \"dielectric\" ";
  EXPECT_THAT(refusal([&] {
                pbrt(glass + "MakeNamedMaterial \"A\" \"string type\" \"mix\" \"string materials\" [\"glass\" \"A\"] "
                             "\"float amount\" .9 NamedMaterial \"A\" Shape \"sphere\"");
              }),
              HasSubstr("mixes are in each other more than 8 deep, or go round in a circle"));
  EXPECT_THAT(refusal([&] {
                pbrt("Texture \"c\" \"spectrum\" \"checkerboard\" \"texture tex1\" \"c\" "
                     "Material \"diffuse\" \"texture reflectance\" \"c\" Shape \"sphere\"");
              }),
              HasSubstr("textures are in each other more than 8 deep, or go round in a circle"));
  EXPECT_THAT(refusal([&] {
                mitsuba("<texture type='checkerboard' id='a'><ref name='color0' id='b'/></texture>"
                        "<texture type='checkerboard' id='b'><ref name='color0' id='a'/></texture>"
                        "<shape type='rectangle'><bsdf type='diffuse'><ref name='reflectance' id='a'/></bsdf></shape>");
              }),
              HasSubstr("go round in a circle"));
}

TEST_F(ImportedSurfaces, AreNoGlassBehind) {
  mitsuba(rectangle(twosided(matt(0.5) + "<bsdf type='dielectric'/>")));
  EXPECT_THAT(made.notes, Contains(HasSubstr("the second side is left out")));
}

TEST_F(ImportedSurfaces, ThatAMaskTakesAwayAreNotThere) {
  const auto masked = [&](double opacity) {
    return mitsuba("<shape type='sphere'/>" +
                   rectangle(fmt::format("<bsdf type='mask'><float name='opacity' value='{}'/>", opacity) + matt(0.3) +
                             "</bsdf>"))
        .scene.objects.size();
  };
  EXPECT_EQ(masked(0), 1u);
  EXPECT_EQ(masked(1), 3u); // with its black back
  EXPECT_THAT(made.notes, Each(Not(HasSubstr("mask"))));
  EXPECT_EQ(masked(0.3), 1u);
  EXPECT_THAT(made.notes, Contains(HasSubstr("the mask is left out: nothing is there")));
  EXPECT_EQ(mitsuba(rectangle("<bsdf type='mask'><rgb name='opacity' value='.8,.8,.8'/>" + matt(0.3) + "</bsdf>"))
                .scene.objects.size(),
            2u);
}

/// Where a point of the view plane at a distance of 1 is in the picture, in pixels from the upper left.
glm::dvec2 pixel(const preset::Camera& c, const glm::dvec2& right_and_up) {
  const glm::dvec2 size(c.resolution[0], c.resolution[1]);
  const double height = c.height.value_or(2 * std::tan(glm::radians(c.fov_deg) / 2));
  const glm::dvec2 place =
      right_and_up / (height * glm::dvec2(size.x / size.y, 1)) - glm::dvec2(c.shift[0], c.shift[1]);
  return size * glm::dvec2(0.5 + place.x, 0.5 - place.y);
}

// What is in a pixel of the whole picture is in the pixel of the crop that is so many columns and rows further.
TEST_F(ImportedSurfaces, AreSeenInACropOfThePicture) {
  const auto film = [&](const char* type, const std::string& crop) {
    return mitsuba(fmt::format(R"(<sensor type="{}"><film type="hdrfilm"><integer name="width" value="80"/>
      <integer name="height" value="60"/>{}</film></sensor><shape type="sphere"/>)",
                               type, crop))
        .scene.camera;
  };
  const std::string crop = R"(<integer name="crop_offset_x" value="40"/><integer name="crop_offset_y" value="6"/>
    <integer name="crop_width" value="30"/><integer name="crop_height" value="20"/>)";
  for (const char* type : {"perspective", "orthographic"}) {
    const preset::Camera whole = film(type, ""), part = film(type, crop);
    EXPECT_EQ(part.resolution, (std::array{30, 20}));
    for (const glm::dvec2& p : {glm::dvec2(0), glm::dvec2(0.2, -0.1)})
      EXPECT_LT(glm::length(pixel(whole, p) - pixel(part, p) - glm::dvec2(40, 6)), 1e-6);
  }
  EXPECT_THAT(made.notes, Each(Not(HasSubstr("crop"))));
  EXPECT_THAT(test::refusal_of([&] { film("perspective", "<integer name='crop_width' value='81'/>"); }),
              HasSubstr("the crop is no part of the picture; expected one within 80 x 60"));
  const auto pbrt_film = [&](const std::string& more) {
    return imported("Camera \"perspective\" \"float fov\" 50\nFilm \"rgb\" \"integer xresolution\" 80 "
                    "\"integer yresolution\" 60 " +
                        more + "\nWorldBegin\nShape \"sphere\"\n",
                    "in.pbrt")
        .scene.camera;
  };
  EXPECT_EQ(
      imported("Camera \"perspective\"\nFilm \"rgb\" \"integer xresolution\" 101 \"float cropwindow\" [.3 1 0 1]\n"
               "WorldBegin\nShape \"sphere\"\n",
               "in.pbrt")
          .scene.camera.resolution[0],
      70)
      << "of the columns from 31 to 100";
  const preset::Camera whole = pbrt_film("");
  for (const char* text : {"\"integer pixelbounds\" [40 70 6 26]", "\"float cropwindow\" [.5 .875 .1 .43333]"}) {
    const preset::Camera part = pbrt_film(text);
    EXPECT_EQ(part.resolution, (std::array{30, 20}));
    EXPECT_LT(glm::length(pixel(whole, {0.2, 0.1}) - pixel(part, {0.2, 0.1}) - glm::dvec2(40, 6)), 1e-6);
  }
}

// Each time has transforms of its own.
TEST_F(ImportedSurfaces, ThatMoveStandWhereTheShutterOpens) {
  const auto place = [&](const std::string& at_end) {
    return pbrt("AttributeBegin\nTranslate 0 1 0\nActiveTransform StartTime\nTranslate 1 0 0\nActiveTransform EndTime\n"
                "Translate " +
                at_end + " 0 0\nActiveTransform All\nShape \"sphere\"\nAttributeEnd\nShape \"sphere\"\n");
  };
  const preset::Preset p = place("1");
  EXPECT_THAT(made.notes, Each(Not(HasSubstr("motion"))));
  EXPECT_EQ(p.scene.objects.at(0).transform.translate, (preset::Vec3{1, 1, 0}));
  EXPECT_EQ(p.scene.objects.at(1).transform.translate, (preset::Vec3{0, 0, 0}));
  EXPECT_EQ(pbrt("TransformBegin\nActiveTransform EndTime\nTranslate 1 0 0\nTransformEnd\nTranslate 0 3 0\n"
                 "Shape \"sphere\"\n")
                .scene.objects.at(0)
                .transform.translate,
            (preset::Vec3{0, 3, 0}));
  EXPECT_THAT(made.notes, Each(Not(HasSubstr("motion"))));
  pbrt("ActiveTransform EndTime\nTranslate 1 0 0\nLightSource \"point\"\nActiveTransform All\nShape \"sphere\"\n");
  EXPECT_THAT(made.notes, Contains(HasSubstr("in.pbrt:4: motion is left out")));
  EXPECT_EQ(place("5").scene.objects.at(0).transform.translate, (preset::Vec3{1, 1, 0}));
  EXPECT_THAT(made.notes, Contains(HasSubstr("in.pbrt:9: motion is left out: it stands where it is at the first")));
}

} // namespace nephroid::imported_surfaces_test
