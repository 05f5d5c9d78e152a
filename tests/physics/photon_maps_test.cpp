// SPDX-License-Identifier: Apache-2.0
// Caustics that are seen through glass and in mirrors: found on receivers beside points and, everywhere, by
// `sppm`; kept on receivers beside tiles. Radiance in closed form, and pictures against those of splats, which have no
// radius and no bias.
#include "optics/fresnel.h"
#include "photons/describe_settings.h"
#include "spectral/settings.h"
#include "tests/support/closed_form.h"
#include "tests/support/passes.h"

namespace nephroid::photon_maps_test {

using Estimator = photons::Settings::Estimator;

/// Mean Y of the layer "caustic", of a light of 1 W.
std::vector<double> mean_luminance(const job::Snapshot& snapshot) {
  const std::vector<double> y = luminance(layer(snapshot, "caustic"));
  double sum = 0;
  for (const double value : y) sum += value / static_cast<double>(y.size());
  return {sum / optics::to_xyz(spectrum_of(parallel_light({0, -1, 0})))[1]};
}

/// Parallel light falls straight through a wide plate onto a white floor, which is then lit uniformly by (1 - R) / (1 +
/// R) (slab_test.cpp).
preset::Preset lit_floor(double n) {
  preset::Preset p = empty_preset(16);
  p.scene.materials = {{"glass", glass(n)}, {"white", white()}, {"mirror", check::mirror(0.7)}};
  p.scene.objects = {object("plate", box(1, 0.02, 1), "glass"),
                     object("floor", quad(100, 100), "white", at({0, -1, 0}))};
  p.scene.lights = {parallel_light({0, -1, 0})};
  p.scene.camera.position = {0, 1, 0};
  p.scene.camera.target = {0, -1, 0};
  p.scene.camera.up = {0, 0, -1};
  p.scene.camera.fov_deg = 6; // R as at normal incidence, to 1e-5
  spectral::settings(p).estimator = Estimator::points;
  spectral::settings(p).sppm.radius = 0.05;
  spectral::settings(p).photons_per_pass = 1 << 15;
  p.stop.passes = 32;
  return p;
}

class MapEstimators : public testing::TestWithParam<Estimator> {};

// On its way to the eye the light of the floor passes the plate again: L = E / pi ((1 - R) / (1 + R))^2. A plate scales
// radiance by n^2 and back again.
TEST_P(MapEstimators, FloorSeenThroughAPlate) {
  constexpr double n = 1.6;
  preset::Preset p = lit_floor(n);
  spectral::settings(p).estimator = GetParam();
  const double r = optics::fresnel_reflectance(1, 1, n), truth = std::pow((1 - r) / (1 + r), 2) / M_PI;
  const Estimate figure = render_passes(p, mean_luminance)[0];
  expect_truth("maps: radiance of a lit floor through a plate, over its truth", figure.mean / truth, 1,
               tolerance(figure) / truth);
  EXPECT_LT(tolerance(figure), 0.15 * truth);
}

// A mirror of reflectance 0.7 shows the floor below it. The light comes from far aside, so that the mirror throws no
// shadow there.
TEST_P(MapEstimators, FloorSeenInAMirror) {
  constexpr double n = 1.6;
  preset::Preset p = lit_floor(n);
  spectral::settings(p).estimator = GetParam();
  p.scene.objects.push_back(object("mirror", quad(0.5, 0.5), "mirror", at({0, -0.5, 0}, {135, 0, 0})));
  p.scene.objects[0].transform.translate = {-2, 0, 0};
  p.scene.lights[0].direction = {2, -1, 0};
  p.scene.camera.position = {0, -0.5, 2};
  p.scene.camera.target = {0, -0.5, 0};
  p.scene.camera.up = {0, 1, 0};
  const double cosine = 1 / std::hypot(2, 1), r = optics::fresnel_reflectance(cosine, 1, n);
  const double truth = 0.7 * cosine * (1 - r) / (1 + r) / M_PI;
  const Estimate figure = render_passes(p, mean_luminance)[0];
  expect_truth("maps: radiance of a lit floor in a mirror, over its truth", figure.mean / truth, 1,
               tolerance(figure) / truth);
  EXPECT_LT(tolerance(figure), 0.25 * truth);
}

// A sheet has two sides: what lights one does not show on the other. A camera above the plate and one below the floor
// see the same places, the lower one through a window of its own, which no light reaches.
TEST_P(MapEstimators, ASheetIsDarkOnItsOtherSide) {
  preset::Preset p = lit_floor(1.6);
  spectral::settings(p).estimator = GetParam();
  p.stop.passes = 2;
  p.scene.objects.push_back(object("window", box(1, 0.02, 1), "glass", at({0, -2, 0})));
  EXPECT_GT(mean_luminance(render(p))[0], 0.1);
  p.scene.camera.position = {0, -3, 0};
  EXPECT_EQ(mean_luminance(render(p))[0], 0);
}

INSTANTIATE_TEST_SUITE_P(Estimators, MapEstimators,
                         testing::Values(Estimator::points, Estimator::tiles, Estimator::sppm),
                         [](const auto& e) { return std::string(preset::word(e.param)); });

// A window that bends nothing shows by its light on receivers what the film has without it: the caustic of a ball, in
// blocks of pixels. The window is a target of photons, so it stands aside in the other picture.
TEST(ReceiverLight, AWindowShowsWhatTheFilmHas) {
  preset::Preset p = empty_preset(64);
  p.scene.materials = {{"glass", glass(1.5)}, {"air", glass(1.00001)}, {"white", white()}};
  p.scene.objects = {object("ball", check::ball(1), "glass", at({0, 1.4, 0})), object("floor", quad(10, 10), "white"),
                     object("window", box(1, 1, 0.01), "air", at({2.2, 3.6, 2.4}))};
  p.scene.lights = {parallel_light({0.3, -1, 0.5})};
  p.scene.camera.position = {0.6, 3, 4};
  p.scene.camera.target = {0.6, 0, 0.8};
  p.scene.camera.fov_deg = 20;
  spectral::settings(p).estimator = Estimator::tiles;
  p.stop.passes = 16;
  const auto blocks_of = [](const preset::Preset& preset) {
    const std::vector<double> y = luminance(layer(render(preset), "caustic"));
    std::vector<double> sums(64, 0.0);
    for (std::size_t i = 0; i < y.size(); ++i) sums[i / 64 / 8 * 8 + i % 64 / 8] += y[i];
    return sums;
  };
  const std::vector<double> film = blocks_of(p);
  p.scene.objects[2].transform.translate = {0.6, 2.6, 3.6};
  const std::vector<double> seen = blocks_of(p);
  const double light = std::accumulate(film.begin(), film.end(), 0.0);
  EXPECT_NEAR(std::accumulate(seen.begin(), seen.end(), 0.0) / light, 1, 0.005);
  for (std::size_t i = 0; i < film.size(); ++i) EXPECT_NEAR(seen[i], film[i], 0.02 * film[i] + 1e-3 * light) << i;
}

// What the splats leave out is what maps are for.
TEST(PhotonMaps, SplatsAloneShowNothingBehindGlass) {
  preset::Preset p = lit_floor(1.6);
  spectral::settings(p).estimator = Estimator::splat;
  p.stop.passes = 2;
  EXPECT_EQ(mean_luminance(render(p))[0], 0);
}

constexpr int size = 64, blocks = 8, edge = size / blocks;

/// X + Y + Z of the layer "caustic" in blocks of pixels, row by row, and its mean. Wavelengths and clusters are chosen
/// in proportion to that sum, so it is the least noisy figure.
std::vector<double> block_sums(const job::Snapshot& snapshot) {
  const std::vector<float>& rgb = layer(snapshot, "caustic").rgb;
  std::vector<double> sums(blocks * blocks + 1, 0.0);
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column) {
      const auto i = 3 * static_cast<std::size_t>(row * size + column);
      const optics::Colour xyz = optics::linear_srgb_to_xyz({rgb[i], rgb[i + 1], rgb[i + 2]});
      const double value = xyz[0] + xyz[1] + xyz[2];
      sums[static_cast<std::size_t>(row / edge * blocks + column / edge)] += value / (edge * edge);
      sums.back() += value / (size * size);
    }
  return sums;
}

/// A picture of maps is that of splats with every place blurred over a disc. Of the light in a strip along a block's
/// side, the mean of max(dx, 0) over the disc, 2 r / (3 pi), crosses that side. radius: in pixels, of the first pass,
/// the largest.
std::vector<double> blur_bound(const std::vector<double>& splats, double radius) {
  std::vector<double> bound(splats.size(), 0.005 * splats.back()); // of the mean: what leaves the picture
  for (int y = 0; y < blocks; ++y)
    for (int x = 0; x < blocks; ++x) {
      double brightest = 0; // of the block and those around it: no strip is brighter in the mean, as long as a caustic
                            // is wider than blocks
      for (int v = std::max(y - 1, 0); v <= std::min(y + 1, blocks - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, blocks - 1); ++u)
          brightest = std::max(brightest, splats[static_cast<std::size_t>(v * blocks + u)]);
      bound[static_cast<std::size_t>(y * blocks + x)] =
          4 * edge * (2 * radius / (3 * M_PI)) * brightest / (edge * edge);
    }
  return bound;
}

/// Every block of maps is that of splats, within the noise of both and what the radius blurs.
void expect_same_picture(const std::string& what, const std::vector<Estimate>& maps,
                         const std::vector<Estimate>& splats, double radius_pixels) {
  std::vector<double> means;
  for (const Estimate& e : splats) means.push_back(e.mean);
  const std::vector<double> bias = blur_bound(means, radius_pixels);
  const double brightest = *std::max_element(means.begin(), means.end());
  double smallest = 1, worst = 0, sum_z2 = 0;
  int lit = 0;
  for (std::size_t i = 0; i < maps.size(); ++i) {
    const Estimate off{maps[i].mean - splats[i].mean, maps[i].variance + splats[i].variance,
                       std::min(maps[i].degrees, splats[i].degrees)};
    if (off.variance == 0) continue; // black in both
    smallest = std::min(smallest, p_value(off, 0, bias[i]));
    if (means[i] < 0.2 * brightest || i + 1 == maps.size()) continue;
    worst = std::max(worst, std::abs(off.mean) / splats[i].mean);
    sum_z2 += off.mean * off.mean / off.variance;
    ++lit;
  }
  Estimate all = maps.back();
  all.variance += splats.back().variance;
  record(what + ": light in all, over that of splats", all.mean / means.back(), 1,
         tolerance(all) / means.back() + 0.005);
  EXPECT_LT(tolerance(all), 0.1 * means.back()) << what << ": such a check would see too little";
  EXPECT_GT(sidak(smallest, static_cast<double>(maps.size())), false_alarm) << what;
  EXPECT_GT(lit, 4) << what;
  testing::Test::RecordProperty(what + ": mean z^2 of bright blocks, and the worst off",
                                fmt::format("{:.2f}, {:.3f}", sum_z2 / lit, worst));
}

/// A ball of flint under a lamp of D65: its caustic on the floor beside the camera's way.
preset::Preset ball_caustic() {
  preset::Preset p = empty_preset(size);
  p.scene.materials["floor"].reflectance.type = preset::Reflectance::Type::patch;
  p.scene.materials["floor"].reflectance.patch = "orange";
  preset::Material& flint = p.scene.materials["glass"] = glass(1.7);
  flint.dispersion.type = preset::Dispersion::Type::cauchy;
  flint.dispersion.coefficients = {1.65, 0.03};
  p.scene.objects = {object("ball", check::ball(0.5), "glass", at({0, 1, 0})), object("floor", quad(20, 20), "floor")};
  p.scene.objects[0].normals = preset::Object::Normals::smooth;
  p.scene.lights = {{.power_w = 100, .position = {-3, 4, 0}}};
  p.scene.camera.position = {1.2, 2.5, 0.01};
  p.scene.camera.target = {1.2, 0, 0};
  p.scene.camera.fov_deg = 30;
  spectral::settings(p).threshold_deg = 3;
  spectral::settings(p).jitter = false;
  spectral::settings(p).photons_per_pass = 1 << 16;
  p.stop.passes = 24;
  return p;
}

/// Radius of a fraction of a pixel's width on the floor.
void set_radius(preset::Preset& p, double pixels) {
  spectral::settings(p).sppm.radius = pixels * 2 * 2.5 * std::tan(p.scene.camera.fov_deg / 2 * degree) / size;
}

TEST(PhotonMaps, SppmIsWhatSplatsAre) {
  preset::Preset splat = ball_caustic(), sppm = splat;
  sppm.seed = 77;
  spectral::settings(sppm).estimator = Estimator::sppm;
  spectral::settings(sppm).effort = photons::Settings::Effort::equal;
  spectral::settings(sppm).photons_per_pass = 1 << 14;
  set_radius(sppm, 0.4);
  expect_same_picture("sppm against splats", render_passes(sppm, block_sums), render_passes(splat, block_sums), 0.4);
}

// A window before the camera whose glass hardly bends: what is behind it is gathered, and has to look like what is
// splatted without it.
TEST(PhotonMaps, AWindowChangesNothing) {
  preset::Preset splat = ball_caustic(), maps = splat;
  maps.seed = 78;
  spectral::settings(maps).estimator = Estimator::points;
  maps.scene.materials["air"] = glass(1.00001);
  maps.scene.objects.push_back(object("window", box(0.6, 0.01, 0.6), "air", at({1.2, 2.2, 0})));
  set_radius(maps, 0.4);
  for (const bool jitter : {false, true}) {
    spectral::settings(splat).jitter = spectral::settings(maps).jitter = jitter;
    // Of each cluster a pass has one wavelength: many passes. On a grey floor most wavelengths bring as much X + Y + Z.
    if (jitter)
      for (preset::Preset* p : {&splat, &maps}) {
        p->scene.materials["floor"] = white(0.8);
        spectral::settings(*p).photons_per_pass = 1 << 15;
        p->stop.passes = 110;
      }
    expect_same_picture(jitter ? "jittered maps through a window" : "maps through a window",
                        render_passes(maps, block_sums), render_passes(splat, block_sums), 0.4);
  }
}

// A spot's light through a tilted plate, seen in a mirror, is what the mirrored camera sees without it, left and right
// exchanged. The plate's reflections go up: none meets the mirror.
TEST(PhotonMaps, AMirrorShowsWhatTheMirroredCameraSees) {
  preset::Preset splat = ball_caustic();
  splat.scene.objects[0] = object("plate", box(0.7, 0.2, 0.7), "glass", at({0, 1, 0}, {0, 0, 20}));
  preset::Light& light = splat.scene.lights[0];
  light.type = preset::Light::Type::spot;
  light.position = {0, 3, 0};
  light.half_angle_deg = 8;
  splat.scene.camera.position = {1.5, 1.2, -4};
  splat.scene.camera.target = {0, 0, 0};
  splat.scene.camera.fov_deg = 16;
  preset::Preset maps = splat;
  maps.seed = 79;
  spectral::settings(maps).estimator = Estimator::points;
  maps.scene.materials["mirror"] = check::mirror(1);
  maps.scene.objects.push_back(object("mirror", quad(4, 2), "mirror", at({0, 1.02, -1.5}, {90, 0, 0})));
  maps.scene.camera.position[2] = 1; // mirrored about z = -1.5
  maps.scene.camera.target[2] = -3;
  spectral::settings(maps).sppm.radius = 0.4 * 2 * 4.4 * std::tan(8 * degree) / size;
  const auto mirrored = [](const job::Snapshot& snapshot) {
    std::vector<double> figures = block_sums(snapshot);
    for (auto row = figures.begin(); row + 1 != figures.end(); row += blocks) std::reverse(row, row + blocks);
    return figures;
  };
  // The floor is seen from the side: a disc on it covers no more pixels than one that faces the camera.
  expect_same_picture("maps in a mirror", render_passes(maps, mirrored), render_passes(splat, block_sums), 0.4);
}

} // namespace nephroid::photon_maps_test
