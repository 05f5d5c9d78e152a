// SPDX-License-Identifier: Apache-2.0
// The clear sky and its sun: where the sun is, against published positions; the model against its closed form; the map
// against its lights.
#include "preset/read.h"
#include "run/night.h"
#include "run/prepare.h"
#include "scene/scene.h"
#include "scene/sky.h"
#include "tests/support/loaded_scenes.h"

#include <numeric>

namespace nephroid::scene::sky_test {

using preset::PlaceAndTime;

preset::Environment sky_of(const glm::dvec3& to_sun) {
  preset::Environment sky;
  sky.type = preset::Environment::Type::sky;
  sky.sun_direction = to_vec3(to_sun);
  return sky;
}

/// Meeus, "Astronomical Algorithms" (2nd edition), example 25.a: 1992 October 13, 0h TD: declination -7.78507 degrees,
/// right ascension 198.38083. Below the pole the elevation is the declination.
TEST(Sky, SunsDeclinationIsThatOfMeeus) {
  const SunPlace pole = sun_place({.latitude_deg = 90, .date = "1992-10-13", .hour = 0});
  EXPECT_NEAR(pole.elevation_deg, -7.78507, 0.02);
}

/// Reda and Andreas, "Solar position algorithm" (NREL/TP-560-34302), appendix A.5: 39.742476 N, 105.1786 W,
/// 2003-10-17, 12:30:30 at UTC-7: topocentric zenith 50.11162 with refraction (.0164 degrees there), azimuth 194.34024.
TEST(Sky, SunIsWhereNrelHasIt) {
  const SunPlace sun = sun_place({.latitude_deg = 39.742476,
                                  .longitude_deg = -105.1786,
                                  .date = "2003-10-17",
                                  .hour = 12 + 30.0 / 60 + 30.0 / 3600,
                                  .utc_offset_h = -7});
  EXPECT_NEAR(sun.elevation_deg, 90 - 50.11162 - 0.0164, 0.02);
  EXPECT_NEAR(sun.azimuth_deg, 194.34024, 0.03);
}

TEST(Sky, NorthIsMinusZAndEastIsPlusX) {
  expect_near(glm::vec3(to_sky({0, 0})), {0, 0, -1}, 1e-6);
  expect_near(glm::vec3(to_sky({0, 90})), {1, 0, 0}, 1e-6);
  expect_near(glm::vec3(to_sky({90, 17})), {0, 1, 0}, 1e-6);
  // In the morning the sun is in the east, and at noon in the south of a northern place.
  const SunPlace morning = sun_place({.latitude_deg = 50, .date = "2026-06-21", .hour = 7});
  EXPECT_GT(to_sky(morning).x, 0.5);
  EXPECT_NEAR(sun_place({.latitude_deg = 50, .date = "2026-06-21", .hour = 12}).azimuth_deg, 180, 2);
}

TEST(Sky, DaysAreCounted) {
  EXPECT_EQ(preset::days_since_2000("2000-01-01"), 0);
  EXPECT_EQ(preset::days_since_2000("1999-12-31"), -1);
  EXPECT_EQ(preset::days_since_2000("2001-01-01"), 366);
  for (const char* const none : {"2026-02-31", "2026-13-01", "1949-12-31", "2026-6-21", "2026-06-2x", "", "-026-01-01"})
    EXPECT_EQ(preset::days_since_2000(none), std::nullopt) << none;
}

/// Preetham et al. 1999, appendix A.2, by hand for a turbidity of 3 and a sun 60 degrees high: chi = (4/9 - 1/40)
/// (pi - pi/3) = .878491, and 7.1649 tan(chi) + 1.7727 = 10.4152 kcd/m^2.
TEST(Sky, ZenithIsThatOfPreetham) {
  const auto [x, y, luminance] = sky_xyy(0, 30, 30, 3);
  const double chi = (4.0 / 9 - 3.0 / 120) * (M_PI - M_PI / 3);
  EXPECT_NEAR(luminance * 683, 1000 * (7.1649 * std::tan(chi) + 1.7727), 0.1);
  const double s = M_PI / 6;
  EXPECT_NEAR(x,
              9 * (0.00166 * s * s * s - 0.00375 * s * s + 0.00209 * s) +
                  3 * (-0.02903 * s * s * s + 0.06377 * s * s - 0.03202 * s + 0.00394) + 0.11693 * s * s * s -
                  0.21196 * s * s + 0.06052 * s + 0.25886,
              1e-12);
  EXPECT_NEAR(y, 0.25, 0.03); // blue: D65 has .329
  // Perez's shape: brighter about the sun and at the horizon than across from the sun.
  EXPECT_GT(sky_xyy(30, 5, 30, 3)[2], 2 * sky_xyy(30, 60, 30, 3)[2]);
  EXPECT_GT(sky_xyy(88, 90, 30, 3)[2], sky_xyy(45, 90, 30, 3)[2]);
}

/// Outside the air 380 to 780 nm have 640 W/m^2 of 1353 (Thekaekara). One air mass of clean air leaves some 80 %; haze
/// and a low sun leave less and redder light.
TEST(Sky, SunIsWeakenedByItsAir) {
  const auto sum = [](const optics::Spectrum& s) { return std::accumulate(s.begin(), s.end(), 0.0); };
  const double high = sum(sun_irradiance(90, 2)), low = sum(sun_irradiance(5, 2)), hazy = sum(sun_irradiance(90, 6));
  EXPECT_NEAR(high, 0.8 * 640, 50);
  EXPECT_LT(hazy, 0.8 * high);
  EXPECT_LT(low, 0.5 * high);
  const auto red_over_blue = [](const optics::Spectrum& s) { return s[650 - 380] / s[450 - 380]; };
  EXPECT_GT(red_over_blue(sun_irradiance(5, 2)), 3 * red_over_blue(sun_irradiance(90, 2)));
  // At 500 nm, one air mass (m = .99934), turbidity 3: by hand.
  const double m = 1 / (1 + 0.15 * std::pow(93.885, -1.253));
  const double depth =
      m * (0.008735 * std::pow(0.5, -4.08) + (0.04608365822 * 3 - 0.04586025929) * std::pow(0.5, -1.3) + 0.35 * 0.03);
  EXPECT_NEAR(sun_irradiance(90, 3)[500 - 380], 1.942 * std::exp(-depth), 1e-6);
}

TEST(Sky, MapIsTheModelAndItsGround) {
  const glm::dvec3 to_sun = to_sky({40, 120});
  const Environment map = make_sky(sky_of(to_sun));
  ASSERT_EQ(map.width, sky_width);
  // The brightest texel is the sun's, and the ground is one colour: albedo / pi times its irradiance.
  std::size_t brightest = 0;
  glm::dvec3 irradiance(0);
  for (int row = 0; row < map.height / 2; ++row)
    for (int column = 0; column < map.width; ++column) {
      const std::size_t texel = static_cast<std::size_t>(row * map.width + column);
      if (grey(map, texel) > grey(map, brightest)) brightest = texel;
      for (int c = 0; c < 3; ++c)
        irradiance[c] += texel_steradians(map, row) * std::cos(M_PI * (row + 0.5) / map.height) *
                         map.rgb[3 * texel + static_cast<std::size_t>(c)];
    }
  EXPECT_NEAR(180.0 * (static_cast<double>(brightest / sky_width) + 0.5) / sky_height, 50, 3);
  EXPECT_NEAR(360.0 * (static_cast<double>(brightest % sky_width) + 0.5) / sky_width - 180, 120, 1);
  const Light sun = make_sun(sky_of(to_sun)).value();
  const optics::Colour direct = optics::xyz_to_linear_srgb(optics::to_xyz(sun.spectrum));
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(map.rgb[map.rgb.size() - 3 + c],
                0.2 / M_PI * (irradiance[static_cast<int>(c)] + sun.irradiance_w_m2 * to_sun.y * direct[c]),
                1e-4 * map.rgb[map.rgb.size() - 3 + c]);
}

TEST(Sky, SunIsALightOfTheScene) {
  preset::Preset preset = ball_over_floor();
  preset.scene.environment = sky_of(to_sky({30, 90}));
  preset.scene.environment->rotate_deg = 90; // from the east to the north
  preset.scene.environment->lights = true;
  const Scene scene = load_scene(preset);
  ASSERT_EQ(scene.lights.size(), 3); // the preset's, the sun, the sky
  const Light& sun = scene.lights[1];
  expect_near(-sun.direction, glm::vec3(to_sky({30, 0})), 1e-6);
  EXPECT_NEAR(sun.one_minus_cos, 1 - std::cos(0.533 / 2 * M_PI / 180), 1e-12);
  EXPECT_NEAR(std::accumulate(sun.spectrum.begin(), sun.spectrum.end(), 0.0), 1, 1e-12);
  EXPECT_THAT(scene.environment->about, HasSubstr("30.00 degrees high at azimuth 90.00"));
  preset.scene.environment->sun_scale = 0;
  EXPECT_EQ(load_scene(preset).lights.size(), 2);
}

TEST(Sky, IsDarkAtNight) {
  preset::Preset preset = ball_over_floor();
  preset::Environment& night = preset.scene.environment.emplace(sky_of({0, -1, 1}));
  night.lights = true;
  const Scene scene = load_scene(preset);
  EXPECT_THAT(scene.lights, SizeIs(1)) << "the preset's";
  EXPECT_TRUE(scene.environment->is_black());
  EXPECT_EQ(scene.environment->about, "the sun is 45.0 degrees below the horizon: the sky is dark");
  night.sun_direction.reset();
  night.place = PlaceAndTime{.latitude_deg = 50, .date = "2026-06-21", .hour = 0};
  EXPECT_THAT(make_sky(night).about, HasSubstr("16.6 degrees below"));
  EXPECT_FALSE(make_sun(night));
}

/// Antwerp: the sun rises at 5:34 and sets at 21:55, without air.
constexpr const char* midsummer = R"({"engine": "spectral", "scene": {"environment": {"type": "sky", "place": {
  "latitude_deg": 51.22, "longitude_deg": 4.4, "date": "2026-06-21", "hour": 19, "utc_offset_h": 2}}})";
constexpr const char* whole_day = R"(animation={"frames": 19, "tracks": [
  {"path": "scene.camera.fov_deg", "keys": [{"frame": 0, "value": 30}]},
  {"path": "scene.environment.place.hour", "keys": [{"frame": 0, "value": 4}, {"frame": 18, "value": 22}]}]})";

TEST(Sky, NightIsSaidWithWhoMadeIt) {
  const auto preset_of = [](const preset::Overrides& overrides) {
    return preset::parse_preset(std::string(midsummer) + "}", "day.json", overrides);
  };
  EXPECT_EQ(run::night_note(preset_of({})), "");
  EXPECT_EQ(run::night_note(preset_of({"scene.environment.place.hour=3"})),
            "--set scene.environment.place.hour=3: the sun is below the horizon: the sky, which knows no twilight, is "
            "dark; for light choose another hour, or look at the offset from UTC");
  const preset::Preset day = preset_of({whole_day});
  EXPECT_THAT(run::night_note(day), HasSubstr("in the frames 0-1, 18: the sky"));
  EXPECT_THAT(run::prepare(day).plan->notes, Contains(run::night_note(day)));
  EXPECT_EQ(run::by_day(day).scene.environment->place->hour, 6);
  EXPECT_EQ(run::by_day(preset_of({})).scene.environment->place->hour, 19);
  const preset::Preset of_file = preset::parse_preset(
      std::string(midsummer) + ", \"animation\": " + std::string(whole_day).substr(10) + "}", "day.json");
  EXPECT_THAT(run::night_note(of_file), StartsWith("day.json#/animation/tracks/1: the sun"));
}

} // namespace nephroid::scene::sky_test
