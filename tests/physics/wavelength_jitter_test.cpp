// SPDX-License-Identifier: Apache-2.0
// One path for a whole cluster is biased; one wavelength of the cluster for each path is not, however coarse the
// clusters are. The truth is brute force, a path for every wavelength. Low-discrepancy numbers and photons allocated by
// variance have to keep the expectation too. The two halves of a film, from which a run tells its own error, have to be
// independent whatever the paths follow.
#include "job/job.h"
#include "spectral/settings.h"
#include "tests/support/closed_form.h"
#include "tests/support/leaving_out_scenes.h"
#include "tests/support/passes.h"

namespace nephroid::wavelength_jitter_test {

/// Strong dispersion, so that a whole cluster's mean n is far from most of its wavelengths', over a floor that is not
/// grey. Photons take whole clusters, are independent, and are allocated by power: what a test is about it turns on.
preset::Preset dispersing_ball(bool absorbing) {
  preset::Preset p = ball_scene();
  p.scene.materials["glass"].dispersion.coefficients = {1.4, 0.04};
  p.scene.lights[0].spectrum.illuminant = "A";
  p.scene.materials["white"].reflectance.type = preset::Reflectance::Type::patch;
  p.scene.materials["white"].reflectance.patch = "foliage";
  if (absorbing) {
    p.scene.materials["mirror"] = mirror(0.5);
    p.scene.materials["mirror"].reflectance.type = preset::Reflectance::Type::patch;
    p.scene.materials["mirror"].reflectance.patch = "orange";
    p.scene.materials["gold"] = check::conductor("gold");
    p.scene.objects.push_back(object("mirror", quad(1, 1), "mirror", at({0.8, 0.05, 0})));
    p.scene.objects.push_back(object("gold", quad(1, 1), "gold", at({-0.8, 0.05, 0})));
  }
  spectral::settings(p).photons_per_pass = 1 << 13;
  spectral::settings(p).jitter = spectral::settings(p).low_discrepancy = false;
  spectral::settings(p).effort = photons::Settings::Effort::power;
  p.stop.passes = 24;
  return p;
}

/// Linear sRGB of the picture in 3 x 3 blocks, and the watts of the energy balance.
std::vector<double> figures(const job::Snapshot& snapshot) {
  const std::vector<float>& rgb = snapshot.picture->rgb;
  const int size = snapshot.picture->width, block = size / 3;
  std::vector<double> sums(27);
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column)
      for (int c = 0; c < 3; ++c)
        sums[static_cast<std::size_t>(3 * (3 * (row / block) + column / block) + c)] +=
            rgb[static_cast<std::size_t>(3 * (row * size + column) + c)];
  for (const double watts : {photons::energy_of(snapshot).emitted_w, photons::energy_of(snapshot).deposited_w,
                             photons::energy_of(snapshot).absorbed_w})
    sums.push_back(watts);
  return sums;
}

/// Sidak's p-value of the worst figure of two runs that should have one expectation.
double p_of_same(const std::vector<Estimate>& a, const std::vector<Estimate>& b) {
  double worst = 1;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Estimate both{a[i].mean - b[i].mean, a[i].variance + b[i].variance, std::min(a[i].degrees, b[i].degrees)};
    worst = std::min(worst, p_value(both, 0, 1e-6 * std::abs(a[i].mean)));
  }
  return sidak(worst, static_cast<double>(a.size()));
}

class WavelengthJitter : public testing::TestWithParam<bool> {};

TEST_P(WavelengthJitter, HasTheExpectationOfBruteForce) {
  preset::Preset p = dispersing_ball(GetParam());
  spectral::settings(p).method = photons::Settings::Method::brute_force;
  const std::vector<Estimate> truth = render_passes(p, figures);
  p.seed = 2;
  spectral::settings(p).method = photons::Settings::Method::optimal;
  spectral::settings(p).threshold_deg = 80; // one cluster
  spectral::settings(p).jitter = true;
  EXPECT_GT(p_of_same(render_passes(p, figures), truth), false_alarm);
  p.seed = 3;
  spectral::settings(p).low_discrepancy = true;
  spectral::settings(p).threshold_deg = 0.5;
  EXPECT_GT(p_of_same(render_passes(p, figures), truth), false_alarm);
  p.seed = 4;
  spectral::settings(p).effort = photons::Settings::Effort::variance;
  EXPECT_GT(p_of_same(render_passes(p, figures), truth), false_alarm);
}

INSTANTIATE_TEST_SUITE_P(, WavelengthJitter, testing::Bool(),
                         [](const auto& test) { return test.param ? "WithColouredMirrorAndGold" : "Glass"; });

// Without jitter one cluster sends all wavelengths the way of one: it differs from brute force far beyond the noise.
TEST(WholeClusters, AreBiased) {
  preset::Preset p = dispersing_ball(false);
  spectral::settings(p).photons_per_pass = 1 << 16;
  spectral::settings(p).method = photons::Settings::Method::brute_force;
  const std::vector<Estimate> truth = render_passes(p, figures);
  p.seed = 2;
  spectral::settings(p).method = photons::Settings::Method::optimal;
  spectral::settings(p).threshold_deg = 80;
  EXPECT_LT(p_of_same(render_passes(p, figures), truth), false_alarm);
}

// The sequence spreads photons more evenly than chance does: behind glass that bends nothing (n = 1 + 1e-6) a floor's
// irradiance is smooth, and its pixels scatter far less about their mean.
TEST(LowDiscrepancy, SpreadsPhotonsEvenly) {
  preset::Preset p = dispersing_ball(false);
  p.scene.materials["glass"].dispersion.coefficients = {1.000001};
  spectral::settings(p).direct = false;
  spectral::settings(p).photons_per_pass = 1 << 16;
  p.stop.passes = 4;
  const auto scatter = [&](bool low_discrepancy) {
    spectral::settings(p).low_discrepancy = low_discrepancy;
    p.seed = 1;
    const job::Snapshot a = render(p);
    p.seed = 2;
    const job::Snapshot b = render(p);
    double sum = 0;
    for (std::size_t i = 0; i < a.picture->rgb.size(); ++i) sum += std::pow(a.picture->rgb[i] - b.picture->rgb[i], 2);
    return sum;
  };
  EXPECT_LT(scatter(true), 0.5 * scatter(false));
}

/// The squares of what runs take for their own error, of two runs each of eight pairs, over the squares of the pairs'
/// differences: 1 in the mean, for such a draw has the variance of the picture, and a difference twice that.
double believed_over_true_error(preset::Preset p) {
  double draws = 0, differences = 0;
  const auto square = [](double x) { return x * x; };
  for (int pair = 0; pair < 8; ++pair) {
    ++p.seed;
    const job::Snapshot a = render(p);
    ++p.seed;
    const job::Snapshot b = render(p);
    const std::vector<float>&draw_a = a.picture->error_draw, &draw_b = b.picture->error_draw;
    if (draw_a.empty() || draw_b.empty())
      throw std::logic_error("believed_over_true_error: the run has no estimate of its error");
    for (std::size_t i = 0; i < draw_a.size(); ++i) {
      draws += square(draw_a[i]) + square(draw_b[i]);
      differences += square(a.picture->rgb[i] - b.picture->rgb[i]);
    }
  }
  return draws / differences;
}

// A run takes its error for the difference of the film's halves, so they have to be independent, each with sequences of
// its own. Where glass bends nothing and reflects nothing, how a photon starts is all that is random: halves that
// follow the same sequence would be the same picture. The ratio, of thousands of pixels, scatters by 0.06; a factor of
// 2 is more than ten times that.
TEST(HalvesOfTheFilm, PhotonsFollowIndependentSequences) {
  preset::Preset p = dispersing_ball(false);
  p.scene.materials["glass"].dispersion.coefficients = {1.000001};
  spectral::settings(p).direct = false;
  spectral::settings(p).low_discrepancy = true;
  spectral::settings(p).photons_per_pass = 1 << 12;
  p.stop.passes = 2;
  const double ratio = believed_over_true_error(p);
  EXPECT_GT(ratio, 0.5);
  EXPECT_LT(ratio, 2);
}

// Through a plate that hardly bends, which clusters a pixel's paths take is nearly all that is random.
TEST(HalvesOfTheFilm, EyePathsTakeIndependentClusters) {
  preset::Preset p = dispersing_ball(false);
  p.scene.materials["glass"].dispersion.coefficients = {1.01, 0.001};
  p.scene.objects[0].shape = box(6, 0.02, 6);
  p.scene.objects[0].transform.translate = {0, 2, 0};
  p.scene.lights[0].position = {0.3, 1.8, 0.2};
  p.scene.camera.position = {0, 6, 0.1};
  spectral::settings(p).method = photons::Settings::Method::brute_force;
  spectral::settings(p).caustic = false;
  p.stop.passes = 2;
  const double ratio = believed_over_true_error(p);
  EXPECT_GT(ratio, 0.5);
  EXPECT_LT(ratio, 2);
}

// The spectrum of a pixel that layers keep: against the closed form of a point light over a diffuse plane, and against
// the picture's own colours.

constexpr int size = 16;
constexpr double metres = 1; ///< of the floor, to a side of the picture

/// A floor of a ColorChecker patch seen from straight above: a lamp of illuminant A above it. Layers are kept.
preset::Preset floor_preset() {
  preset::Preset p = empty_preset(size);
  Screen{{0, 0, 0}, metres, size}.fill(p.scene.camera, 2);
  p.scene.materials["orange"] = white();
  p.scene.materials["orange"].reflectance.type = preset::Reflectance::Type::patch;
  p.scene.materials["orange"].reflectance.patch = "orange";
  p.scene.materials["nothing"] = glass(1);
  p.scene.objects.push_back(object("floor", quad(10, 10), "orange"));
  p.scene.lights = {{.spectrum = {.illuminant = "A"}, .power_w = 5, .position = {0.1, 1, -0.2}}};
  p.white = 0.25;
  spectral::settings(p).relight = true;
  spectral::settings(p).direct = true;
  return p;
}

/// W m^-2 sr^-1 nm^-1 that a pixel of the floor sends: rho / pi times the irradiance, Phi / (4 pi) cos / d^2 of a point
/// of Phi W.
std::vector<double> truth(const preset::Preset& p, const std::array<int, 2>& pixel) {
  const preset::Light& light = p.scene.lights[0];
  const double x = ((pixel[0] + 0.5) / size - 0.5) * metres, z = ((pixel[1] + 0.5) / size - 0.5) * metres;
  const double dx = light.position[0] - x, dy = light.position[1], dz = light.position[2] - z;
  const double d = std::sqrt(dx * dx + dy * dy + dz * dz);
  const double irradiance = light.power_w / (4 * M_PI) * (dy / d) / (d * d);
  const optics::Spectrum lamp = optics::illuminant("A"), floor = optics::colorchecker_patch("orange");
  std::vector<double> radiance;
  for (std::size_t w = 0; w < lamp.size(); ++w) radiance.push_back(floor[w] / M_PI * irradiance * lamp[w]);
  return radiance;
}

/// As of the colour that the film adds up, over white.
std::array<double, 3> colour_of(const std::vector<double>& radiance, double white) {
  optics::Spectrum spectrum{};
  for (std::size_t w = 0; w < spectrum.size(); ++w) spectrum[w] = radiance[w] / white;
  return optics::xyz_to_linear_srgb(optics::to_xyz(spectrum));
}

std::unique_ptr<job::Job> finished(const preset::Preset& p) {
  auto job = job_of(p);
  while (!job->finished()) job->advance();
  return job;
}

std::shared_ptr<const job::PixelSpectrum> spectrum_of(job::Job& job, const std::array<int, 2>& pixel) {
  auto* source = dynamic_cast<job::SpectrumSource*>(&job);
  return source ? source->spectrum(pixel) : nullptr;
}

/// The picture's layer in a pixel is the colour of its spectrum, up to the film's single precision.
void expect_colour_of_picture(job::Job& job, const job::PixelSpectrum& spectrum, double white) {
  const job::Snapshot snapshot = job.snapshot();
  for (const job::PixelSpectrum::Layer& part : spectrum.layers) {
    const std::array<double, 3> colour = colour_of(part.radiance, white);
    const std::size_t at = 3 * static_cast<std::size_t>(spectrum.pixel[1] * size + spectrum.pixel[0]);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(layer(snapshot, part.name).rgb[at + c], colour[c], 1e-5 * (std::abs(colour[1]) + 1e-6))
          << part.name << " channel " << c;
  }
}

TEST(PixelSpectrum, OfAPlaneUnderAPointIsTheClosedForm) {
  preset::Preset p = floor_preset();
  p.stop.passes = 64;
  const auto job = finished(p);
  for (const std::array<int, 2> pixel : {std::array{3, 4}, std::array{12, 9}}) {
    const auto spectrum = spectrum_of(*job, pixel);
    ASSERT_NE(spectrum, nullptr);
    EXPECT_EQ(spectrum->why_not, "");
    ASSERT_GE(spectrum->layers.size(), 1u);
    EXPECT_EQ(spectrum->layers[0].name, "direct");
    const std::vector<double> wanted = truth(p, pixel), &found = spectrum->layers[0].radiance;
    ASSERT_EQ(found.size(), wanted.size());
    // 64 samples in a pixel of 6 cm, over which the irradiance changes by 7 % at most: 0.26 %.
    expect_truth("pixel spectrum: direct light of a point over its closed form at 600 nm", found[220] / wanted[220], 1,
                 0.01);
    for (std::size_t w = 0; w < wanted.size(); ++w)
      EXPECT_NEAR(found[w] / found[220], wanted[w] / wanted[220], 1e-6)
          << "the form does not hang on the samples; " << w + 380 << " nm";
    expect_colour_of_picture(*job, *spectrum, p.white.value_or(1));
  }
}

TEST(PixelSpectrum, OfLightThroughGlassIsClusterByCluster) {
  preset::Preset p = floor_preset();
  // A sheet that bends nothing (n = 1), out of the camera's sight of the floor: the light comes as from the point
  // itself, and the clusters are of 40 nm each.
  p.scene.objects.push_back(object("sheet", box(8, 0.01, 8), "nothing", at({0, 0.5, 0})));
  p.scene.camera.position[1] = 0.45;
  Screen{{0, 0, 0}, metres, size}.fill(p.scene.camera, 0.45);
  spectral::settings(p).method = photons::Settings::Method::brute_force;
  spectral::settings(p).step_nm = 40;
  spectral::settings(p).photons_per_pass = 1 << 17;
  p.stop.passes = 32;
  const auto job = finished(p);
  std::vector<double> mean(optics::wavelength_count, 0), wanted(optics::wavelength_count, 0);
  for (int y = 4; y < 12; ++y)
    for (int x = 4; x < 12; ++x) {
      const auto spectrum = spectrum_of(*job, {x, y});
      ASSERT_EQ(spectrum->layers.size(), 2u);
      EXPECT_EQ(spectrum->layers[1].name, "caustic");
      const std::vector<double> form = truth(p, {x, y});
      for (std::size_t w = 0; w < mean.size(); ++w) {
        mean[w] += spectrum->layers[0].radiance[w] + spectrum->layers[1].radiance[w];
        wanted[w] += form[w];
      }
    }
  for (const int nm : {400, 480, 540, 600, 700}) {
    const auto w = static_cast<std::size_t>(nm - optics::first_nm);
    // Some 7000 photons a cluster: 1.2 %.
    expect_truth("pixel spectrum: light through a sheet of n = 1 over its closed form at " + std::to_string(nm) + " nm",
                 mean[w] / wanted[w], 1, 0.06);
  }
  expect_colour_of_picture(*job, *spectrum_of(*job, {7, 8}), p.white.value_or(1));
}

TEST(PixelSpectrum, FollowsAnotherLight) {
  preset::Preset p = floor_preset();
  p.stop.passes = 4;
  const auto job = finished(p);
  const std::vector<double> before = spectrum_of(*job, {5, 5})->layers[0].radiance;
  p.scene.lights[0].power_w = 15;
  ASSERT_TRUE(job->adopt(p));
  const auto after = spectrum_of(*job, {5, 5});
  for (std::size_t w = 0; w < before.size(); w += 50)
    EXPECT_NEAR(after->layers[0].radiance[w], 3 * before[w], 1e-9 * before[w]);
}

TEST(PixelSpectrum, WithoutLayersSaysWhatToSwitchOn) {
  preset::Preset p = floor_preset();
  spectral::settings(p).relight = false;
  p.stop.passes = 1;
  const auto job = finished(p);
  const auto spectrum = spectrum_of(*job, {5, 5});
  ASSERT_NE(spectrum, nullptr);
  EXPECT_TRUE(spectrum->layers.empty());
  EXPECT_THAT(spectrum->why_not, HasSubstr("spectral.relight"));
  EXPECT_EQ(spectrum->remedy, "spectral.relight=true");
  spectral::settings(p).indirect = true;
  const auto none = spectrum_of(*finished(p), {5, 5});
  EXPECT_THAT(none->why_not, HasSubstr("but not here: spectral.indirect is light that met several reflectors"));
  EXPECT_EQ(none->remedy, "") << "layers are not offered where they cannot be";
  EXPECT_EQ(spectrum_of(*job, {5, size}), nullptr) << "outside of the picture";
  EXPECT_EQ(spectrum_of(*job, {-1, 5}), nullptr);
}

} // namespace nephroid::wavelength_jitter_test
