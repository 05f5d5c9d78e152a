// SPDX-License-Identifier: Apache-2.0
// The layer "indirect" against closed forms: a furnace, one bounce between two patches by quadrature, a lit patch
// against a lamp in its place, and where the power goes.
#include "spectral/settings.h"
#include "tests/support/closed_form.h"
#include "tests/support/passes.h"
#include "tests/support/saved_jobs.h"

namespace nephroid::indirect_test {

preset::Preset indirect_only(int resolution) {
  preset::Preset p = empty_preset(resolution);
  spectral::settings(p).direct = spectral::settings(p).caustic = false;
  spectral::settings(p).indirect = true;
  return p;
}

/// XYZ of a spectrum after reflectances.
optics::Colour seen(optics::Spectrum light, const std::vector<optics::Spectrum>& reflectances) {
  for (const optics::Spectrum& r : reflectances)
    for (std::size_t w = 0; w < light.size(); ++w) light[w] *= r[w];
  return optics::to_xyz(light);
}

/// Mean XYZ of the squares of `group` x `group` pixels of a layer: 3 figures a square; and the mean Y of all of them at
/// the end.
std::vector<double> squares_of(const job::Layer& layer, int pixels, int group) {
  const int squares = pixels / group;
  std::vector<double> figures(3 * static_cast<std::size_t>(squares * squares) + 1, 0.0);
  for (int row = 0; row < pixels; ++row)
    for (int column = 0; column < pixels; ++column) {
      const std::size_t i = 3 * static_cast<std::size_t>(row * pixels + column);
      const optics::Colour xyz = optics::linear_srgb_to_xyz({layer.rgb[i], layer.rgb[i + 1], layer.rgb[i + 2]});
      for (std::size_t c = 0; c < 3; ++c)
        figures[3 * static_cast<std::size_t>(row / group * squares + column / group) + c] += xyz[c] / (group * group);
      figures.back() += xyz[1] / (pixels * pixels);
    }
  return figures;
}

/// Every figure of squares_of agrees with its truth, within its own scatter and a share `bias` of the truth. truths: of
/// the squares.
void expect_figures(const std::string& what, const std::vector<Estimate>& estimates, const std::vector<double>& truths,
                    double bias) {
  ASSERT_EQ(estimates.size(), truths.size() + 1);
  double smallest = 1, sum_of_y = 0;
  for (std::size_t i = 0; i < truths.size(); ++i) {
    EXPECT_GT(estimates[i].mean, 0) << what << " " << i;
    smallest = std::min(smallest, p_value(estimates[i], truths[i], bias * truths[i]));
    if (i % 3 == 1) sum_of_y += truths[i];
  }
  EXPECT_GT(sidak(smallest, static_cast<double>(truths.size())), false_alarm) << what;
  const Estimate& mean = estimates.back();
  const double truth = sum_of_y / (static_cast<double>(truths.size()) / 3);
  expect_truth(what + ": mean / closed form", mean.mean / truth, 1, bias + tolerance(mean) / truth);
}

// Inside of a sphere of reflectance rho: what any piece of the wall reflects goes to all of the wall evenly, because
// cos(theta) cos(theta') / (pi d^2) = 1 / (4 pi R^2) between any two points. So wherever the light is, what was
// reflected k times makes the irradiance P rho^k / (4 pi R^2), and all that was reflected once or more
//   E = P / (4 pi R^2) * rho / (1 - rho).
// A ball of clear glass around a light in the middle changes nothing: all that leaves it goes straight outwards, and
// later on every order is even by symmetry. Nor does a window before the camera, which takes no light: in even light it
// sends as much as it hides. Of the first order it moves less than .1, and of what it moved .1 of a tenth of the
// directions.
struct Furnace {
  const char* name;
  preset::Light::Type type;
  preset::Vec3 position;
  double glass_radius; // 0: none
  double half_angle_deg = 30;
  bool window = false, tiles = false;
};

class DiffuseFurnace : public testing::TestWithParam<Furnace> {};

TEST_P(DiffuseFurnace, IsEvenlyLit) {
  constexpr double radius = 2, reflectance = 0.7, power = 10;
  constexpr int pixels = 16, group = 4;
  preset::Preset p = indirect_only(pixels);
  p.scene.materials = {{"wall", white(reflectance)}, {"glass", glass(1.5)}};
  preset::Shape room = check::ball(radius);
  room.inwards = true;
  p.scene.objects = {object("room", room, "wall")};
  p.scene.lights = {{.type = GetParam().type,
                     .spectrum = {.illuminant = "E"},
                     .power_w = power,
                     .position = GetParam().position,
                     .direction = {1, 0, 0},
                     .half_angle_deg = GetParam().half_angle_deg,
                     .size = {0.3, 0.2}}};
  if (GetParam().glass_radius > 0) {
    p.scene.objects.push_back(object("bulb", check::ball(GetParam().glass_radius), "glass"));
    p.scene.objects.back().normals = preset::Object::Normals::smooth;
  }
  if (GetParam().window) {
    p.scene.materials["pane"] = glass(1.5);
    p.scene.materials["pane"].thin = true;
    if (GetParam().tiles) { // whose rounds are apart from what walls send on
      spectral::settings(p).caustic = true;
      spectral::settings(p).estimator = photons::Settings::Estimator::tiles;
    }
    p.scene.objects.push_back(object("window", quad(1.4, 1.4), "pane", at({0, 0, -1.1}, {90, 0, 0})));
  }
  p.scene.camera.position = {0, 0, -0.8};
  p.scene.camera.target = {0.3, 0, -2};
  p.scene.camera.fov_deg = 70;
  spectral::settings(p).max_surfaces = 400;
  spectral::settings(p).indirect_photons_per_pass = 1 << 11;
  photons::EnergyBalance energy;
  const auto squares = [&](const job::Snapshot& snapshot) {
    energy = photons::energy_of(snapshot, "indirect_energy");
    return squares_of(layer(snapshot, "indirect"), pixels, group);
  };
  constexpr int passes = 512, runs = 32;
  p.stop.passes = GetParam().window ? passes / runs : passes;
  const std::vector<Estimate> estimates =
      GetParam().window ? render_seeds(p, runs, squares) : render_passes(p, squares);
  const double irradiance = power / (4 * M_PI * radius * radius) * reflectance / (1 - reflectance);
  const optics::Colour xyz = optics::to_xyz(optics::illuminant("E"));
  std::vector<double> truths;
  for (std::size_t i = 0; i + 1 < estimates.size(); ++i) truths.push_back(irradiance * reflectance / M_PI * xyz[i % 3]);
  // 256 x 128 facets have an area that is smaller than the sphere's by 1.5e-4, and are not quite a sphere to each
  // other.
  expect_figures(std::string("indirect, furnace, ") + GetParam().name, estimates, truths,
                 GetParam().window ? 2e-3 : 5e-4);
  const bool has_photons = GetParam().glass_radius > 0 || GetParam().half_angle_deg < 18;
  EXPECT_EQ(std::isnan(energy.emitted_w), !has_photons);
  if (!has_photons) return;
  EXPECT_NEAR(energy.emitted_w / power, 1,
              0.05); // wavelengths are drawn by what the eye makes of them, so power scatters
  EXPECT_LT(energy.escaped_w, 1e-4 * energy.emitted_w);
  EXPECT_LT(energy.lost_w, 1e-4 * energy.emitted_w);
}

INSTANTIATE_TEST_SUITE_P(
    Lights, DiffuseFurnace,
    testing::Values(Furnace{"point", preset::Light::Type::point, {0.9, 0.5, 0.3}, 0},
                    Furnace{"spot", preset::Light::Type::spot, {-0.5, 0.5, 0}, 0},
                    Furnace{"narrow_spot", preset::Light::Type::spot, {-0.5, 0.5, 0}, 0, 2},
                    Furnace{"area", preset::Light::Type::area, {0, -0.4, 0.6}, 0},
                    Furnace{"in_a_glass_ball", preset::Light::Type::point, {0, 0, 0}, 0.5},
                    Furnace{"through_a_window", preset::Light::Type::point, {0, 0, 0}, 0.5, 30, true},
                    Furnace{
                        "through_a_window_beside_tiles", preset::Light::Type::point, {0, 0, 0}, 0.5, 30, true, true}),
    [](const testing::TestParamInfo<Furnace>& parameter) { return std::string(parameter.param.name); });

// A pencil of light on the middle of a red tile, which lights a green screen at a right angle to it. With P the power
// and one bounce,
//   L(screen) = P rho_red rho_green / pi^2 * cos(theta) cos(theta') / d^2, wavelength by wavelength.
TEST(Indirect, ARedTileTintsAGreenScreen) {
  constexpr int pixels = 24, group = 6;
  constexpr double power = 3, height = 0.5;
  const Screen screen{{0, 0, 0}, 1, pixels};
  preset::Preset p = indirect_only(pixels);
  p.scene.materials["red"].reflectance.type = p.scene.materials["green"].reflectance.type =
      preset::Reflectance::Type::patch;
  p.scene.materials["red"].reflectance.patch = "red";
  p.scene.materials["green"].reflectance.patch = "green";
  p.scene.objects = {object("tile", quad(0.1, 0.1), "red", at({-0.8, height, 0}, {0, 0, -90})),
                     object("screen", quad(1, 1), "green")};
  preset::Light light = pencil({1, height + 0.4, 0.2}, {-1.8, -0.4, -0.2}, 0.05);
  light.spectrum.type = preset::LightSpectrum::Type::illuminant;
  light.spectrum.illuminant = "F10";
  light.power_w = power;
  p.scene.lights = {light};
  screen.fill(p.scene.camera, 3);
  spectral::settings(p).max_surfaces = 1; // the tile and the screen
  spectral::settings(p).indirect_photons_per_pass = 1 << 15;
  p.stop.passes = 64;

  const optics::Colour xyz =
      seen(optics::illuminant("F10"), {optics::colorchecker_patch("red"), optics::colorchecker_patch("green")});
  constexpr int squares = pixels / group;
  std::vector<double> truths(3 * squares * squares, 0.0);
  for (int row = 0; row < pixels; ++row)
    for (int column = 0; column < pixels; ++column) {
      // The tile's normal is +x and the screen's +y.
      const double dx = screen.x(column) + 0.8, dz = screen.z(row), d2 = dx * dx + height * height + dz * dz;
      const double radiance = power / (M_PI * M_PI) * dx * height / (d2 * d2);
      for (std::size_t c = 0; c < 3; ++c)
        truths[3 * static_cast<std::size_t>(row / group * squares + column / group) + c] +=
            radiance * xyz[c] / (group * group);
    }
  const auto estimates = render_passes(
      p, [&](const job::Snapshot& snapshot) { return squares_of(layer(snapshot, "indirect"), pixels, group); });
  expect_figures("indirect, red tile and green screen", estimates, truths,
                 2e-3); // middles of pixels, and the pencil's width
}

// The same with a point light and a white tile, and the middle of the screen as a mirror shows it that stands before
// the camera. A far bead disperses light, so that a path goes on in one wavelength from the mirror on. What the mirror
// itself sends to the screen goes elsewhere. Light of the tile's every place is summed up over it: with its irradiance
// E the screen gets the integral of E rho / pi cos(theta) cos(theta') / d^2. In a ball of glass about the light 1 -
// R(0) of it leaves at once, straight outwards; then the tile is lit by a caustic, which photons send on.
TEST(Indirect, AMirrorShowsAScreenThatATileLights) {
  constexpr int pixels = 16;
  constexpr double power = 3, height = 0.5, from_screen = 3, from_mirror = 0.06, tile_side = 0.4, seen_side = 0.5;
  const preset::Vec3 lamp{0.2, 0.8, 0.1}, tile{-0.8, height, 0};
  preset::Preset p = indirect_only(pixels);
  p.scene.materials = {{"white", white(0.8)}, {"mirror", check::mirror(1)}, {"flint", glass(1)}, {"glass", glass(1.5)}};
  p.scene.materials["flint"].dispersion.type = preset::Dispersion::Type::file;
  p.scene.materials["flint"].dispersion.file = "N-SF66.yml";
  p.scene.objects = {object("tile", quad(tile_side, tile_side), "white", at(tile, {0, 0, -90})),
                     object("screen", quad(1, 1), "white"),
                     object("mirror", quad(0.1, 0.1), "mirror", at({0, from_screen - from_mirror, 0}, {0, 0, -135})),
                     object("bead", check::ball(0.01), "flint", at({0, 4, 5}))};
  preset::Light light;
  light.spectrum.illuminant = "E";
  light.position = lamp;
  light.power_w = power;
  p.scene.lights = {light};
  p.scene.camera = {.position = {from_mirror, from_screen - from_mirror, 0},
                    .target = {0, from_screen - from_mirror, 0},
                    .fov_deg = 2 * std::atan(seen_side / 2 / from_screen) / degree,
                    .resolution = {pixels, pixels}};
  spectral::settings(p).max_surfaces = 2; // the mirror, the screen and the tile; the glass, the tile and the screen

  double sum = 0; // over places of the screen and of the tile, of the radiance for light of one wavelength
  constexpr int screen_places = 16, tile_places = 40;
  for (int i = 0; i < screen_places * screen_places; ++i)
    for (int j = 0; j < tile_places * tile_places; ++j) {
      const auto place = [](int n, int count) { return (n + 0.5) / count - 0.5; };
      const glm::dvec3 on_screen(seen_side * place(i % screen_places, screen_places), 0,
                                 seen_side * place(i / screen_places, screen_places)),
          on_tile(tile[0], tile[1] + tile_side * place(j % tile_places, tile_places),
                  tile[2] + tile_side * place(j / tile_places, tile_places)),
          to_lamp = glm::dvec3(lamp[0], lamp[1], lamp[2]) - on_tile, way = on_tile - on_screen;
      const double irradiance = power / (4 * M_PI) * to_lamp.x / std::pow(glm::length(to_lamp), 3);
      sum += irradiance * 0.8 / M_PI * -way.x * way.y / std::pow(glm::length(way), 4) * 0.8 / M_PI;
    }
  const double places = std::pow(screen_places * tile_places / tile_side, 2);
  for (const bool in_glass : {false, true}) {
    const double truth = sum / places * optics::to_xyz(optics::illuminant("E"))[1] * (in_glass ? 0.96 : 1);
    if (in_glass) p.scene.objects.push_back(object("bulb", check::ball(0.02), "glass", at(lamp)));
    p.stop.passes = in_glass ? 64 : 256;
    spectral::settings(p).indirect_photons_per_pass = in_glass ? 1 << 17 : 1 << 13;
    const auto estimates = render_passes(
        p, [&](const job::Snapshot& snapshot) { return squares_of(layer(snapshot, "indirect"), pixels, pixels); });
    const Estimate& mean = estimates.back();
    expect_truth(in_glass ? "indirect, a screen lit by a caustic in a mirror" : "indirect, a lit screen in a mirror",
                 mean.mean / truth, 1, 1e-3 + tolerance(mean) / truth);
  }
}

// A lit spot of a diffuse tile is a lamp: direct light of a small area lamp in its place, with the power that it
// reflects, is its indirect light, at every place of a coarse rod with interpolated normals. So both layers mean the
// same by light on a shading normal.
TEST(Indirect, ALitTileIsALamp) {
  constexpr int pixels = 24, group = 4;
  constexpr double reflectance = 0.8, power = 4;
  preset::Preset p = indirect_only(pixels);
  p.scene.materials = {{"tile", white(reflectance)}, {"ball", white(0.6)}};
  preset::Object thing = object("ball", check::rod(0.5, 10), "ball", at({0, 0, 0}, {20, 30, 0}));
  thing.normals = preset::Object::Normals::smooth;
  p.scene.camera.position = {2.5, 0.3, 0.6};
  p.scene.camera.fov_deg = 26;
  const preset::Vec3 place{0.3, 1.2, 0.2};
  preset::Light light =
      pencil({place[0] - 1.8, place[1] - 1.2, place[2]}, {1.8, 1.2, 0}, 0.5); // from below, past the ball
  light.power_w = power;

  preset::Preset tile = p;
  tile.scene.objects = {thing, object("tile", quad(0.2, 0.2), "tile", at(place))};
  tile.scene.lights = {light};
  spectral::settings(tile).max_surfaces = 1; // the tile and the ball
  spectral::settings(tile).indirect_photons_per_pass = 1 << 15;
  tile.stop.passes = 48;
  preset::Preset lamp = p;
  lamp.scene.objects = {thing};
  lamp.scene.lights = {light};
  lamp.scene.lights[0].type = preset::Light::Type::area;
  lamp.scene.lights[0].position = place;
  lamp.scene.lights[0].direction = {0, -1, 0};
  lamp.scene.lights[0].size = {
      0.03, 0.03}; // 2 cm is the radius of the spot: seen from 70 cm, its shape changes light by some 1e-4
  lamp.scene.lights[0].power_w = reflectance * power;
  spectral::settings(lamp).direct = true;
  spectral::settings(lamp).indirect = false;
  lamp.stop.passes = 64;

  const auto truths = render_passes(
      lamp, [&](const job::Snapshot& snapshot) { return squares_of(layer(snapshot, "direct"), pixels, group); });
  const auto estimates = render_passes(
      tile, [&](const job::Snapshot& snapshot) { return squares_of(layer(snapshot, "indirect"), pixels, group); });
  double smallest = 1;
  int lit = 0;
  for (std::size_t i = 1; i + 1 < truths.size(); i += 3) { // one wavelength: Y says all
    if (truths[i].mean == 0) continue;
    ++lit;
    Estimate difference = estimates[i];
    difference.variance += truths[i].variance;
    smallest = std::min(smallest, p_value(difference, truths[i].mean, 1e-3 * truths[i].mean));
  }
  EXPECT_GT(lit, 6);
  EXPECT_GT(sidak(smallest, lit), false_alarm);
  Estimate mean = estimates.back();
  mean.variance += truths.back().variance;
  const double truth = truths.back().mean;
  expect_truth("indirect, lit tile / lamp in its place", mean.mean / truth, 1, 1e-3 + tolerance(mean) / truth);
}

/// Everything that can happen to a photon: glass that absorbs, a coloured mirror, coloured walls, the open.
preset::Preset open_room(const std::filesystem::path& folder) {
  preset::Preset p = indirect_only(16);
  p.scene.materials["wall"].reflectance.type = preset::Reflectance::Type::patch;
  p.scene.materials["wall"].reflectance.patch = "orange";
  p.scene.materials["mirror"] = check::mirror(0.9);
  p.scene.materials["glass"] = glass(1.5);
  p.scene.materials["glass"].dispersion.type = preset::Dispersion::Type::file;
  p.scene.materials["glass"].dispersion.file = write_constant_nk(folder / "glass.yml", 1.5, 2e-7);
  p.scene.objects = {object("floor", quad(4, 4), "wall", at({0, -1, 0})),
                     object("back", quad(4, 4), "wall", at({0, 1, -2}, {90, 0, 0})),
                     object("ball", check::ball(0.6), "glass"),
                     object("mirror", quad(1, 1), "mirror", at({1.5, 0, 0}, {0, 0, 80}))};
  preset::Light lamp, sun;
  lamp.position = {0.5, 2, 0.5};
  sun.type = preset::Light::Type::directional;
  sun.direction = {-1, -1, -1};
  p.scene.lights = {lamp, sun};
  spectral::settings(p).indirect_photons_per_pass = 1 << 16;
  p.stop.passes = 3;
  return p;
}

TEST(Indirect, AccountsForItsEnergy) {
  TemporaryFolder temporary;
  const preset::Preset p = open_room(temporary.path());
  const job::Snapshot snapshot = render(p);
  const photons::EnergyBalance e = photons::energy_of(snapshot, "indirect_energy");
  expect_truth("indirect, energy: accounted for / emitted",
               (e.missed_w + e.absorbed_w + e.escaped_w + e.lost_w) / e.emitted_w, 1, 1e-12);
  EXPECT_GT(e.missed_w, 0.1 * e.emitted_w);
  EXPECT_GT(e.absorbed_w, 0.1 * e.emitted_w);
  EXPECT_GT(e.escaped_w, 0.1 * e.emitted_w);
  EXPECT_LT(e.lost_w, 1e-3 * e.emitted_w);
  EXPECT_EQ(photons::energy_of(snapshot).refused_contributions, 0u);
  EXPECT_EQ(snapshot.progress.work, 3u << 16) << "those of this layer are counted as sent";
}

// However long a step is, and where a run is taken up again, the bits are the same.
TEST(Indirect, HasTheSameBitsWhenItIsResumed) {
  TemporaryFolder temporary;
  const preset::Preset p = open_room(temporary.path());
  const job::Snapshot whole = render(p);
  auto job = job_as_it_is(p);
  for (int i = 0; i < 5; ++i) job->advance();
  const std::vector<std::byte> state = test::saved(*job);
  job = job_as_it_is(p);
  test::load(*job, state);
  const job::Snapshot resumed = render(*job);
  EXPECT_EQ(layer(resumed, "indirect").rgb, layer(whole, "indirect").rgb);
  EXPECT_EQ(photons::energy_of(resumed, "indirect_energy").escaped_w,
            photons::energy_of(whole, "indirect_energy").escaped_w);
}

} // namespace nephroid::indirect_test
