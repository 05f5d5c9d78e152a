// SPDX-License-Identifier: Apache-2.0
// What a loaded scene has on the 401 wavelengths: lights, materials of every kind, environments and what is refused of
// their pictures, and the tables that photons are drawn by from an environment.
#include "image/image.h"
#include "scatter/spectra.h"
#include "tests/support/loaded_scenes.h"
#include "tracing/scene_tables.h"

namespace nephroid::scene::scene_light_test {

using namespace nephroid::scatter;

TEST(SceneLight, AreaLightHasItsEdges) {
  preset::Preset preset = ball_over_floor();
  preset::Light& light = preset.scene.lights[0];
  light.type = preset::Light::Type::area;
  light.direction = {0, -2, 0};
  light.up = {0, 1, 1};
  light.size = {3, 5};
  const Light area = load_scene(preset).lights[0];
  expect_near(area.direction, {0, -1, 0}, 1e-7);
  expect_near(area.edge_v, {0, 0, 5}, 1e-6);
  expect_near(area.edge_u, {3, 0, 0}, 1e-6);
  expect_near(glm::cross(area.edge_u, area.edge_v), {0, -15, 0}, 1e-5);

  light.size = {3, 100};
  light.position = {0, 0.3, 0}; // in the ball, its corners outside
  EXPECT_THAT(load_scene(preset).warnings,
              ElementsAre(HasSubstr("light 0: reaches through the surface of a dielectric")));
}

TEST(SceneLight, AMeshIsAnObject) {
  preset::Preset preset = ball_over_floor();
  preset::Light& light = preset.scene.lights[0];
  light.type = preset::Light::Type::mesh;
  light.object = preset.scene.objects[0].name;
  const Scene scene = load_scene(preset);
  EXPECT_EQ(scene.lights[0].object, 0);
  EXPECT_TRUE(scene.lights[0].inside.empty()) << "it shines to the outside of its glass";
  EXPECT_TRUE(scene.warnings.empty());
  std::vector<int> wavelengths(optics::wavelength_count);
  std::iota(wavelengths.begin(), wavelengths.end(), 0);
  const tracing::SceneTables tables = tracing::make_scene_tables(scene, {wavelengths}, {});
  ASSERT_TRUE(tables.lamps);
  EXPECT_EQ(tables.lamps->lamp_tables, std::vector<float>{1});
  EXPECT_EQ(tables.lights[0].table, 0);
}

TEST(SceneLight, LightsKeepTheirFigures) {
  preset::Preset preset = ball_over_floor();
  preset::Light& light = preset.scene.lights[0];
  light.type = preset::Light::Type::spot;
  light.half_angle_deg = 60;
  light.power_w = 7;
  light.spectrum.illuminant = "F10";
  const Light spot = load_scene(preset).lights[0];
  EXPECT_NEAR(spot.cos_half_angle, 0.5, 1e-12);
  EXPECT_EQ(spot.power_w, 7);
  EXPECT_NEAR(std::accumulate(spot.spectrum.begin(), spot.spectrum.end(), 0.0), 1, 1e-12);
  light.type = preset::Light::Type::directional;
  light.irradiance_w_m2 = 1361;
  EXPECT_EQ(load_scene(preset).lights[0].irradiance_w_m2, 1361);
}

TEST(SceneLight, MaterialsOnTheWavelengths) {
  preset::Preset preset = ball_over_floor();
  // Schott N-BK7: n_d(587.5618 nm) = 1.5168.
  preset::Dispersion& glass = preset.scene.materials["glass"].dispersion;
  glass.type = preset::Dispersion::Type::sellmeier;
  glass.b = {1.03961212, 0.231792344, 1.01046945};
  glass.c_um2 = {0.00600069867, 0.0200179144, 103.560653};
  preset.scene.materials["wall"].reflectance.value = 0.25;
  const Scene scene = load_scene(preset);
  EXPECT_NEAR(scene.materials[0].n[588 - optics::first_nm], 1.5168, 5e-5);
  EXPECT_FALSE(scene.materials[0].absorbs);
  EXPECT_EQ(scene.materials[1].type, preset::Material::Type::mirror);
  EXPECT_DOUBLE_EQ(scene.materials[1].reflectance[200], 0.8);
  EXPECT_DOUBLE_EQ(scene.materials[2].reflectance[0], 0.25);
}

TEST(SceneLight, EveryKindOfDispersionSpectrumAndReflectance) {
  const FileFinder finder;
  const auto index_at = [&](const preset::Dispersion& d, double nm) {
    return *make_curve(d, finder, "w").sample(nm).n;
  };
  preset::Dispersion d{.n = 1.33};
  EXPECT_DOUBLE_EQ(index_at(d, 500), 1.33);
  d.type = preset::Dispersion::Type::cauchy;
  d.coefficients = {1.5, 0.01}; // 1.5 + 0.01 / 0.25 at 500 nm
  EXPECT_NEAR(index_at(d, 500), 1.54, 1e-12);
  d.type = preset::Dispersion::Type::table;
  d.table = {{400, 1.6}, {600, 1.5}};
  EXPECT_NEAR(index_at(d, 450), 1.575, 1e-12);
  d.type = preset::Dispersion::Type::points;
  EXPECT_NEAR(index_at(d, 600), 1.5, 1e-12);

  preset::LightSpectrum s{.type = preset::LightSpectrum::Type::lines, .table = {{500, 3}, {600.5, 1}}};
  const optics::Spectrum lines = make_light_spectrum(s, "w");
  EXPECT_NEAR(lines[120], 0.75, 1e-12);
  EXPECT_NEAR(lines[220], 0.125, 1e-12);
  s.type = preset::LightSpectrum::Type::table;
  s.table = {{380, 1}, {780, 1}};
  EXPECT_NEAR(make_light_spectrum(s, "w")[7], 1.0 / 401, 1e-15);
  s.type = preset::LightSpectrum::Type::blackbody;
  s.temperature_k = 3000;
  EXPECT_GT(make_light_spectrum(s, "w")[400], 5 * make_light_spectrum(s, "w")[0]); // reddish

  preset::Reflectance r{.type = preset::Reflectance::Type::table, .table = {{400, 0}, {600, 1}}};
  EXPECT_NEAR(make_reflectance(r, "w")[120], 0.5, 1e-12);
  r.type = preset::Reflectance::Type::patch;
  r.patch = "blue sky";
  EXPECT_GT(make_reflectance(r, "w")[450 - 380], make_reflectance(r, "w")[650 - 380]);

  EXPECT_EQ(outside_policy(preset::Extrapolation::automatic), optics::Extrapolation::automatic);
  EXPECT_EQ(outside_policy(preset::Extrapolation::hold), optics::Extrapolation::hold);
  EXPECT_EQ(outside_policy(preset::Extrapolation::extrapolate), optics::Extrapolation::extrapolate);
  EXPECT_EQ(outside_policy(preset::Extrapolation::refuse), optics::Extrapolation::refuse);
}

class SceneEnvironment : public testing::Test {
protected:
  test::TemporaryFolder temporary;
  std::vector<std::string> warnings;

  std::string write_exr(const std::vector<float>& data, int width,
                        std::vector<std::string> channels = {"R", "G", "B"}) const {
    const int height = static_cast<int>(data.size() / channels.size()) / width;
    const std::string file = (temporary.path() / "sky.exr").string();
    image::write_exr(file, {width, height, std::move(channels), data, {}});
    return file;
  }
  Environment load(const std::string& file) {
    preset::Environment environment{.file = file, .radiance = 3, .rotate_deg = 20};
    return make_environment(environment, FileFinder(), Location("p.json", "/scene/environment"), warnings);
  }
};

TEST_F(SceneEnvironment, FloatsAreTakenAsTheyAre) {
  const Environment e = load(write_exr({1, 2, 3, 4, 5, 1e6f}, 2));
  EXPECT_EQ(e.width, 2);
  EXPECT_EQ(e.height, 1);
  EXPECT_THAT(e.rgb, ElementsAre(1, 2, 3, 4, 5, 1e6f));
  EXPECT_EQ(e.radiance, 3);
  EXPECT_EQ(e.rotate_deg, 20);
  EXPECT_FALSE(e.is_black());
  EXPECT_THAT(warnings, IsEmpty());
}

TEST_F(SceneEnvironment, IntegersAreDecodedAndGreyHasThreeChannels) {
  const std::string png = (temporary.path() / "sky.png").string();
  image::write_png_bytes(png, 2, 1, {0, 255, 188, 255, 255, 255, 255, 255});
  const Environment e = load(png);
  EXPECT_EQ(e.rgb[1], 1);
  EXPECT_NEAR(e.rgb[2], 0.50289, 1e-5); // IEC 61966-2-1 of 188 / 255
  EXPECT_THAT(load(write_exr({0.5f, 0.25f}, 2, {"Y"})).rgb, ElementsAre(0.5f, 0.5f, 0.5f, 0.25f, 0.25f, 0.25f));
}

TEST_F(SceneEnvironment, AConstantIsOneTexel) {
  preset::Environment environment{.type = preset::Environment::Type::constant, .colour = {0.25, 0.5, 0}};
  Environment e = make_environment(environment, FileFinder(), Location("p.json", "/scene/environment"), warnings);
  EXPECT_EQ(e.width * e.height, 1);
  EXPECT_THAT(e.rgb, ElementsAre(0.25f, 0.5f, 0));
  EXPECT_FALSE(e.is_black());
  e.radiance = 0;
  EXPECT_TRUE(e.is_black());
}

TEST_F(SceneEnvironment, ABadTexelIsNamed) {
  std::vector<float> sky(3 * 8, 1.0f);
  sky[3 * 6 + 1] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(refusal_of([&] { load(write_exr(sky, 4)); }),
              HasSubstr("sky.exr: green of the texel in row 1, column 2 (from 0) is not a number"));
  sky[3 * 6 + 1] = 1;
  sky[3 * 3] = std::numeric_limits<float>::infinity();
  EXPECT_THAT(refusal_of([&] { load(write_exr(sky, 4)); }),
              HasSubstr("red of the texel in row 0, column 3 (from 0) is infinite"));
  sky[3 * 3] = 1;
  sky[3 * 7 + 2] = -1;
  EXPECT_THAT(refusal_of([&] { load(write_exr(sky, 4)); }),
              HasSubstr("blue of the texel in row 1, column 3 (from 0) is negative"));
}

// As every map of Debian's blender-data has them, which are compressed with loss.
TEST_F(SceneEnvironment, AFewValuesBelowNothingAreBlackAndSaid) {
  std::vector<float> sky(3 * 8, 1.0f);
  sky[3 * 7 + 2] = sky[4] = -0.01f; // 0.02 of 22
  const Environment e = load(write_exr(sky, 4));
  EXPECT_EQ(e.rgb[3 * 7 + 2], 0);
  EXPECT_EQ(e.rgb[4], 0);
  EXPECT_EQ(e.rgb[0], 1);
  EXPECT_THAT(
      warnings,
      ElementsAre("environment sky.exr: 2 values are below 0, in sum 0.0009 of all its light; they are taken as 0"));
  sky[4] = -0.02f;
  EXPECT_THAT(refusal_of([&] { load(write_exr(sky, 4)); }),
              HasSubstr("green of the texel in row 0, column 1 (from 0) is negative"));
}

TEST_F(SceneEnvironment, WhatIsNoSuchPictureIsRefused) {
  EXPECT_THAT(refusal_of([&] { load(temporary.write("sky.hdr", "not a picture")); }),
              AllOf(HasSubstr("sky.hdr: is no picture that can be read: "),
                    HasSubstr("; expected a whole EXR, HDR, PNG, JPEG or another"),
                    EndsWith("; save it anew, or name another file")));
  EXPECT_THAT(refusal_of([&] { load(write_exr({1, 2}, 1, {"R", "G"})); }), HasSubstr("has the channels"));
  EXPECT_THAT(refusal_of([&] { load("no-such-sky.exr"); }), HasSubstr("p.json#/scene/environment/file"));
}

TEST_F(SceneEnvironment, AnotherShapeIsStretchedAndSaid) {
  const Environment e = load(write_exr(std::vector<float>(3 * 4 * 4, 1.0f), 4));
  EXPECT_EQ(e.height, 4);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr("4 x 4 texels"));
}

// The film resolves 2^-20 of the mean. What is 0 is black whatever the film resolves.
TEST_F(SceneEnvironment, ARangeThatTheFilmCannotHoldIsSaid) {
  std::vector<float> sky(3 * 8, 1.0f);
  sky[5] = 1e12f;
  load(write_exr(sky, 4));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr("sky.exr: half of its values above 0 are below 2e-11 of its mean"));
  warnings.clear();
  std::fill(sky.begin(), sky.end(), 0.0f);
  for (const std::size_t i : {0, 1, 2, 3}) sky[i] = i < 2 ? 1e12f : 1;
  load(write_exr(sky, 4));
  EXPECT_THAT(warnings, IsEmpty()) << "half is not more than half";
  sky[4] = 1;
  load(write_exr(sky, 4));
  EXPECT_EQ(warnings.size(), 1u);
  warnings.clear();
  load(write_exr(std::vector<float>(3 * 8, 0.0f), 4));
  EXPECT_THAT(warnings, IsEmpty());
}

TEST_F(SceneEnvironment, TheSceneHasIt) {
  preset::Preset preset = test::ball_over_floor();
  EXPECT_FALSE(load_scene(preset).environment);
  preset.scene.environment.emplace();
  preset.scene.environment->file = write_exr(std::vector<float>(3 * 8 * 4, 0.5f), 8);
  const Scene scene = load_scene(preset);
  ASSERT_TRUE(scene.environment);
  EXPECT_EQ(scene.environment->width, 8);
}

scene::Environment map_of(int width, std::vector<float> rgb) {
  return {.width = width, .height = static_cast<int>(rgb.size() / 3) / width, .rgb = std::move(rgb)};
}

/// Faint and strong, coloured, black.
scene::Environment uneven() {
  std::vector<float> rgb;
  for (int i = 0; i < 64; ++i)
    for (int c = 0; c < 3; ++c)
      rgb.push_back(i % 5 == 4 ? 0.0f : i == 17 ? 3e4f : static_cast<float>(0.1 + (i + c) % 3));
  return map_of(8, rgb);
}

TEST(EnvironmentFlux, TexelsFillTheSphere) {
  for (const int width : {1, 2, 8, 4096}) {
    const scene::Environment map =
        map_of(width, std::vector<float>(static_cast<std::size_t>(3 * width * std::max(1, width / 2)), 1.0f));
    double sum = 0;
    for (int row = 0; row < map.height; ++row) sum += width * scene::texel_steradians(map, row);
    EXPECT_NEAR(sum / (4 * M_PI), 1, 1e-12) << width;
  }
}

TEST(EnvironmentFlux, OneColourHasItsSpectrum) {
  scene::Environment map = map_of(2, {0.9f, 0.6f, 0.3f, 0.9f, 0.6f, 0.3f});
  map.radiance = 5;
  const scene::EnvironmentFlux flux = scene::flux_of(map);
  EXPECT_NEAR(flux.grey, 0.6 * 4 * M_PI, 1e-6);
  const scene::Light light = scene::make_environment_light(map);
  EXPECT_NEAR(std::accumulate(light.spectrum.begin(), light.spectrum.end(), 0.0), 1, 1e-12);
  double sum = 0;
  for (std::size_t w = 0; w < light.spectrum.size(); ++w) {
    double radiance = 0, carried = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      radiance += 5 * static_cast<double>(map.rgb[c]) * optics::primary_spectra()[c][w];
      carried += flux.mean[c] * light.primaries[c][w];
    }
    sum += std::abs(radiance);
    EXPECT_NEAR(light.irradiance_w_m2 * carried, 4 * M_PI * radiance, 1e-7);
    EXPECT_NEAR(light.spectrum[w], std::abs(carried), 1e-7);
  }
  EXPECT_NEAR(light.irradiance_w_m2, 4 * M_PI * sum, 1e-4);
}

// No photon carries much more than another, and each texel is drawn as often as its flux asks for.
TEST(SkyTables, PhotonsCarryAlike) {
  const scene::Environment map = uneven();
  const tracing::SkyTables tables = tracing::make_sky_tables(map);
  const double all = scene::flux_of(map).grey;
  ASSERT_EQ(tables.texel_cdf.size(), 2 * (8u + 64u)) << "and of the peaks";
  ASSERT_EQ(tables.texel_colour.size(), map.rgb.size());
  const auto chance = [&](std::size_t first, std::size_t i) {
    return static_cast<double>(tables.texel_cdf[first + i]) -
           (i > 0 ? static_cast<double>(tables.texel_cdf[first + i - 1]) : 0.0);
  };
  for (std::size_t row = 0; row < 8; ++row)
    for (std::size_t column = 0; column < 8; ++column) {
      const std::size_t texel = 8 * row + column;
      const double drawn = chance(0, row) * chance(8 + 8 * row, column), grey = scene::grey(map, texel),
                   steradians = scene::texel_steradians(map, static_cast<int>(row));
      EXPECT_NEAR(drawn, grey * steradians / all, 16 * 0x1p-24); // a quantum for each of a row, and of the rows
      for (std::size_t c = 0; c < 3; ++c) {
        const double colour = static_cast<double>(tables.texel_colour[3 * texel + c]);
        EXPECT_NEAR(drawn * colour, static_cast<double>(map.rgb[3 * texel + c]) * steradians / all,
                    1e-7 * drawn * colour);
        EXPECT_LE(colour, 3 * 1.01);
      }
    }
}

// Half of the light in one texel of 2^40 times the others': these are still drawn, and carry as little as they have.
TEST(SkyTables, NothingIsLostBesideASun) {
  std::vector<float> rgb(3 * 32 * 16, 1e-6f);
  rgb[0] = rgb[1] = rgb[2] = 1e12f;
  const scene::Environment map = map_of(32, rgb);
  const tracing::SkyTables tables = tracing::make_sky_tables(map);
  constexpr std::size_t size = 16 + 32 * 16;
  for (std::size_t i = 0; i < size; ++i)
    EXPECT_GT(tables.texel_cdf[i], i == 0 || (i >= 16 && (i - 16) % 32 == 0) ? 0 : tables.texel_cdf[i - 1]);
  EXPECT_EQ(tables.texel_cdf[size], 1) << "its row is all of the peaks";
  for (std::size_t i = 3; i < tables.texel_colour.size(); ++i) {
    EXPECT_GT(tables.texel_colour[i], 0);
    EXPECT_LT(tables.texel_colour[i], 1e-6f);
  }
}

} // namespace nephroid::scene::scene_light_test
