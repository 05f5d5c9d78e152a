// SPDX-License-Identifier: Apache-2.0
// Light that met glass or a mirror, then several walls, and glass or a mirror again on its way to the eye: a room of
// even light, still water, and rooms whose means Mitsuba knows.
#include "optics/fresnel.h"
#include "spectral/settings.h"
#include "tests/support/closed_form.h"
#include "tests/support/passes.h"

namespace nephroid::whole_light_test {

using Estimator = photons::Settings::Estimator;

/// Mean Y of all layers, or of one, over the picture.
double mean_of(const job::Snapshot& snapshot, const std::string& name = {}) {
  double sum = 0;
  std::size_t pixels = 1;
  for (const job::Layer& layer : snapshot.picture->layers) {
    if (!name.empty() && layer.name != name) continue;
    const std::vector<double> y = luminance(layer);
    pixels = y.size();
    sum += std::accumulate(y.begin(), y.end(), 0.0);
  }
  return sum / static_cast<double>(pixels);
}

/// A preset with all layers.
preset::Preset with_all_light(int resolution, Estimator estimator) {
  preset::Preset p = empty_preset(resolution);
  spectral::settings(p).direct = true;
  spectral::settings(p).indirect = true;
  spectral::settings(p).estimator = estimator;
  spectral::settings(p).max_surfaces = 200;
  spectral::settings(p).photons_per_pass = spectral::settings(p).indirect_photons_per_pass = 1 << 15;
  return p;
}

// ---- Even light

// Walls of reflectance rho that shine with the radiance L, all around: everywhere and in each direction the radiance is
// L / (1 - rho). Glass that absorbs nothing cannot be seen there, nor a perfect mirror.
struct Furnace {
  const char* name;
  Estimator estimator;
  bool mirrors = false, disperses = false;
};

class Furnaces : public testing::TestWithParam<Furnace> {};

TEST_P(Furnaces, NothingCanBeSeen) {
  constexpr double reflectance = 0.8, power = 10, radius = 2;
  preset::Preset p = with_all_light(16, GetParam().estimator);
  p.scene.materials = {{"wall", white(reflectance)}, {"glass", glass(1.5)}, {"mirror", check::mirror(1)}};
  if (GetParam().disperses) {
    p.scene.materials["glass"].dispersion.type = preset::Dispersion::Type::file;
    p.scene.materials["glass"].dispersion.file = "N-SF66.yml";
    p.scene.materials["glass"].absorption = false;
  }
  preset::Shape room = check::ball(radius);
  room.inwards = true;
  preset::Object ball = object("ball", check::ball(0.9), GetParam().mirrors ? "mirror" : "glass", at({0.1, 0, -0.4}));
  ball.normals = preset::Object::Normals::smooth;
  p.scene.objects = {object("room", room, "wall"), ball};
  p.scene.lights = {{.type = preset::Light::Type::mesh,
                     .spectrum = GetParam().disperses ? preset::LightSpectrum{.illuminant = "E"} : line(550),
                     .power_w = power,
                     .object = "room"}};
  p.scene.camera = {.position = {0, 0, 1.6}, .target = {0.1, 0, -0.4}, .fov_deg = 40, .resolution = {16, 16}};
  p.stop.passes = GetParam().estimator == Estimator::sppm ? 4 : 16;
  const auto estimates = render_passes(p, [](const job::Snapshot& snapshot) { return std::vector{mean_of(snapshot)}; });
  const double of_a_watt =
      optics::to_xyz(GetParam().disperses ? optics::illuminant("E") : spectrum_of(p.scene.lights[0]))[1];
  const double truth = power / (4 * M_PI * radius * radius * M_PI) / (1 - reflectance) * of_a_watt;
  expect_truth(std::string("even light in a closed room, ") + GetParam().name, estimates[0].mean / truth, 1,
               2e-3 + tolerance(estimates[0]) / truth);
}

INSTANTIATE_TEST_SUITE_P(Balls, Furnaces,
                         testing::Values(Furnace{"glass_by_points", Estimator::points},
                                         Furnace{"glass_by_sppm", Estimator::sppm},
                                         Furnace{"dispersing_glass", Estimator::points, false, true},
                                         Furnace{"a_mirror", Estimator::points, true}),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

// ---- Still water

// A pool without end, for its sides are perfect mirrors, under a sun that stands theta from the zenith. Of the sun's E
// the floor gets E_1 = E cos(theta) (1 - R(theta)) at first. Of what it sends back, evenly, the surface reflects
//   R_in = 1 - (1 - R_out) / n^2,
// R_out being the mean reflectance for even light from outside (both ways n^2 (1 - R) is the same), so the floor gets
// E_1 rho R_in / (1 - rho R_in) more. Straight from above it is seen by (1 - R(0)) / n^2 of its radiance.
TEST(Pool, HasStillWater) {
  constexpr double n = 4.0 / 3, reflectance = 0.8, theta = 30 * degree;
  preset::Preset p = with_all_light(8, Estimator::points);
  p.scene.materials = {{"floor", white(reflectance)}, {"water", glass(n)}, {"mirror", check::mirror(1)}};
  p.scene.objects = {object("floor", quad(1.1, 1.1), "floor"),
                     object("water", box(1.2, 0.52, 1.2), "water", at({0, 0.24, 0}))};
  for (const double side : {-0.5, 0.5}) {
    p.scene.objects.push_back(
        object(side < 0 ? "left" : "right", quad(1.2, 1.1), "mirror", at({side, 0.55, 0}, {0, 0, 90})));
    p.scene.objects.push_back(
        object(side < 0 ? "back" : "front", quad(1.1, 1.2), "mirror", at({0, 0.55, side}, {90, 0, 0})));
  }
  p.scene.lights = {parallel_light({std::sin(theta) * 0.8, -std::cos(theta), std::sin(theta) * 0.6})};
  p.scene.camera = {.position = {0, 6, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}, .fov_deg = 4, .resolution = {8, 8}};
  p.stop.passes = 32;

  double outside = 0; // R_out, by steps of the sine squared
  constexpr int steps = 100000;
  for (int i = 0; i < steps; ++i)
    outside += optics::fresnel_reflectance(std::sqrt(1 - (i + 0.5) / steps), 1, n) / steps;
  const double inside = 1 - (1 - outside) / (n * n),
               first = std::cos(theta) * (1 - optics::fresnel_reflectance(std::cos(theta), 1, n)),
               seen = (1 - optics::fresnel_reflectance(1, 1, n)) / (n * n) * reflectance / M_PI *
                      optics::to_xyz(spectrum_of(p.scene.lights[0]))[1],
               again = reflectance * inside / (1 - reflectance * inside);
  const auto estimates = render_passes(p, [](const job::Snapshot& snapshot) {
    return std::vector{mean_of(snapshot, "caustic"), mean_of(snapshot, "indirect")};
  });
  expect_truth("a pool, its floor in the sun", estimates[0].mean / (first * seen), 1,
               2e-3 + tolerance(estimates[0]) / (first * seen));
  expect_truth("a pool, what its surface sends back", estimates[1].mean / (first * seen * again), 1,
               2e-3 + tolerance(estimates[1]) / (first * seen * again));
}

// ---- Beside Mitsuba

/// The mean of a picture by Mitsuba 3.9.1 (path, no end of depth), of a lamp of radiance 10, and its standard error.
struct Case {
  const char* name;
  double mean, error;
  Estimator estimator = Estimator::points;
};

/// White walls, y = 0 to 2, about a floor of 4 x 4, below a lamp of 2 x 2 at y = 6.
preset::Preset white_basin(Estimator estimator, const std::vector<int>& walls) {
  preset::Preset p = with_all_light(32, estimator);
  p.scene.materials = {
      {"white", white(0.8)}, {"water", glass(1.333)}, {"glass", glass(1.5)}, {"mirror", check::mirror(1)}};
  p.scene.objects = {object("floor", quad(4, 4), "white")};
  for (const int wall : walls) { // -z, -x, +z, +x
    const double side = wall < 2 ? -2 : 2;
    p.scene.objects.push_back(
        wall % 2 == 0 ? object(fmt::format("wall {}", wall), quad(4, 2), "white", at({0, 1, side}, {90, 0, 0}))
                      : object(fmt::format("wall {}", wall), quad(2, 4), "white", at({side, 1, 0}, {0, 0, 90})));
  }
  p.scene.materials["black"] = white(0);
  p.scene.objects.push_back(object("lamp", quad(2, 2), "black", at({0, 6, 0}, {180, 0, 0}))); // which is seen in glass
  p.scene.lights = {{.type = preset::Light::Type::mesh, .spectrum = line(550), .power_w = 40 * M_PI, .object = "lamp"}};
  p.scene.camera = {
      .position = {0, 5, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}, .fov_deg = 40, .resolution = {32, 32}};
  p.stop.passes = 16;
  return p;
}

class BesideMitsuba : public testing::TestWithParam<Case> {};

TEST_P(BesideMitsuba, HasAllLight) {
  const std::string name = GetParam().name;
  const bool has_mirror = name.starts_with("mirror");
  preset::Preset p = white_basin(GetParam().estimator, has_mirror ? std::vector{1, 2, 3} : std::vector{0, 1, 2, 3});
  if (name.starts_with("pool"))
    p.scene.objects.push_back(object("water", box(4.002, 1.5, 4.002), "water", at({0, 0.749, 0})));
  if (name.starts_with("showcase"))
    p.scene.objects.push_back(object("pane", box(4.4, 0.1, 4.4), "glass", at({0, 2.1, 0})));
  if (has_mirror) {
    p.scene.objects.push_back(object("mirror", quad(4, 2), "mirror", at({0, 1, -1.999}, {90, 0, 0})));
    p.scene.camera.position = {0, 2.5, 0.5};
    p.scene.camera.target = {0, 0.8, -2};
    p.scene.camera.up = {0, 1, 0};
  }
  const double of_a_watt = optics::to_xyz(spectrum_of(p.scene.lights[0]))[1];
  const auto estimates =
      render_passes(p, [&](const job::Snapshot& snapshot) { return std::vector{mean_of(snapshot) / of_a_watt}; });
  expect_truth("beside Mitsuba: " + name, estimates[0].mean, GetParam().mean,
               6 * GetParam().error + 0.01 * GetParam().mean + tolerance(estimates[0]));
}

INSTANTIATE_TEST_SUITE_P(Rooms, BesideMitsuba,
                         testing::Values(Case{"pool", 0.2964, 5e-4},
                                         Case{"pool_by_sppm", 0.2964, 5e-4, Estimator::sppm},
                                         Case{"showcase", 0.4736, 6e-4}, Case{"mirror", 0.422, 4e-4}),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

} // namespace nephroid::whole_light_test
