// SPDX-License-Identifier: Apache-2.0
// Absolute radiometry: what each light sends, what reaches a surface and what the camera makes of it, against closed
// forms; photons of a large area light; where photons end. tests/images/shipped_presets_test.cpp looks at the balance
// of every preset, `nephroid check` at a point light.
#include "spectral/settings.h"
#include "tests/support/closed_form.h"
#include "tests/support/passes.h"

namespace nephroid::radiometry_test {

/// A floor seen from straight above, a light above it, and nothing or a sheet of "glass" with n = 1 between them.
/// The floor is the plane y = 0, reflectance 1; the camera is at height 2 and sees 1 m x 1 m of it.
/// Direct light, of so many passes.
preset::Preset floor_preset(int passes) {
  preset::Preset p = empty_preset(32);
  spectral::settings(p).direct = true;
  p.stop.passes = passes;
  p.scene.camera.position = {0, 2, 0};
  p.scene.camera.target = {0, 0, 0};
  p.scene.camera.up = {0, 0, -1};
  p.scene.camera.fov_deg = 2 * std::atan(0.5 / 2) * 180 / M_PI;
  p.scene.materials["white"] = white();
  p.scene.materials["nothing"] = glass(1);
  p.scene.objects.push_back(object("floor", quad(10, 10), "white"));
  p.scene.lights = {{.spectrum = {.illuminant = "E"}, .power_w = 5, .position = {0.1, 1, -0.2}}};
  return p;
}

/// The colour of radiance E / pi at floor point (x, z), for the light's spectrum of unit sum.
double irradiance_of_point(const preset::Light& light, double intensity, double x, double z) {
  const double dx = light.position[0] - x, dy = light.position[1], dz = light.position[2] - z;
  const double d2 = dx * dx + dy * dy + dz * dz;
  return intensity * dy / std::sqrt(d2) / d2;
}

/// Mean over the pixels of the ratio picture / truth for the luminance, and the root mean square of the ratio's
/// deviation.
struct Ratio {
  double mean = 0, rms = 0;
};
template <class Truth>
Ratio compare(const job::Snapshot& snapshot, const std::string& name, const Truth& irradiance) {
  const int size = snapshot.picture->width;
  const double y_of_light = optics::to_xyz(optics::illuminant("E"))[1];
  const job::Layer& picture = layer(snapshot, name);
  Ratio ratio;
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const double y = check::luminance(picture, size, row, column);
      // The mean over a pixel of a smooth function is its value at the centre up to second order, below 1e-4 here.
      const double x = (column + 0.5) / size - 0.5, z = (row + 0.5) / size - 0.5;
      const double r = y / (irradiance(x, z) / M_PI * y_of_light);
      ratio.mean += r / (size * size);
      ratio.rms += (r - 1) * (r - 1) / (size * size);
    }
  ratio.rms = std::sqrt(ratio.rms);
  return ratio;
}

TEST(Radiometry, DirectLightOfASpotInsideItsCone) {
  preset::Preset p = floor_preset(64);
  preset::Light& light = p.scene.lights[0];
  light.type = preset::Light::Type::spot;
  light.half_angle_deg = 80;
  const double intensity = light.power_w / (2 * M_PI * (1 - std::cos(80 * M_PI / 180)));
  const Ratio r =
      compare(render(p), "direct", [&](double x, double z) { return irradiance_of_point(light, intensity, x, z); });
  expect_truth("radiometry: direct light of a spot over its closed form", r.mean, 1, 1e-3);
}

TEST(Radiometry, DirectLightOfADirectionalLight) {
  preset::Preset p = floor_preset(4);
  preset::Light& light = p.scene.lights[0];
  light.type = preset::Light::Type::directional;
  light.direction = {1, -1, 0};
  light.irradiance_w_m2 = 3;
  const Ratio r = compare(render(p), "direct", [&](double, double) { return 3 / std::sqrt(2.0); });
  expect_truth("radiometry: direct light of a directional light over its closed form", r.mean, 1, 1e-5);
  EXPECT_LT(r.rms, 1e-5);
}

/// The irradiance of a small area light is that of a point of intensity power cos / pi.
TEST(Radiometry, DirectLightOfASmallAreaLight) {
  preset::Preset p = floor_preset(64);
  preset::Light& light = p.scene.lights[0];
  light.type = preset::Light::Type::area;
  light.size = {0.02, 0.02};
  const Ratio r = compare(render(p), "direct", [&](double x, double z) {
    const double d = std::hypot(light.position[0] - x, light.position[1], light.position[2] - z);
    return irradiance_of_point(light, light.power_w / M_PI * light.position[1] / d, x, z);
  });
  expect_truth("radiometry: direct light of a small area light over its closed form", r.mean, 1, 2e-3);
}

// A dielectric of n = 1 bends nothing and reflects nothing, so the photons that crossed it must make the very picture
// that direct light makes. The sheet lies between light and floor and, for the camera, above it: the splat's way to the
// eye is blocked by it, so the camera looks from below the sheet.
class Photons : public testing::TestWithParam<preset::Light::Type> {};

TEST_P(Photons, ThroughNothingMakeTheDirectPicture) {
  preset::Preset p = floor_preset(16);
  spectral::settings(p).direct = false;
  p.scene.objects.push_back(object("sheet", box(8, 0.01, 8), "nothing", at({0, 0.9, 0})));
  p.scene.camera.position = {0, 0.5, 0};
  p.scene.camera.fov_deg = 90;
  preset::Light& light = p.scene.lights[0];
  light.type = GetParam();
  light.half_angle_deg = 75;
  light.direction = {0.3, -1, 0.2};
  light.irradiance_w_m2 = 7;
  light.size = {0.01, 0.01};
  light.up = {0, 0, 1};
  spectral::settings(p).photons_per_pass = 1 << 18;
  const double cone = 2 * M_PI * (1 - std::cos(75 * M_PI / 180));
  const double length = std::hypot(0.3, 1, 0.2);
  const auto truth = [&](double x, double z) {
    const double d = std::hypot(light.position[0] - x, light.position[1], light.position[2] - z);
    const double cos_light =
        -((x - light.position[0]) * -0.3 + light.position[1] * -1.0 + (z - light.position[2]) * -0.2) / (d * length);
    switch (GetParam()) {
    case preset::Light::Type::spot: return irradiance_of_point(light, light.power_w / cone, x, z);
    case preset::Light::Type::directional: return 7 / length;
    default: break;
    }
    return irradiance_of_point(light, light.power_w / M_PI * cos_light, x, z);
  };
  const job::Snapshot snapshot = render(p);
  const Ratio r = compare(snapshot, "caustic", truth);
  // The fewest photons land under directional light: 2^22 on the 100 m^2 of the sheet's bounding disc, so 41 a pixel,
  // which is 16 % noise, and 0.5 % for the mean over all pixels; the rms over 1024 pixels is then known to 0.4 %. Six
  // standard deviations of each.
  expect_truth("radiometry: power through n = 1 over direct light", r.mean, 1, 0.031);
  EXPECT_LT(r.rms, 0.185);
  const photons::EnergyBalance e = photons::energy_of(snapshot);
  EXPECT_EQ(e.refused_contributions, 0u);
  // A path through the sheet has three segments, one past it has one. Photons of parallel light have the same power.
  if (GetParam() == preset::Light::Type::directional) {
    EXPECT_NEAR(job::scalar(snapshot, "paths", "segments_per_photon"), 3 - 2 * e.missed_w / e.emitted_w, 1e-6);
  }
}

std::string light_name(const testing::TestParamInfo<preset::Light::Type>& parameter) {
  static const char* const names[] = {"point", "spot", "directional", "area"};
  return names[static_cast<int>(parameter.param)];
}

INSTANTIATE_TEST_SUITE_P(Lights, Photons,
                         testing::Values(preset::Light::Type::spot, preset::Light::Type::directional,
                                         preset::Light::Type::area),
                         light_name);

/// The part of a disc's light that passes an edge, `t` of its radius beyond the edge's shadow by the middle.
double part_of_disc(double t) {
  if (std::abs(t) >= 1) return t > 0 ? 1 : 0;
  return 0.5 + (t * std::sqrt(1 - t * t) + std::asin(t)) / M_PI;
}

// Light of a disc of 10 degrees straight down past an edge that is .8 m above the floor: its shadow fades over 2 * .8
// tan(5 degrees) = .14 m. Direct light, and photons through a sheet of n = 1 above the edge.
TEST(Radiometry, ADiscHasItsPenumbra) {
  for (const bool photons : {false, true}) {
    SCOPED_TRACE(photons);
    preset::Preset p = floor_preset(photons ? 64 : 2048);
    p.scene.camera.position = {0, 0.5, 0};
    p.scene.camera.fov_deg = 90;
    p.scene.objects.push_back(object("edge", quad(4, 8), "white", at({2, 0.8, 0})));
    if (photons) p.scene.objects.push_back(object("sheet", box(3, 0.01, 3), "nothing", at({0, 0.9, 0})));
    preset::Light& light = p.scene.lights[0];
    light.type = preset::Light::Type::directional;
    light.direction = {0, -1, 0};
    light.angular_diameter_deg = 10;
    spectral::settings(p).direct = !photons;
    spectral::settings(p).caustic = photons;
    spectral::settings(p).photons_per_pass = 1 << 18;
    const job::Snapshot snapshot = render(p);
    const job::Layer& picture = layer(snapshot, photons ? "caustic" : "direct");
    const double full = optics::to_xyz(optics::illuminant("E"))[1] / M_PI, radius = 0.8 * std::tan(5 * M_PI / 180);
    double worst = 0, mean = 0;
    for (int column = 0; column < 32; ++column) {
      double y = 0, truth = 0; // means over the column
      for (int row = 0; row < 32; ++row) y += check::luminance(picture, 32, row, column) / (32 * full);
      for (int i = 0; i < 16; ++i) truth += part_of_disc(-((column + (i + 0.5) / 16) / 32 - 0.5) / radius) / 16;
      worst = std::max(worst, std::abs(y - truth));
      mean += (y - truth) / 32;
    }
    // 2^24 photons on the 14 m^2 of the sheet's disc are 37000 a column, which is .5 % of it.
    expect_truth(photons ? "disc: photons' penumbra, worst column" : "disc: direct penumbra, worst column", worst, 0,
                 photons ? 0.03 : 0.01);
    expect_truth(photons ? "disc: photons' light" : "disc: direct light", mean, 0, 0.004);
  }
}

/// A floor below a panel of 1.6 m by 1.6 m at height 1, seen from half that height; with or without a sheet of n = 1
/// under the panel.
preset::Preset floor_under_a_panel(bool sheet) {
  preset::Preset p = empty_preset(8);
  p.scene.materials = {{"white", white()}, {"nothing", glass(1)}};
  p.scene.objects = {object("floor", quad(10, 10), "white")};
  if (sheet) p.scene.objects.push_back(object("sheet", box(8, 0.01, 8), "nothing", at({0, 0.9, 0})));
  p.scene.lights = {{.type = preset::Light::Type::area,
                     .spectrum = {.illuminant = "E"},
                     .position = {0.3, 1, -0.4},
                     .size = {1.6, 1.6}}};
  p.scene.camera.position = {0, 0.5, 0};
  p.scene.camera.target = {0, 0, 0};
  p.scene.camera.up = {0, 0, -1};
  p.scene.camera.fov_deg = 90;
  spectral::settings(p).direct = !sheet;
  spectral::settings(p).caustic = sheet;
  spectral::settings(p).pixel_samples = 1024;
  spectral::settings(p).photons_per_pass = 1 << 18;
  p.stop.passes = sheet ? 4 : 1024;
  return p;
}

// What crossed the sheet is the light itself, so its picture is the one that direct light makes, whose places on the
// panel are drawn by other code. A pixel has 1024 samples there, which are 1 % of noise, and some 2000 photons here, 3
// %.
TEST(AreaLight, PhotonsMakeTheDirectPictureOfALargePanel) {
  const job::Snapshot direct = render(floor_under_a_panel(false)), photons = render(floor_under_a_panel(true));
  const std::vector<float>&truth = layer(direct, "direct").rgb, &picture = layer(photons, "caustic").rgb;
  double mean = 0, worst = 0;
  for (std::size_t i = 0; i < truth.size(); i += 3) {
    const auto luminance = [&](const std::vector<float>& rgb) {
      return optics::linear_srgb_to_xyz({rgb[i], rgb[i + 1], rgb[i + 2]})[1];
    };
    const double ratio = luminance(picture) / luminance(truth);
    mean += ratio / 64;
    worst = std::max(worst, std::abs(ratio - 1));
  }
  EXPECT_NEAR(mean, 1, 0.03);
  EXPECT_LT(worst, 0.25);
}

/// Of a surface element under a parallel panel at `height`, the part of the hemisphere, weighed by the cosine, that the
/// panel's corner fills between the foot of the perpendicular and a by b aside of it (Howell's catalogue of view
/// factors, B-4).
double corner_factor(double a, double b, double height) {
  const double u = std::hypot(a, height), v = std::hypot(b, height);
  return (a / u * std::atan(b / u) + b / v * std::atan(a / v)) / (2 * M_PI);
}

/// Irradiance of the floor at (x, z): the panel's exitance times its view factor, corner by corner.
double irradiance(const preset::Light& panel, double x, double z) {
  const double right = panel.position[0] + panel.size[0] / 2 - x, far = panel.position[2] + panel.size[1] / 2 - z,
               h = panel.position[1];
  const double left = right - panel.size[0], near = far - panel.size[1];
  const double factor = corner_factor(right, far, h) - corner_factor(left, far, h) - corner_factor(right, near, h) +
                        corner_factor(left, near, h);
  return panel.power_w / (panel.size[0] * panel.size[1]) * factor;
}

/// The power on every pixel's square of the floor, and on all together. The midpoint rule over 16 parts of a pixel each
/// way is off by 1e-4 of it at most.
std::vector<double> power_on(const Screen& screen, const preset::Light& panel) {
  constexpr int parts = 16;
  std::vector<double> power(screen.count() + 1, 0.0);
  for (std::size_t i = 0; i < screen.count(); ++i) {
    const auto row = static_cast<int>(i) / screen.pixels, column = static_cast<int>(i) % screen.pixels;
    for (int k = 0; k < parts * parts; ++k)
      power[i] += irradiance(panel, screen.x(column) + ((k % parts + 0.5) / parts - 0.5) * screen.pixel_side(),
                             screen.z(row) + ((k / parts + 0.5) / parts - 0.5) * screen.pixel_side());
    power[i] *= screen.pixel_area() / (parts * parts);
    power.back() += power[i];
  }
  return power;
}

/// The same as `runs` short runs have it, each with a seed of its own. Their sequences are independent, so their
/// scatter says how well the mean is known.
std::vector<Estimate> rendered_power(preset::Preset p, const Screen& screen, int runs) {
  std::vector<Estimate> figures(screen.count() + 1);
  for (int run = 1; run <= runs; ++run) {
    p.seed = static_cast<std::uint64_t>(run);
    std::vector<double> power = watts(render(p), "caustic", screen, spectrum_of(p.scene.lights[0]));
    power.push_back(std::accumulate(power.begin(), power.end(), 0.0));
    for (std::size_t i = 0; i < power.size(); ++i) { // Welford's sums
      const double off = power[i] - figures[i].mean;
      figures[i].mean += off / run;
      figures[i].variance += off * (power[i] - figures[i].mean);
    }
  }
  for (Estimate& e : figures) {
    e.variance /= double(runs) * (runs - 1);
    e.degrees = runs - 1;
  }
  return figures;
}

TEST(AreaLight, LowDiscrepancyPhotonsMakeThePanelsIrradiance) {
  preset::Preset p = floor_under_a_panel(true);
  p.scene.lights[0].spectrum = line(550);
  const Screen screen{{0, 0, 0}, 1, 4};
  screen.fill(p.scene.camera, 0.5);
  spectral::settings(p).low_discrepancy = true;
  spectral::settings(p).photons_per_pass = 1 << 15;
  p.stop.passes = 2;
  const std::vector<Estimate> figures = rendered_power(p, screen, 32);
  const std::vector<double> truth = power_on(screen, p.scene.lights[0]);
  double smallest = 1, widest = 0;
  for (std::size_t i = 0; i < figures.size(); ++i) {
    smallest = std::min(smallest, p_value(figures[i], truth[i], 1e-4 * truth[i]));
    widest = std::max(widest, tolerance(figures[i]) / truth[i]);
  }
  EXPECT_GT(sidak(smallest, static_cast<double>(figures.size())), false_alarm);
  EXPECT_LT(widest, 0.3);
  record("area light, low discrepancy: power on the floor over its truth", figures.back().mean / truth.back(), 1,
         tolerance(figures.back()) / truth.back());
  record("area light, low discrepancy: tolerance of a sixteenth of the floor", widest, 0, 0.3);
}

bool is_balanced(const photons::EnergyBalance& e) {
  const double parts = e.deposited_w + e.missed_w + e.absorbed_w + e.escaped_w + e.lost_w;
  return std::abs(parts - e.emitted_w) <= 1e-12 * e.emitted_w;
}

// The same photons (one seed) in the open and in a room: what escaped there lands on the room's walls here, and nothing
// else changes. A balance that only counted each photon once, wherever it went, would not notice a photon that ends in
// the wrong place.
TEST(Energy, WhatEscapesIsWhatARoomCatches) {
  preset::Preset p = empty_preset(16);
  p.scene.materials["glass"] = glass(1.8);
  p.scene.materials["mirror"].type = preset::Material::Type::mirror;
  p.scene.materials["white"] = white();
  const preset::Shape stone{.type = preset::Shape::Type::brilliant};
  p.scene.objects = {object("stone", stone, "glass", at({0, 0, 0}, {20, 0, 30})),
                     object("mirror", quad(1, 1), "mirror", at({1, 0, 0}, {0, 0, 70})),
                     object("floor", quad(2, 2), "white", at({0, -1, 0}))};
  p.scene.lights = {{.position = {0.3, 2, 0.4}}};
  spectral::settings(p).photons_per_pass = 1 << 16;
  const photons::EnergyBalance open = photons::energy_of(render(p));
  preset::Shape walls = box(8, 8, 8);
  walls.inwards = true;
  p.scene.objects.push_back(object("room", walls, "white"));
  const photons::EnergyBalance room = photons::energy_of(render(p));
  EXPECT_TRUE(is_balanced(open) && is_balanced(room));
  EXPECT_GT(open.escaped_w, 0.3 * open.emitted_w);
  EXPECT_EQ(room.escaped_w, 0);
  // Another tree of triangles rounds hits otherwise: a photon in some ten thousand may take another way.
  const double few = 1e-4;
  expect_truth("energy: caught by a room / deposited or escaped in the open",
               room.deposited_w / (open.deposited_w + open.escaped_w), 1, few);
  expect_truth("energy: emitted, in a room / in the open", room.emitted_w / open.emitted_w, 1, few);
  expect_truth("energy: absorbed by the mirror, in a room / in the open", room.absorbed_w / open.absorbed_w, 1, few);
  expect_truth("energy: passed by the glass, in a room / in the open", room.missed_w / open.missed_w, 1, few);
}

} // namespace nephroid::radiometry_test
