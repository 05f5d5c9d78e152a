// SPDX-License-Identifier: Apache-2.0
// Suns of hours, and heat: what the meters of a preset show in them, and weather files.
#include "run/hours.h"

#include "base/files.h"
#include "preset/read.h"
#include "run/map_film.h"
#include "run/meters.h"
#include "tests/support/presets.h"
#include "tests/support/render.h"

#include <numeric>

namespace nephroid::hours_test {

using meters::Interval;
using meters::Quantity;
using preset::Meter;

constexpr std::string_view london = R"({"engine": "spectral", "scene": {
  "environment": {"type": "sky", "lights": true,
    "place": {"latitude_deg": 51.5, "longitude_deg": 0, "date": "2026-06-21", "hour": 12, "utc_offset_h": 0}},
  "meters": [{"type": "point", "name": "level", "position": [0, 1, 0], "normal": [0, 1, 0]}]}})";

preset::Preset london_preset() { return preset::parse_preset(std::string(london), "london.json"); }

Interval measured(const preset::Preset& p, int cycles = 4) {
  run::Metering metering(run::prepare(p), {shared_context(), Communicator(nullptr)});
  while (metering.meters()[0].run->cycles() < cycles || !metering.meters()[0].reading) metering.advance();
  return metering.meters()[0].reading->all().numbers(Quantity::irradiance).mean;
}

double sum(const optics::Spectrum& spectrum) { return std::accumulate(spectrum.begin(), spectrum.end(), 0.0); }

TEST(MeterHours, ALevelPlaneHasAllOfTheSunAndTheSky) {
  const preset::Preset p = london_preset();
  const scene::ClearSky light = scene::clear_sky_of(*p.scene.environment, optics::SpectralRange::solar);
  const double sine = std::sin(scene::sun_place(*p.scene.environment->place).elevation_deg * M_PI / 180);
  const Interval level = measured(p);
  const double right = sine * sum(light.direct) + sum(light.diffuse);
  EXPECT_NEAR(level.value, right, std::max(2 * level.half(), 2e-3 * right));
  EXPECT_NEAR(right, 890, 60) << "a clear noon in June";
}

TEST(MeterHours, WhatIsAssumedBeyondTheVisibleIsSaid) {
  preset::Preset p = london_preset();
  preset::Material& pane = p.scene.materials["pane"];
  pane.type = preset::Material::Type::diffuse;
  pane.reflectance.type = preset::Reflectance::Type::patch;
  pane.reflectance.patch = "red";
  const run::Metering metering(run::prepare(p), {shared_context(), Communicator(nullptr)});
  EXPECT_EQ(metering.range(), optics::SpectralRange::solar);
  EXPECT_THAT(metering.notes(), Contains(HasSubstr("material 'pane': its reflectance is known from 380 to 780 nm")));
  EXPECT_THAT(metering.notes(), Contains(HasSubstr("sun and sky by Bird and Riordan")));
}

TEST(MeterHours, LightThatEndsAtRedIsMeasuredAsItWas) {
  preset::Preset p = london_preset();
  p.scene.environment.reset();
  p.scene.lights.emplace_back();
  p.scene.lights[0].type = preset::Light::Type::directional;
  p.scene.lights[0].direction = {0, -1, 0};
  p.scene.lights[0].irradiance_w_m2 = 5;
  const run::Metering metering(run::prepare(p), {shared_context(), Communicator(nullptr)});
  EXPECT_EQ(metering.range(), optics::SpectralRange::visible);
  p.scene.lights[0].spectrum.type = preset::LightSpectrum::Type::lines;
  p.scene.lights[0].spectrum.table = {{550, 1}, {1064, 3}};
  EXPECT_NEAR(measured(p).value, 20, 0.01) << "5 W/m^2 are of 380 to 780 nm";
}

// The ground sends back a part of the sun's light and of the sky's, each of its own colour.
TEST(MeterHours, TheGroundHasTheColourOfWhatLightsIt) {
  preset::Preset p = london_preset();
  const auto lux = [&](double up) {
    p.scene.meters[0].normal = {0, up, 0};
    run::Metering metering(run::prepare(p), {shared_context(), Communicator(nullptr)});
    while (metering.meters()[0].run->cycles() < 4 || !metering.meters()[0].reading) metering.advance();
    return metering.meters()[0].reading->all().numbers(Quantity::illuminance).mean.value;
  };
  EXPECT_NEAR(lux(-1) / lux(1), 0.2, 0.001);
}

TEST(MeterHours, ADayHasNightsAndAYearItsDays) {
  const preset::PlaceAndTime place = *london_preset().scene.environment->place;
  const run::Hours day = run::hours_of_day(place), year = run::hours_of_year(place, 7);
  ASSERT_EQ(day.hours.size(), 24u);
  const auto sky = [&](int hour) {
    return run::sky_of(*london_preset().scene.environment, place, day.hours[static_cast<std::size_t>(hour)]);
  };
  EXPECT_TRUE(run::is_dark(sky(2)));
  EXPECT_FALSE(run::is_dark(sky(12)));
  EXPECT_EQ(year.hours.size(), 53u * 24);
  for (const int every : {1, 7, 90, 300}) {
    const run::Hours some = run::hours_of_year(place, every);
    EXPECT_NEAR(some.weight_h * static_cast<double>(some.hours.size()), 365 * 24, 1e-6) << every;
  }
  EXPECT_EQ(year.hours[24].date, "2026-01-08");
  EXPECT_EQ(year.hours.back().date, "2026-12-31");
}

// London's clocks go from 0:59 to 2:00 on 29 March 2026, and show 1:00 to 1:59 twice on 25 October.
TEST(MeterHours, OfAChangeAreThoseThatTheClockShows) {
  preset::PlaceAndTime place = *london_preset().scene.environment->place;
  place.utc_offset_h.reset();
  place.time_zone = "Europe/London";
  const auto day = [&](const char* date) {
    place.date = date;
    std::vector<std::pair<double, double>> shown;
    for (const run::Hour& hour : run::hours_of_day(place).hours) shown.emplace_back(hour.hour, hour.utc_offset_h);
    return shown;
  };
  using Shown = std::pair<double, double>;
  const std::vector<Shown> spring = day("2026-03-29"), autumn = day("2026-10-25");
  ASSERT_EQ(spring.size(), 23u);
  EXPECT_EQ(spring[0], Shown(0, 0));
  EXPECT_EQ(spring[1], Shown(2, 1));
  ASSERT_EQ(autumn.size(), 25u);
  EXPECT_EQ(autumn[1], Shown(1, 1));
  EXPECT_EQ(autumn[2], Shown(1, 0));
  const run::Hours year = run::hours_of_year(place, 1);
  EXPECT_EQ(year.hours.size(), 365u * 24);
  EXPECT_EQ(year.weight_h, 1);
  EXPECT_EQ(run::hours_of_year(place, 7).weight_h, 365.0 / 53);
  // The sun of an hour is that of its offset.
  const preset::Environment sky = run::sky_of(*london_preset().scene.environment, place, {"2026-06-21", 13, {}, {}, 1}),
                            utc = *london_preset().scene.environment;
  EXPECT_EQ(scene::sun_place(*sky.place).azimuth_deg, scene::sun_place(*utc.place).azimuth_deg);
}

// Frames have one scale: the brightest hour's. The same cell has another colour in a darker hour.
TEST(MeterHours, FilmsHaveOneScale) {
  const preset::Preset p = london_preset();
  run::Metering metering(run::prepare(p), {shared_context(), Communicator(nullptr)});
  while (!metering.meters()[0].reading) metering.advance();
  const run::MeterInHand& meter = metering.meters()[0];
  meters::Reading dark = *meter.reading;
  for (Interval& cell : dark.layers[0].cells[0]) cell.value /= 4;
  const TemporaryFolder folder;
  const fs::path frames = folder.path() / "level-hours";
  run::MapFilm film;
  film.add(meter.meter, *meter.reading, "2026-06-21  12:00");
  film.add(meter.meter, dark, "2026-06-21  18:00");
  const auto why_not = film.write(frames, folder.path() / "level-hours.mp4", meter.meter, *meter.surface, 1);
  EXPECT_EQ(why_not.has_value(), !fs::exists(folder.path() / "level-hours.mp4"));
  const auto colour = [&](const char* file) {
    const image::Image picture = image::read_image(frames / file);
    const std::size_t middle = static_cast<std::size_t>(picture.height / 2 * picture.width + 100);
    return picture.data[middle * picture.channels.size()];
  };
  EXPECT_GT(colour("frame_0000.png"), 1.5f * colour("frame_0001.png"));
  film.write(frames, folder.path() / "level-hours.mp4", meter.meter, *meter.surface, 1);
  run::MapFilm shorter;
  shorter.add(meter.meter, dark, "2026-06-21  18:00");
  shorter.write(frames, folder.path() / "level-hours.mp4", meter.meter, *meter.surface, 1);
  EXPECT_FALSE(fs::exists(frames / "frame_0001.png")) << "earlier frames go";
}

/// An EPW file of one day, whose sun shines at 13:30 alone, and whose sky shines after sunset, too.
std::string weather_of_a_day() {
  std::string text = "LOCATION,Somewhere,-,-,Made,0,51.5,0.0,1.0,10.0\n";
  for (int i = 0; i < 6; ++i) text += "COMMENT\n";
  text += "DATA PERIODS,1,1,Data,Sunday,1/1,12/31\n";
  for (int hour = 1; hour <= 24; ++hour)
    text += fmt::format("1999,6,21,{},60,?,20,10,50,101300,0,1400,300,500,{},{},0,0,0,0\n", hour, hour == 14 ? 640 : 0,
                        hour == 14   ? 210
                        : hour == 24 ? 3
                                     : 9999);
  return text;
}

class WeatherFile : public testing::Test {
protected:
  TemporaryFolder folder_;

  std::string refusal(const std::string& text) {
    write_file_whole(folder_.path() / "a.epw", text);
    return refusal_of([&] { scene::read_weather(folder_.path() / "a.epw"); });
  }
};

TEST_F(WeatherFile, GivesItsHoursTheirSunAndSky) {
  write_file_whole(folder_.path() / "a.epw", weather_of_a_day());
  const scene::Weather weather = scene::read_weather(folder_.path() / "a.epw");
  const preset::Preset p = london_preset();
  const run::Hours hours = run::hours_of_weather(weather, *p.scene.environment->place, 1);
  EXPECT_EQ(hours.missing, 22);
  EXPECT_EQ(hours.twilight, 1);
  EXPECT_EQ(hours.too_bright, 0);
  ASSERT_EQ(hours.hours.size(), 1u);
  EXPECT_EQ(hours.hours[0].date, "2026-06-21");
  EXPECT_EQ(hours.hours[0].hour, 13.5);
  EXPECT_EQ(hours.place.utc_offset_h, 1);
  EXPECT_EQ(hours.about, "each day of the 1 day of weather of Somewhere") << "it is no year";
  preset::Preset then = p;
  then.scene.environment = run::sky_of(*p.scene.environment, hours.place, hours.hours[0]);
  const double sine = std::sin(scene::sun_place(*then.scene.environment->place).elevation_deg * M_PI / 180);
  const Interval level = measured(then);
  EXPECT_NEAR(level.value, 640 * sine + 210, std::max(2 * level.half(), 1.7));
}

// 1,361 W/m^2 come to the air in the mean of a year. What is more is measured, and counted.
TEST_F(WeatherFile, CountsSunsThatAreBrighterThanAboveTheAir) {
  std::string text = weather_of_a_day();
  text.replace(text.find(",640,"), 5, ",1500,");
  write_file_whole(folder_.path() / "a.epw", text);
  const run::Hours hours = run::hours_of_weather(scene::read_weather(folder_.path() / "a.epw"),
                                                 *london_preset().scene.environment->place, 1);
  EXPECT_EQ(hours.too_bright, 1);
  ASSERT_EQ(hours.hours.size(), 1u);
  EXPECT_EQ(hours.hours[0].direct_w, 1500);
}

TEST_F(WeatherFile, IsRefusedWithItsLine) {
  const std::string whole = weather_of_a_day();
  EXPECT_THAT(refusal("no weather\n"), HasSubstr("line 1: does not begin with LOCATION"));
  EXPECT_THAT(refusal(whole.substr(0, whole.rfind("1999"))), HasSubstr("ends after 23 hours, within a day"));
  std::string gap = whole;
  gap.erase(gap.find("1999,6,21,7"), gap.find("1999,6,21,8") - gap.find("1999,6,21,7"));
  EXPECT_THAT(refusal(gap), HasSubstr("line 15: is of hour 8 after hour 6"));
  std::string month = whole;
  month.replace(month.find("1999,6,21,3"), 11, "1999,13,21,3");
  EXPECT_THAT(refusal(month), HasSubstr("line 11: is of day 21 of month 13"));
  std::string word = whole;
  word.replace(word.find("640"), 3, "sun");
  EXPECT_THAT(refusal(word), HasSubstr("line 22: field 15 is \"sun\""));
  std::string halves = whole;
  halves.replace(halves.find("PERIODS,1,1"), 11, "PERIODS,1,2");
  EXPECT_THAT(refusal(halves), HasSubstr("line 8: says that an hour has 2 parts"));
}

} // namespace nephroid::hours_test
