// SPDX-License-Identifier: Apache-2.0
// A path from the eye that glass has split shows a part of the spectrum, each wavelength where it goes: a lamp of three
// lines looks as three lamps of a line each, whose paths have one way (kernels/transport/sweep.h).
#include "spectral/settings.h"
#include "tests/support/closed_form.h"

#include <numeric>

namespace nephroid::sweep_test {

using Rgb = std::vector<double>;

/// A ball before a striped floor, whose edges it shows with colours.
preset::Preset stripes_behind_a_ball() {
  preset::Preset p = empty_preset(32);
  p.scene.materials["glass"] = glass(1.5);
  p.scene.materials["glass"].dispersion.type = preset::Dispersion::Type::cauchy;
  p.scene.materials["glass"].dispersion.coefficients = {1.45, 0.03};
  p.scene.materials["dark"] = white(0.05);
  p.scene.materials["bright"] = white(0.9);
  p.scene.objects = {object("ball", check::ball(0.7), "glass", at({0, 1, 0})), object("floor", quad(20, 20), "dark")};
  for (int i = -6; i < 3; ++i)
    p.scene.objects.push_back(object("stripe" + std::to_string(i), quad(20, 0.4), "bright", at({0, 0.01, 0.8 * i})));
  p.scene.camera.position = {0, 2, 3};
  p.scene.camera.target = {0, 0.9, 0};
  p.scene.camera.fov_deg = 30;
  p.scene.lights = {{.type = preset::Light::Type::directional, .irradiance_w_m2 = 3, .direction = {0.9, -0.5, -0.2}}};
  p.scene.lights[0].spectrum.type = preset::LightSpectrum::Type::lines;
  spectral::settings(p).caustic = false;
  spectral::settings(p).indirect = false;
  spectral::settings(p).direct = true;
  return p;
}

Rgb direct_light(const preset::Preset& p) {
  const job::Snapshot snapshot = render(p);
  const std::vector<float>& rgb = layer(snapshot, "direct").rgb;
  return {rgb.begin(), rgb.end()};
}

double size(const Rgb& a) { return std::sqrt(std::inner_product(a.begin(), a.end(), a.begin(), 0.0)); }

Rgb sum(const Rgb& a, const Rgb& b, double factor = 1) {
  Rgb result(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) result[i] = a[i] + factor * b[i];
  return result;
}

/// How far a run with all lines is from runs of a line each, over these; and the sums of both.
struct Lines {
  double distance, light, light_apart;
};
Lines lines_of(preset::Preset p) {
  const std::vector<double> lines{460, 540, 620};
  preset::Light& lamp = p.scene.lights[0];
  for (const double nm : lines) lamp.spectrum.table.push_back({nm, 1});
  p.stop.passes = 32; // in which every path has the whole spectrum
  const Rgb together = direct_light(p);
  Rgb apart(together.size());
  lamp.irradiance_w_m2 /= static_cast<double>(lines.size());
  p.stop.passes = 256;
  for (const double nm : lines) {
    lamp.spectrum.table = {{nm, 1}};
    apart = sum(apart, direct_light(p));
  }
  return {size(sum(together, apart, -1)) / size(apart), std::accumulate(together.begin(), together.end(), 0.0),
          std::accumulate(apart.begin(), apart.end(), 0.0)};
}

TEST(Sweep, ShowsEachLineOfALampWhereItGoes) {
  const Lines lines = lines_of(stripes_behind_a_ball());
  EXPECT_LT(lines.distance, 0.11); // .075 to .085 is noise; .17 where all stay with the leader, .26 the other way
  EXPECT_NEAR(lines.light, lines.light_apart, 0.015 * lines.light_apart); // .005 was seen
}

// A layer on the ball reflects each line otherwise.
TEST(Sweep, LeavesEachLineWhatACoatingDoes) {
  preset::Preset p = stripes_behind_a_ball();
  p.scene.materials["glass"].coating = {.dispersion = glass(2.4).dispersion, .thickness_nm = 400};
  const Lines lines = lines_of(p);
  EXPECT_LT(lines.distance, 0.11);
  EXPECT_NEAR(lines.light, lines.light_apart, 0.015 * lines.light_apart);
}

} // namespace nephroid::sweep_test
