// SPDX-License-Identifier: Apache-2.0
// How bright an imported picture is, and what of that is said.
#include "image/image.h"
#include "optics/colour.h"
#include "scatter/spectra.h"
#include "scene/scene.h"
#include "tests/import/imports_scenes.h"

#include <functional>
#include <numbers>
#include <numeric>

namespace nephroid::imported_light_test {

class ImportedLight : public test::ImportsScenes {
protected:
  preset::Preset pbrt(const std::string& text) { return imported(text, "in.pbrt"); }
};

// The lamp of a scene a thousand times as large has 10^6 times the watts, and more than a preset's may have.
TEST_F(ImportedLight, ALargeSceneIsAsBrightAsASmallOne) {
  const auto brightness = [&](double size) {
    const preset::Preset p = mitsuba(
        fmt::format(R"(<shape type="sphere"><float name="radius" value="{}"/><bsdf type="diffuse"/><emitter type="area">
    <rgb name="radiance" value="3"/></emitter></shape><emitter type="constant"/>)",
                    size));
    EXPECT_LE(p.scene.lights.at(0).power_w, 1e9);
    EXPECT_NEAR(p.scene.environment->radiance / p.white.value(), 1, 1e-6);
    return p.scene.lights.at(0).power_w / p.white.value() / size / size;
  };
  const double small = brightness(1);
  EXPECT_THAT(made.notes, Each(Not(HasSubstr("a light has more"))));
  EXPECT_NEAR(brightness(1e5) / small, 1, 1e-6);
  EXPECT_THAT(made.notes, Contains(HasSubstr("a light has more than 1e+09 W, or its radiance is more")));
}

// Ten times the number is ten times the light, however large it is, in each kind of light.
TEST_F(ImportedLight, ColoursHaveNoLimit) {
  const auto light = [&](const char* emitter, double scale) {
    std::string scene = "<shape type='sphere'/>" + std::string(emitter);
    for (std::size_t at; (at = scene.find("SCALE")) != std::string::npos;)
      scene.replace(at, 5, fmt::format("{} {} {}", 4 * scale, 2 * scale, scale));
    const preset::Preset p = mitsuba(scene);
    double sum = 0;
    if (!p.scene.lights.empty()) {
      const preset::Light& lamp = p.scene.lights[0];
      sum = lamp.type == preset::Light::Type::directional ? lamp.irradiance_w_m2 : lamp.power_w;
    }
    if (p.scene.environment) sum += p.scene.environment->radiance * p.scene.environment->colour[1];
    return sum / p.white.value();
  };
  for (const char* emitter :
       {"<emitter type='point'><rgb name='intensity' value='SCALE'/></emitter>",
        "<emitter type='directional'><vector name='direction' x='0' y='-1' z='0'/><rgb name='irradiance' "
        "value='SCALE'/></emitter>",
        "<shape type='sphere'><emitter type='area'><rgb name='radiance' value='SCALE'/></emitter></shape>",
        "<emitter type='constant'><rgb name='radiance' value='SCALE'/></emitter>"}) {
    const double unscaled = light(emitter, 1);
    EXPECT_GT(unscaled, 0) << emitter;
    for (const double scale : {1e4, 1e7, 1e9})
      EXPECT_NEAR(light(emitter, scale) / unscaled / scale, 1, 1e-6) << emitter;
  }
}

// A preset's lamp has rows of a table. Their light has the colour, also where the smoothest spectrum is negative.
TEST_F(ImportedLight, SaturatedLampsKeepTheirColour) {
  for (const glm::dvec3& rgb : {glm::dvec3(0, 0, 10), glm::dvec3(10, 0, 0), glm::dvec3(0.5, 3, 0)}) {
    const preset::Preset p = mitsuba(fmt::format("<shape type='sphere'/><emitter type='point'><rgb name='intensity' "
                                                 "value='{} {} {}'/></emitter>",
                                                 rgb.x, rgb.y, rgb.z));
    optics::Spectrum spectrum = scatter::make_light_spectrum(p.scene.lights.at(0).spectrum, "spectrum");
    const double watts = std::accumulate(spectrum.begin(), spectrum.end(), 0.0),
                 per_radiance = p.scene.lights[0].power_w / watts / (4 * std::numbers::pi) / p.white.value();
    for (double& power : spectrum) power *= per_radiance;
    const optics::Colour colour = optics::xyz_to_linear_srgb(optics::to_xyz(spectrum));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(colour[static_cast<std::size_t>(c)], rgb[c], 0.03) << c;
  }
}

// A sky's up is the z axis of its to_world, and the whole scene is turned so that it is +y. The sun's direction is of
// the world whatever to_world is, so between camera and sun there is the angle that was there.
TEST_F(ImportedLight, ASkyMayBeUpAlongAnyAxis) {
  for (const char* to_world :
       {"", "<rotate x='1' angle='-90'/>", "<rotate x='1' angle='180'/>", "<rotate x='1' y='2' z='.5' angle='40'/>"}) {
    const bool is_z_down = std::string_view(to_world).ends_with("180'/>");
    const preset::Preset p = mitsuba(fmt::format(
        R"(<sensor type="perspective"><transform name="to_world"><lookat origin="1,2,3" target="0,0,0" up="0,1,0"/>
    </transform></sensor><shape type="sphere"><point name="center" x="0" y="0" z="2"/></shape><emitter type="sunsky">
    <vector name="sun_direction" x=".6" y=".4" z="{}"/><transform name="to_world">{}</transform></emitter>)",
        is_z_down ? -0.5 : 0.5, to_world));
    const glm::dvec3 sun = scene::to_dvec3(p.scene.environment.value().sun_direction.value()),
                     ball = scene::to_dvec3(p.scene.objects.at(0).transform.translate),
                     eye = scene::to_dvec3(p.scene.camera.position) - scene::to_dvec3(p.scene.camera.target),
                     in_file = glm::normalize(glm::dvec3(0.6, 0.4, is_z_down ? -0.5 : 0.5));
    EXPECT_NEAR(glm::dot(sun, glm::normalize(eye)), glm::dot(in_file, glm::normalize(glm::dvec3(1, 2, 3))), 1e-6);
    EXPECT_NEAR(glm::dot(sun, ball), glm::dot(in_file, glm::dvec3(0, 0, 2)), 1e-6);
    EXPECT_NEAR(glm::dot(glm::normalize(eye), ball), 2 * 3 / std::sqrt(14), 1e-6);
    if (!*to_world) {
      EXPECT_NEAR(ball.y, 2, 1e-6);
    }
    EXPECT_GT(sun.y, 0);
  }
}

/// What a preset's map has in a direction: its centre column is along -z, a turn is counterclockwise seen from above.
glm::dvec3 seen(const preset::Preset& p, const fs::path& folder, const glm::dvec3& direction) {
  const preset::Environment& e = p.scene.environment.value();
  const image::Image map = image::read_image(folder / e.file);
  const double turn =
                   (std::atan2(direction.x, -direction.z) + glm::radians(e.rotate_deg)) / (2 * std::numbers::pi) + 0.5,
               down = std::acos(glm::normalize(direction).y) / std::numbers::pi;
  const int column = std::min(static_cast<int>((turn - std::floor(turn)) * map.width), map.width - 1),
            row = std::min(static_cast<int>(down * map.height), map.height - 1);
  const float* rgb = &map.data[3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(map.width) +
                                    static_cast<std::size_t>(column))];
  return glm::dvec3(rgb[0], rgb[1], rgb[2]) * (e.radiance / p.white.value());
}

// A map that names its directions: red, green and blue are (1 + x, y, z) / 2.
image::Image map_of_directions(int width, int height, const std::function<glm::dvec3(double, double)>& direction) {
  image::Image map{width, height, {"R", "G", "B"}, {}};
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      const glm::dvec3 d = direction((column + 0.5) / width, (row + 0.5) / height);
      for (int c = 0; c < 3; ++c) map.data.push_back(static_cast<float>(0.5 + 0.5 * d[c]));
    }
  return map;
}

// Surroundings may stand in any way, and a world may be mirrored: a ball stands where the map names its direction.
TEST_F(ImportedLight, AMapKeepsItsDirections) {
  using std::numbers::pi;
  const std::vector<glm::dvec3> ways{{0.6, 0.64, 0.48}, {-0.6, 0.64, 0.48}, {0.36, -0.48, -0.8}, {0, -0.6, 0.8}};
  const auto holds = [&](const preset::Preset& p, const glm::dmat3& to_world) {
    for (std::size_t i = 0; i < ways.size(); ++i) {
      const glm::dvec3 ball = glm::normalize(scene::to_dvec3(p.scene.objects.at(i).transform.translate) -
                                             scene::to_dvec3(p.scene.camera.position));
      const glm::dvec3 own = glm::normalize(glm::inverse(to_world) * ways[i]);
      EXPECT_LT(glm::length(seen(p, folder.path(), ball) - (0.5 + 0.5 * own)), 0.02) << i;
    }
  };
  // Mitsuba's: y is up, z in the middle and x to its left.
  image::write_exr(folder.path() / "map.exr", map_of_directions(256, 128, [](double u, double v) {
                     const double a = 2 * pi * (u - 0.5);
                     return glm::dvec3(-std::sin(pi * v) * std::sin(a), std::cos(pi * v),
                                       std::sin(pi * v) * std::cos(a));
                   }));
  std::string balls;
  for (const glm::dvec3& way : ways)
    balls += fmt::format("<shape type='sphere'><point name='center' x='{}' y='{}' z='{}'/></shape>", 9 * way.x,
                         9 * way.y, 9 * way.z);
  const glm::dmat3 about_x(1, 0, 0, 0, 0, 1, 0, -1, 0), about_y(0, 0, -1, 0, 1, 0, 1, 0, 0);
  for (const auto& [text, to_world] :
       {std::pair("", glm::dmat3(1)), {"<rotate y='1' angle='90'/>", about_y}, {"<rotate x='1' angle='90'/>", about_x}})
    holds(mitsuba("<sensor type='perspective'/>" + balls +
                  "<emitter type='envmap'><string name='filename' "
                  "value='map.exr'/><transform name='to_world'>" +
                  text + "</transform></emitter>"),
          to_world);
  // PBRT's: z is up; of version 3 latitude and longitude, x counted at both edges, of 4 the square. Its camera mirrors
  // the world.
  std::string world = "WorldBegin\n";
  for (const glm::dvec3& way : ways)
    world += fmt::format("AttributeBegin Translate {} {} {} Shape \"sphere\" AttributeEnd\n", 9 * way.x, 9 * way.y,
                         9 * way.z);
  image::write_exr(folder.path() / "map.exr", map_of_directions(256, 128, [](double u, double v) {
                     const double a = 2 * pi * u;
                     return glm::dvec3(std::sin(pi * v) * std::cos(a), std::sin(pi * v) * std::sin(a),
                                       std::cos(pi * v));
                   }));
  for (const char* camera : {"", "Scale -1 1 1\n"})
    for (const auto& [text, to_world] : {std::pair("", glm::dmat3(1)), {"Rotate 90 1 0 0", about_x}})
      holds(pbrt(std::string(camera) + "Camera \"perspective\"\n" + world + text +
                 "\nLightSource \"infinite\" \"string mapname\" \"map.exr\""),
            to_world);
  image::write_exr(folder.path() / "map.exr", map_of_directions(256, 256, [](double u, double v) {
                     const double x = 2 * u - 1, y = 2 * v - 1, left = 1 - std::abs(x) - std::abs(y),
                                  r = 1 - std::abs(left), turn = r > 0 ? ((std::abs(y) - std::abs(x)) / r + 1) / 2 : 0,
                                  z = std::copysign(1 - r * r, left), s = r * std::sqrt(2 - r * r), a = turn * pi / 2;
                     return glm::dvec3(std::copysign(s * std::cos(a), x), std::copysign(s * std::sin(a), y), z);
                   })); // Clarberg 2008, from the square to the sphere
  holds(pbrt("Camera \"perspective\"\n" + world +
             "Rotate 90 1 0 0\nLightSource \"infinite\" \"string filename\" "
             "\"map.exr\" \"float scale\" 1"),
        about_x);
  EXPECT_THAT(made.notes, Each(Not(HasSubstr("surroundings"))));
}

// A goniometric light of an even picture is a point lamp with its value.
TEST_F(ImportedLight, AGoniometricLightHasTheMeanOfItsPicture) {
  image::write_exr(folder.path() / "map.exr", {2, 2, {"R", "G", "B"}, std::vector<float>(12, 0.25f)});
  const auto power = [&](const std::string& light) {
    const preset::Preset p = pbrt("WorldBegin\nLightSource " + light + " \"rgb I\" [20 20 20]\nShape \"sphere\"");
    return p.scene.lights.at(0).power_w / p.white.value();
  };
  EXPECT_NEAR(power("\"goniometric\" \"string filename\" \"map.exr\"") / power("\"point\""), 0.25, 1e-6);
  EXPECT_NEAR(power("\"goniometric\" \"string mapname\" \"map.exr\"") / power("\"point\""), 0.25, 1e-6);
}

TEST_F(ImportedLight, WhatAnIntegratorHidesOrEndsIsSaid) {
  mitsuba(R"(<shape type="sphere"/>
<integrator type="path"><boolean name="hide_emitters" value="true"/>
<integer name="max_depth" value="2"/></integrator>)");
  EXPECT_THAT(made.notes, IsSupersetOf({HasSubstr("in.xml:2: hide_emitters is left out: lamps and surroundings are"),
                                        HasSubstr("in.xml:2: paths end at max_depth 2 there")}));
  pbrt("Integrator \"path\"\nWorldBegin\nShape \"sphere\"");
  EXPECT_THAT(made.notes, Contains(HasSubstr("paths end at maxdepth 5 there"))) << "PBRT's default";
  pbrt("Integrator \"path\" \"integer maxdepth\" [2]\nWorldBegin\nShape \"sphere\"");
  EXPECT_THAT(made.notes, Contains(HasSubstr("paths end at maxdepth 2 there")));
}

// A film's values are exposure time x ISO / 100 times the radiance in version 4, whichever of both comes first.
TEST_F(ImportedLight, TheShutterAndTheFilmsSpeedExposeThePicture) {
  const auto white = [&](const std::string& film, const std::string& camera) {
    const std::string world = "WorldBegin LightSource \"infinite\" Shape \"sphere\"";
    const double first = pbrt(film + "\n" + camera + "\n" + world).white.value();
    EXPECT_EQ(pbrt(camera + "\n" + film + "\n" + world).white, first);
    return first;
  };
  const std::string camera = "Camera \"perspective\"", rgb = "Film \"rgb\"",
                    quarter = camera + " \"float shutteropen\" .5 \"float shutterclose\" .75";
  EXPECT_NEAR(white(rgb, quarter) / white(rgb, camera), 4, 1e-9);
  EXPECT_NEAR(white(rgb + " \"float iso\" 800", quarter) / white(rgb, camera), 0.5, 1e-9);
  EXPECT_NEAR(white("Film \"image\"", quarter) / white(rgb, camera), 1, 1e-9); // version 3
  EXPECT_NEAR(white("Film \"image\"", camera + " \"float shutterclose\" 0") / white(rgb, camera), 1, 1e-9);
  EXPECT_THAT(test::refusal_of([&] { pbrt(camera + " \"float shutterclose\" 0\nWorldBegin"); }),
              HasSubstr("shutter that does not open"));
}

} // namespace nephroid::imported_light_test
