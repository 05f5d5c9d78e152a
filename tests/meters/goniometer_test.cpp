// SPDX-License-Identifier: Apache-2.0
// Goniometers: lamps whose intensities are known, alone and behind a plate, and the files that say so.
#include "base/files.h"
#include "meters/luminaire.h"
#include "preset/read.h"
#include "run/meters.h"
#include "scene/photometry.h"
#include "scene/scene.h"
#include "tests/support/presets.h"
#include "tests/support/render.h"

#include <cmath>

namespace nephroid::goniometer_test {

using meters::Quantity;

/// A scene of a lamp, given as JSON, and perhaps objects, with a goniometer.
preset::Preset lamp_preset(const std::string& lamp, const std::string& objects = "", const std::string& folder = "") {
  return preset::parse_preset(R"({"engine": "spectral", "unit": "m", "scene": {
    "materials": {"glass": {"type": "dielectric", "dispersion": 1.5}}, "objects": [)" +
                                  objects + R"(], "lights": [)" + lamp +
                                  R"(], "meters": [{"type": "goniometer", "name": "far", "step_deg": 5}]}})",
                              folder + "lamp.json");
}

struct Measured {
  scene::MeterSurface surface;
  meters::Reading reading;
  preset::Meter meter;
  /// W/sr
  double at(double gamma_deg, double c_deg) const {
    std::vector<double> values;
    for (const meters::Interval& cell : reading.all().cells[0]) values.push_back(cell.value);
    return scene::at_direction(surface, values, {gamma_deg, c_deg});
  }
};

Measured measured(const preset::Preset& p, int cycles = 4) {
  run::Metering metering(run::prepare(p), {shared_context(), Communicator(nullptr)});
  const run::MeterInHand& meter = metering.meters()[0];
  while (meter.run->cycles() < cycles || !meter.reading) metering.advance();
  return {*meter.surface, *meter.reading, meter.meter};
}

const std::string spot = R"({"type": "spot", "position": [0, 1, 0], "direction": [0, -1, 0], "half_angle_deg": )";

TEST(Goniometer, HasAllDirections) {
  const Measured far = measured(lamp_preset(spot + "30}"));
  double all = 0;
  for (const double steradians : far.surface.steradians) all += steradians;
  EXPECT_NEAR(all, 4 * M_PI, 1e-4);
  for (std::size_t cell = 0; cell < far.surface.count(); cell += 7) {
    std::vector<double> one(far.surface.count(), 0);
    one[cell] = 1;
    EXPECT_GT(scene::at_direction(far.surface, one, scene::direction_of(far.surface, cell)), 0.9) << cell;
  }
}

TEST(Goniometer, ASpotHasItsIntensityInItsCone) {
  const Measured far = measured(lamp_preset(spot + "30}"));
  const meters::Interval total = far.reading.all().numbers(Quantity::irradiance).total;
  EXPECT_NEAR(total.value, 1, std::max(2 * total.half(), 2e-3));
  const double intensity = 1 / (2 * M_PI * (1 - std::cos(M_PI / 6)));
  for (const double c : {0.0, 130.0, 275.0}) EXPECT_NEAR(far.at(20, c), intensity, 0.01 * intensity) << c;
  EXPECT_EQ(far.at(45, 0), 0);
}

// Straight through both faces: (1 - R) / (1 + R) with R = .04, and the rest comes back.
TEST(Goniometer, APlateSendsAPartBack) {
  const std::string plate = R"({"shape": {"type": "plate", "size": [9, 0.1, 9]}, "material": "glass"})";
  const Measured far = measured(lamp_preset(spot + "3}", plate));
  double below = 0, all = 0;
  for (std::size_t cell = 0; cell < far.surface.count(); ++cell) {
    const double watts = far.reading.all().cells[0][cell].value * far.surface.steradians[cell];
    all += watts;
    if (scene::direction_of(far.surface, cell).gamma_deg < 90) below += watts;
  }
  EXPECT_NEAR(all, 1, 2e-3);
  EXPECT_NEAR(below, 0.96 / 1.04, 2e-3);
}

/// What an uneven lamp sends down: nothing goes up.
double uneven(double gamma_deg, double c_deg) {
  const double gamma = gamma_deg * M_PI / 180, c = c_deg * M_PI / 180;
  return (1 + 0.5 * std::sin(gamma) * std::cos(c)) * std::pow(std::cos(gamma), 2);
}

/// Its IES file.
std::string uneven_lamp() {
  std::string text = "IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 19 25 1 2 0 0 0\n1 1 10\n";
  for (int gamma = 0; gamma <= 90; gamma += 5) text += fmt::format("{} ", gamma);
  text += "\n";
  for (int c = 0; c <= 360; c += 15) text += fmt::format("{} ", c);
  for (int c = 0; c <= 360; c += 15) {
    text += "\n";
    for (int gamma = 0; gamma <= 90; gamma += 5) text += fmt::format("{:.6f} ", std::abs(uneven(gamma, c)));
  }
  return text;
}

TEST(Goniometer, WritesTheFileOfALampThatWasRead) {
  const TemporaryFolder folder;
  folder.write("in.ies", uneven_lamp());
  const Measured far = measured(
      lamp_preset(R"({"type": "point", "power_w": 2, "photometry": "in.ies"})", "", folder.path().string() + "/"));
  const double watts_per_unit = 2 / (2 * M_PI / 3); // the integral of uneven() is 2 pi / 3
  const double per_watt = far.reading.all().numbers(Quantity::illuminance).total.value / 2;
  for (const auto& [name, text] :
       {std::pair{"out.ies", scene::ies(meters::luminaire(far.meter, far.surface, far.reading), "test", "lamp")},
        std::pair{"out.ldt",
                  scene::eulumdat(meters::luminaire(far.meter, far.surface, far.reading), "test", "lamp")}}) {
    const scene::Photometry out = scene::load_photometry(folder.write(name, text));
    const double unit = std::string(name) == "out.ies" ? per_watt : 1000.0 / 2;
    for (const double gamma : {5.0, 30.0, 60.0})
      for (const double c : {0.0, 45.0, 90.0, 180.0, 270.0}) {
        const double right = watts_per_unit * uneven(gamma, c);
        EXPECT_NEAR(scene::intensity(out, gamma, c) / unit, right, 0.02 * right + 2e-3) << name << gamma << ' ' << c;
      }
  }
}

// Its candela add up to 2 pi / 3 lm, through a ballast of .9. As EULUMDAT the lumens are those of the goniometer.
TEST(Goniometer, ALampMayHaveItsFilesOwnLumens) {
  const TemporaryFolder folder;
  std::string text = uneven_lamp();
  text.replace(text.find("\n1 1 10\n"), 8, "\n.9 1 10\n");
  folder.write("in.ies", text);
  const auto lumens_of = [&](const std::string& file) {
    const Measured far = measured(lamp_preset(
        R"({"type": "point", "file_lumens": true, "photometry": ")" + file + "\"}", "", folder.path().string() + "/"));
    folder.write("out.ldt", scene::eulumdat(meters::luminaire(far.meter, far.surface, far.reading), "test", "lamp"));
    return far.reading.all().numbers(Quantity::illuminance).total.value;
  };
  const double lumens = lumens_of("in.ies");
  EXPECT_NEAR(lumens, 0.9 * 2 * M_PI / 3, 4e-3 * lumens);
  EXPECT_NEAR(lumens_of("out.ldt"), lumens, 1e-2 * lumens);
  EXPECT_THAT(refusal_of([] { scene::load_scene(lamp_preset(R"({"type": "point", "file_lumens": true})")); }),
              HasSubstr("lights/0/file_lumens: is true without a photometric file"));
}

TEST(Goniometer, HasNoUseForTheSun) {
  preset::Preset p = lamp_preset(R"({"type": "directional", "direction": [0, -1, 0]})");
  EXPECT_THAT(refusal_of([&] {
                run::Metering(run::prepare(p), {shared_context(), Communicator(nullptr)});
              }),
              HasSubstr("is a goniometer where light comes from far away"));
}

TEST(Goniometer, ItsUnitIsOfIntensity) {
  const auto with_unit = [](const std::string& type, const std::string& unit) {
    return refusal_of([&] {
      preset::parse_preset(R"({"engine": "spectral", "scene": {"meters": [{"name": "a", "type": ")" + type +
                               R"(", "unit": ")" + unit + "\"}]}}",
                           "p.json");
    });
  };
  EXPECT_THAT(with_unit("plane", "W/sr"), HasSubstr("unit: is W/sr; expected a unit of light on an area"));
}

} // namespace nephroid::goniometer_test
