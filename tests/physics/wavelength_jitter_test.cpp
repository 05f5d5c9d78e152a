// SPDX-License-Identifier: Apache-2.0
// One path for a whole cluster is biased; one wavelength of the cluster for each path is not, however coarse the clusters are. The truth is
// brute force, a path for every wavelength. Low-discrepancy numbers and photons dealt by variance have to keep the expectation too. The
// two halves of a film, from which a run tells its own error, have to be independent whatever the paths follow.
#include "tests/support/leaving_out_scenes.h"
#include "tests/support/passes.h"
#include "tests/support/test.h"

namespace nephroid::wavelength_jitter_test {

/// Strong dispersion, so that a whole cluster's mean n is far from most of its wavelengths', over a floor that is not grey. Photons take
/// whole clusters, are independent, and are dealt by power: what a test is about it turns on.
preset::Preset dispersing_ball(bool absorbing)
{
  preset::Preset p = ball_scene();
  p.scene.materials["glass"].dispersion.coefficients = {1.4, 0.04};
  p.scene.lights[0].spectrum.illuminant = "A";
  p.scene.materials["white"].reflectance.type = preset::Reflectance::Type::patch;
  p.scene.materials["white"].reflectance.patch = "foliage";
  if (absorbing) {
    p.scene.materials["mirror"] = mirror(0.5);
    p.scene.materials["mirror"].reflectance.type = preset::Reflectance::Type::patch;
    p.scene.materials["mirror"].reflectance.patch = "orange";
    p.scene.objects.push_back(object("mirror", quad(1, 1), "mirror", at({0.8, 0.05, 0})));
  }
  spectral::settings(p).photons_per_pass = 1 << 13;
  spectral::settings(p).jitter = spectral::settings(p).low_discrepancy = false;
  spectral::settings(p).effort = spectral::Settings::Effort::power;
  p.stop.passes = 24;
  return p;
}

/// Linear sRGB of the picture in 3 x 3 blocks, and the watts of the energy balance.
std::vector<double> figures(const job::Snapshot& snapshot)
{
  const std::vector<float>& rgb = snapshot.picture->rgb;
  const int size = snapshot.picture->width, block = size / 3;
  std::vector<double> sums(27);
  for (int row = 0; row < size; ++row)
    for (int column = 0; column < size; ++column)
      for (int c = 0; c < 3; ++c)
        sums[static_cast<std::size_t>(3 * (3 * (row / block) + column / block) + c)] +=
            rgb[static_cast<std::size_t>(3 * (row * size + column) + c)];
  for (const double watts :
       {spectral::energy_of(snapshot).emitted_w, spectral::energy_of(snapshot).deposited_w, spectral::energy_of(snapshot).absorbed_w})
    sums.push_back(watts);
  return sums;
}

/// Sidak's p-value of the worst figure of two runs that should have one expectation.
double p_of_same(const std::vector<Estimate>& a, const std::vector<Estimate>& b)
{
  double worst = 1;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Estimate both{a[i].mean - b[i].mean, a[i].variance + b[i].variance, std::min(a[i].degrees, b[i].degrees)};
    worst = std::min(worst, p_value(both, 0, 1e-6 * std::abs(a[i].mean)));
  }
  return sidak(worst, static_cast<double>(a.size()));
}

class WavelengthJitter : public testing::TestWithParam<bool> {};

TEST_P(WavelengthJitter, HasTheExpectationOfBruteForce)
{
  preset::Preset p = dispersing_ball(GetParam());
  spectral::settings(p).method = spectral::Settings::Method::brute_force;
  const std::vector<Estimate> truth = render_passes(p, figures);
  p.seed = 2;
  spectral::settings(p).method = spectral::Settings::Method::optimal;
  spectral::settings(p).threshold_deg = 80; // one cluster
  spectral::settings(p).jitter = true;
  EXPECT_GT(p_of_same(render_passes(p, figures), truth), false_alarm);
  p.seed = 3;
  spectral::settings(p).low_discrepancy = true;
  spectral::settings(p).threshold_deg = 0.5;
  EXPECT_GT(p_of_same(render_passes(p, figures), truth), false_alarm);
  p.seed = 4;
  spectral::settings(p).effort = spectral::Settings::Effort::variance;
  EXPECT_GT(p_of_same(render_passes(p, figures), truth), false_alarm);
}

INSTANTIATE_TEST_SUITE_P(, WavelengthJitter, testing::Bool(), [](const auto& test) { return test.param ? "WithColouredMirror" : "Glass"; });

// Without jitter one cluster sends all wavelengths the way of one: it differs from brute force far beyond the noise.
TEST(WholeClusters, AreBiased)
{
  preset::Preset p = dispersing_ball(false);
  spectral::settings(p).photons_per_pass = 1 << 16;
  spectral::settings(p).method = spectral::Settings::Method::brute_force;
  const std::vector<Estimate> truth = render_passes(p, figures);
  p.seed = 2;
  spectral::settings(p).method = spectral::Settings::Method::optimal;
  spectral::settings(p).threshold_deg = 80;
  EXPECT_LT(p_of_same(render_passes(p, figures), truth), false_alarm);
}

// The sequence spreads photons more evenly than chance does: behind glass that bends nothing (n = 1 + 1e-6) a floor's irradiance is smooth,
// and its pixels scatter far less about their mean.
TEST(LowDiscrepancy, SpreadsPhotonsEvenly)
{
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

/// The squares of what runs take for their own error, of two runs each of eight pairs, over the squares of the pairs' differences: 1 in the
/// mean, for such a draw has the variance of the picture, and a difference twice that.
double believed_over_true_error(preset::Preset p)
{
  double draws = 0, differences = 0;
  const auto square = [](double x) { return x * x; };
  for (int pair = 0; pair < 8; ++pair) {
    ++p.seed;
    const job::Snapshot a = render(p);
    ++p.seed;
    const job::Snapshot b = render(p);
    const std::vector<float>&draw_a = a.picture->error_draw, &draw_b = b.picture->error_draw;
    if (draw_a.empty() || draw_b.empty()) throw std::logic_error("believed_over_true_error: the run has no estimate of its error");
    for (std::size_t i = 0; i < draw_a.size(); ++i) {
      draws += square(draw_a[i]) + square(draw_b[i]);
      differences += square(a.picture->rgb[i] - b.picture->rgb[i]);
    }
  }
  return draws / differences;
}

// A run takes its error for the difference of the film's halves, so they have to be independent, each with sequences of its own. Where
// glass bends nothing and reflects nothing, how a photon starts is all that is random: halves that follow the same sequence would be the
// same picture. The ratio, of thousands of pixels, scatters by 0.06; a factor of 2 is more than ten times that.
TEST(HalvesOfTheFilm, PhotonsFollowIndependentSequences)
{
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
TEST(HalvesOfTheFilm, EyePathsTakeIndependentClusters)
{
  preset::Preset p = dispersing_ball(false);
  p.scene.materials["glass"].dispersion.coefficients = {1.01, 0.001};
  p.scene.objects[0].shape = box(6, 0.02, 6);
  p.scene.objects[0].transform.translate = {0, 2, 0};
  p.scene.lights[0].position = {0.3, 1.8, 0.2};
  p.scene.camera.position = {0, 6, 0.1};
  spectral::settings(p).method = spectral::Settings::Method::brute_force;
  spectral::settings(p).caustic = false;
  p.stop.passes = 2;
  const double ratio = believed_over_true_error(p);
  EXPECT_GT(ratio, 0.5);
  EXPECT_LT(ratio, 2);
}

} // namespace nephroid::wavelength_jitter_test
