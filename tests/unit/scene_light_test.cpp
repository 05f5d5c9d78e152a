// SPDX-License-Identifier: Apache-2.0
// What a loaded scene has on the 401 wavelengths: lights with their figures and spectra, materials of every kind.
#include "scene/materials.h"
#include "tests/support/loaded_scenes.h"

namespace nephroid::scene::scene_light_test {

TEST(SceneLight, AreaLightHasItsEdges)
{
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
  EXPECT_THAT(load_scene(preset).warnings, ElementsAre(HasSubstr("light 0: reaches through the surface of a dielectric")));
}

TEST(SceneLight, LightsKeepTheirFigures)
{
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

TEST(SceneLight, MaterialsOnTheWavelengths)
{
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
  EXPECT_EQ(scene.materials[1].type, Material::Type::mirror);
  EXPECT_DOUBLE_EQ(scene.materials[1].reflectance[200], 0.8);
  EXPECT_DOUBLE_EQ(scene.materials[2].reflectance[0], 0.25);
}

TEST(SceneLight, EveryKindOfDispersionSpectrumAndReflectance)
{
  const FileFinder finder;
  const auto index_at = [&](const preset::Dispersion& d, double nm) { return *make_curve(d, finder, "w").sample(nm).n; };
  preset::Dispersion d;
  d.n = 1.33;
  EXPECT_DOUBLE_EQ(index_at(d, 500), 1.33);
  d.type = preset::Dispersion::Type::cauchy;
  d.coefficients = {1.5, 0.01}; // 1.5 + 0.01 / 0.25 at 500 nm
  EXPECT_NEAR(index_at(d, 500), 1.54, 1e-12);
  d.type = preset::Dispersion::Type::table;
  d.table = {{400, 1.6}, {600, 1.5}};
  EXPECT_NEAR(index_at(d, 450), 1.575, 1e-12);
  d.type = preset::Dispersion::Type::points;
  EXPECT_NEAR(index_at(d, 600), 1.5, 1e-12);

  preset::LightSpectrum s;
  s.type = preset::LightSpectrum::Type::lines;
  s.table = {{500, 3}, {600.5, 1}};
  const optics::Spectrum lines = make_light_spectrum(s, "w");
  EXPECT_NEAR(lines[120], 0.75, 1e-12);
  EXPECT_NEAR(lines[220], 0.125, 1e-12);
  s.type = preset::LightSpectrum::Type::table;
  s.table = {{380, 1}, {780, 1}};
  EXPECT_NEAR(make_light_spectrum(s, "w")[7], 1.0 / 401, 1e-15);
  s.type = preset::LightSpectrum::Type::blackbody;
  s.temperature_k = 3000;
  EXPECT_GT(make_light_spectrum(s, "w")[400], 5 * make_light_spectrum(s, "w")[0]); // reddish

  preset::Reflectance r;
  r.type = preset::Reflectance::Type::table;
  r.table = {{400, 0}, {600, 1}};
  EXPECT_NEAR(make_reflectance(r, "w")[120], 0.5, 1e-12);
  r.type = preset::Reflectance::Type::patch;
  r.patch = "blue sky";
  EXPECT_GT(make_reflectance(r, "w")[450 - 380], make_reflectance(r, "w")[650 - 380]);

  EXPECT_EQ(outside_policy(preset::Outside::automatic), optics::Outside::automatic);
  EXPECT_EQ(outside_policy(preset::Outside::hold), optics::Outside::hold);
  EXPECT_EQ(outside_policy(preset::Outside::extrapolate), optics::Outside::extrapolate);
  EXPECT_EQ(outside_policy(preset::Outside::refuse), optics::Outside::refuse);
}

} // namespace nephroid::scene::scene_light_test
