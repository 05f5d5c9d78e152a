// SPDX-License-Identifier: Apache-2.0
// Photons on lattices, splatted as the pieces that they stand for: where light is even they make no noise at all, and
// in the places where a piece is no piece of its receiver they send the light that points send.
#include "optics/fresnel.h"
#include "photons/pixel_surfaces.h"
#include "scene/scene.h"
#include "spectral/settings.h"
#include "tests/support/closed_form.h"

#include <numeric>

namespace nephroid::tiles_test {

using photons::Settings;

preset::Preset by_tiles(preset::Preset p) {
  spectral::settings(p).estimator = Settings::Estimator::tiles;
  return p;
}

/// Y of all pixels together.
double light_of(const job::Snapshot& snapshot) {
  const std::vector<double> y = luminance(layer(snapshot, "caustic"));
  return std::accumulate(y.begin(), y.end(), 0.0);
}

/// Linear sRGB of all pixels together.
std::array<double, 3> colour_of(const job::Snapshot& snapshot) {
  std::array<double, 3> sum{};
  const std::vector<float> rgb = layer(snapshot, "caustic").rgb;
  for (std::size_t i = 0; i < rgb.size(); ++i) sum[i % 3] += rgb[i];
  return sum;
}

double mean_square(const std::vector<double>& figure, double truth) {
  double sum = 0;
  for (const double f : figure) sum += (f - truth) * (f - truth);
  return sum / static_cast<double>(figure.size());
}

// Under a wide plate in parallel light every place gets (1 - R) / (1 + R) of E cos(theta) (slab_test.cpp). Cells of
// some two pixels meet edge to edge, so that what is reflected twice inside is all that is left of the noise: R^2 of
// the light in cells of 32 pixels.
TEST(Tiles, MeetEdgeToEdgeUnderAPlate) {
  constexpr double n = 1.5;
  for (const double theta_deg : {0.0, 30.0}) {
    preset::Preset p = empty_preset();
    p.scene.materials = {{"glass", glass(n)}, {"white", white()}};
    p.scene.objects = {object("plate", box(4, 0.02, 4), "glass"),
                       object("floor", quad(100, 100), "white", at({0, -1, 0}))};
    const double theta = theta_deg * degree;
    p.scene.lights = {parallel_light({std::sin(theta), -std::cos(theta), 0})};
    spectral::settings(p).photons_per_pass = 1 << 14;
    const Screen screen{{std::tan(theta), -1, 0}, 1.5, 64};
    screen.fill(p.scene.camera, 0.5);
    const double r = optics::fresnel_reflectance(std::cos(theta), 1, n),
                 truth = std::cos(theta) * (1 - r) / (1 + r) * screen.pixel_area();
    const auto error = [&](const preset::Preset& of) {
      return std::sqrt(mean_square(watts(render(of), "caustic", screen, spectrum_of(p.scene.lights[0])), truth)) /
             truth;
    };
    const double tiles = error(by_tiles(p)), points = error(p);
    record(fmt::format("tiles under a plate at {} degrees: rms error of a pixel", theta_deg), tiles, 0, 0.01);
    EXPECT_LT(tiles, 0.01);
    EXPECT_GT(points, 30 * tiles) << "points";
  }
}

// From the middle of a ball light goes straight out, and what is reflected comes back through the middle: the floor has
// the light of the bare lamp, whose sines of incidence are 0 but for rounding.
TEST(Tiles, AreEvenAroundALampInTheMiddleOfABall) {
  constexpr double height = 1;
  for (const double aside : {0.0, 1e-4}) {
    preset::Preset p = by_tiles(empty_preset());
    p.scene.materials = {{"glass", glass(1.5)}, {"white", white()}};
    preset::Shape ball;
    ball.radius = 0.4;
    p.scene.objects = {object("ball", ball, "glass"), object("floor", quad(100, 100), "white", at({0, -height, 0}))};
    p.scene.lights = {{.spectrum = line(550), .power_w = 4 * std::numbers::pi, .position = {aside, 0, 0}}};
    spectral::settings(p).photons_per_pass = 1 << 16;
    p.stop.passes = 4;
    const Screen screen{{0.9, -height, 0.9}, 0.8, 16};
    screen.fill(p.scene.camera, 0.1);
    const std::vector<double> light = watts(render(p), "caustic", screen, spectrum_of(p.scene.lights[0]));
    double error = 0;
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) {
        const double to_x = 0.9 + 0.8 * ((x + 0.5) / 16 - 0.5), to_z = 0.9 + 0.8 * ((y + 0.5) / 16 - 0.5),
                     truth = height / std::pow(std::sqrt(to_x * to_x + to_z * to_z + height * height), 3) *
                             screen.pixel_area();
        error += std::pow(light[static_cast<std::size_t>(16 * y + x)] / truth - 1, 2) / (16 * 16);
      }
    expect_truth(fmt::format("tiles from the middle of a ball, {} aside: rms error of a pixel", aside),
                 std::sqrt(error), 0, 0.1);
  }
}

/// A ball of glass over a receiver, seen from above.
preset::Preset ball_over(const preset::Object& receiver) {
  preset::Preset p = empty_preset(48);
  p.scene.materials = {{"glass", glass(1.5)}, {"white", white(0.8)}};
  preset::Shape ball;
  ball.radius = 0.5;
  p.scene.objects = {object("ball", ball, "glass", at({0, 0.7, 0})), receiver};
  p.scene.objects[0].normals = preset::Object::Normals::smooth;
  p.scene.lights = {{.spectrum = line(550), .power_w = 4 * std::numbers::pi, .position = {0.6, 4, 0.4}}};
  p.scene.camera.position = {1.5, 3, 2.5};
  p.scene.camera.target = {0, 0, 0};
  p.scene.camera.fov_deg = 50;
  spectral::settings(p).photons_per_pass = 1 << 16;
  p.stop.passes = 4;
  return p;
}

preset::Preset on_a_floor() { return ball_over(object("floor", quad(10, 10), "white")); }

/// The caustic lies across an edge of the receiver, beyond which a lower floor gets the rest.
preset::Preset over_an_edge() {
  preset::Preset p = ball_over(object("shelf", quad(1, 1), "white", at({0.4, 0, 0})));
  p.scene.objects.push_back(object("floor", quad(10, 10), "white", at({0, -1, 0})));
  return p;
}

preset::Preset on_a_hill() {
  preset::Shape hill;
  hill.radius = 2;
  preset::Object receiver = object("hill", hill, "white", at({0, -2.1, 0}));
  receiver.normals = preset::Object::Normals::smooth;
  return ball_over(receiver);
}

/// Cells are larger than the picture, and most of the floor is behind the camera.
preset::Preset with_few_photons_and_a_low_camera() {
  preset::Preset p = on_a_floor();
  spectral::settings(p).photons_per_pass = 64;
  p.stop.passes = 512;
  p.scene.camera.position = {0.5, 0.02, 0.5};
  p.scene.camera.target = {0, 0, 0};
  return p;
}

/// In a slab below the critical angle, and grazing at its faces.
preset::Preset through_a_wedge() {
  preset::Preset p = on_a_floor();
  preset::Shape prism;
  prism.type = preset::Shape::Type::prism;
  prism.side = prism.height = 0.6;
  prism.apex_deg = 83.6; // of n = 1.5: light enters and leaves at grazing incidence
  p.scene.objects[0] = object("wedge", prism, "glass", at({0, 0.7, 0}, {-90, 0, 10}));
  return p;
}

/// Tiles have some hundred places of it, so their sum has more noise than points'.
preset::Preset of_a_panel() {
  preset::Preset p = on_a_floor();
  preset::Light& lamp = p.scene.lights[0];
  lamp.type = preset::Light::Type::area;
  lamp.direction = {-0.15, -1, -0.1};
  lamp.size = {0.5, 0.5};
  return p;
}

/// Two targets overlap, and a spot's cone is narrower than either.
preset::Preset of_a_narrow_spot() {
  preset::Preset p = on_a_floor();
  p.scene.objects.push_back(p.scene.objects[0]);
  p.scene.objects.back().name = "second ball";
  p.scene.objects.back().transform.translate = {0.7, 0.8, 0.2};
  preset::Light& lamp = p.scene.lights[0];
  lamp.type = preset::Light::Type::spot;
  lamp.direction = {-0.1, -1, -0.08};
  lamp.half_angle_deg = 4;
  return p;
}

/// So many branches that not all can wait to be followed: half of the light is reflected at each of sixteen faces.
preset::Preset through_plates_at_grazing_incidence() {
  preset::Preset p = on_a_floor();
  p.scene.objects.erase(p.scene.objects.begin());
  for (int i = 0; i < 8; ++i)
    p.scene.objects.push_back(object(fmt::format("plate {}", i), box(2, 0.02, 2), "glass", at({0, 0.3 + 0.1 * i, 0})));
  p.stop.passes = 16;
  p.scene.lights = {parallel_light({std::sin(80 * degree), -std::cos(80 * degree), 0})};
  return p;
}

/// A lamp with gaps in its spectrum beside one without, and glass that bends and absorbs each wavelength otherwise.
preset::Preset of_unlike_lamps() {
  preset::Preset p = on_a_floor();
  preset::Material& dye = p.scene.materials["glass"];
  dye.dispersion.type = preset::Dispersion::Type::file;
  dye.dispersion.file = "materials/rhodamine-6G-Seckin.yml";
  p.unit = preset::Preset::Unit::mm;
  p.scene.lights.push_back(p.scene.lights[0]);
  p.scene.lights[0].spectrum = line(640);
  p.scene.lights[1].spectrum = {.illuminant = "D65"};
  p.scene.lights[1].position = {-0.6, 4, 0.4};
  spectral::settings(p).threshold_deg = 0.5;
  return p;
}

/// Nothing disperses, so that all wavelengths are one cluster, and glass leaves of each another part.
preset::Preset through_a_red_tint() {
  preset::Preset p = on_a_floor();
  p.scene.materials["glass"].tint.type = preset::Reflectance::Type::patch;
  p.scene.materials["glass"].tint.patch = "red";
  p.scene.lights[0].spectrum = {.illuminant = "D65"};
  return p;
}

preset::Preset within_a_round() {
  preset::Preset p = of_unlike_lamps();
  p.stop.passes = 5;
  return p;
}

struct Case {
  std::string name;
  preset::Preset (*preset)();
  double most; ///< of the relative difference of the pictures' sums
};

class TilesAndPoints : public testing::TestWithParam<Case> {};

/// The picture without what glass may show, which has the noise of paths from the eye (photon_maps_test.cpp).
job::Snapshot seen_directly(const preset::Preset& p) {
  job::Snapshot snapshot = render(p);
  job::Picture picture = *snapshot.picture;
  for (job::Layer& l : picture.layers)
    for (const std::uint32_t pixel : photons::glass_pixels(scene::load_scene(p)))
      for (std::size_t c = 0; c < 3; ++c) l.rgb[3 * std::size_t{pixel} + c] = 0;
  snapshot.picture = std::make_shared<const job::Picture>(std::move(picture));
  return snapshot;
}

// Both send the same light to the same places: the picture's sum, and what became of all photons. There are 16 times as
// many points, whose noise is some 0.3 % then.
TEST_P(TilesAndPoints, SendTheSameLight) {
  preset::Preset p = GetParam().preset();
  const job::Snapshot tiles = seen_directly(by_tiles(p));
  spectral::settings(p).photons_per_pass *= 16;
  spectral::settings(p).estimator = Settings::Estimator::points;
  const job::Snapshot points = seen_directly(p);
  const photons::EnergyBalance energy = photons::energy_of(tiles), truth = photons::energy_of(points);
  EXPECT_EQ(energy.refused_contributions, 0u);
  EXPECT_NEAR(energy.emitted_w / truth.emitted_w, 1, 0.01);
  EXPECT_NEAR(energy.deposited_w / truth.deposited_w, 1, GetParam().most);
  EXPECT_NEAR((energy.deposited_w + energy.missed_w + energy.absorbed_w + energy.escaped_w + energy.lost_w) /
                  energy.emitted_w,
              1, 1e-6);
  record(GetParam().name + ": light by tiles over light by points", light_of(tiles) / light_of(points), 1,
         GetParam().most);
  EXPECT_NEAR(light_of(tiles) / light_of(points), 1, GetParam().most);
  const std::array<double, 3> colour = colour_of(tiles), true_colour = colour_of(points);
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(colour[c], true_colour[c], GetParam().most * std::ranges::max(true_colour)) << c;
}

INSTANTIATE_TEST_SUITE_P(
    , TilesAndPoints,
    testing::Values(Case{"floor", on_a_floor, 0.01}, Case{"edge", over_an_edge, 0.01}, Case{"hill", on_a_hill, 0.01},
                    Case{"low_camera", with_few_photons_and_a_low_camera, 0.1}, Case{"wedge", through_a_wedge, 0.01},
                    Case{"panel", of_a_panel, 0.04}, Case{"spot", of_a_narrow_spot, 0.01},
                    Case{"plates", through_plates_at_grazing_incidence, 0.02},
                    Case{"unlike_lamps", of_unlike_lamps, 0.02}, Case{"within_a_round", within_a_round, 0.02},
                    Case{"tint", through_a_red_tint, 0.01}),
    [](const auto& c) { return c.param.name; });

TEST(Tiles, AreAsBrightInOneImageAsInTwoHalves) {
  preset::Preset p = by_tiles(on_a_floor());
  const double halves = light_of(seen_directly(p));
  p.measure.estimate = false;
  EXPECT_NEAR(light_of(seen_directly(p)) / halves, 1, 0.01);
}

// The estimate of a run's error has what both halves of the film do wrong alike.
TEST(Tiles, EstimateTheErrorOfABall) {
  preset::Preset p = by_tiles(on_a_floor());
  p.scene.camera.position = {0.9, 0.6, 0.9}; // below the ball, which is not seen: what it shows has another error
  p.scene.camera.fov_deg = 12;
  spectral::settings(p).photons_per_pass = 1 << 14;
  preset::Preset longer = p;
  longer.stop.passes = 256;
  const job::Snapshot truth = render(longer);
  for (const int passes : {4, 16}) {
    p.stop.passes = passes;
    const job::Snapshot snapshot = render(p);
    const std::vector<float>&figure = snapshot.picture->rgb, &draw = snapshot.picture->error_draw;
    double estimate = 0, error = 0;
    for (std::size_t i = 0; i < figure.size(); ++i) {
      estimate += std::pow(double{draw[i]}, 2);
      error += std::pow(double{figure[i]} - double{truth.picture->rgb[i]}, 2);
    }
    expect_truth(fmt::format("tiles, ball, {} passes: estimated error over true one", passes),
                 std::sqrt(estimate / error), 1, 0.4);
  }
}

} // namespace nephroid::tiles_test
