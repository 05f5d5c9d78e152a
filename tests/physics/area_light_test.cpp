// SPDX-License-Identifier: Apache-2.0
// Photons of a large area light leave every place in every direction: where place and direction had random numbers in common, a floor close
// to the light would show it, and a far one would not. So with plain random numbers, against direct light, and with low-discrepancy ones,
// against the closed form of a rectangle's irradiance.
#include "tests/support/closed_form.h"
#include "tests/support/passes.h"

namespace nephroid::area_light_test {

/// A floor below a panel of 1.6 m by 1.6 m at height 1, seen from half that height; with or without a sheet of n = 1 under the panel.
preset::Preset floor_under_a_panel(bool sheet)
{
  preset::Preset p = empty_preset(8);
  p.scene.materials = {{"white", white()}, {"nothing", glass(1)}};
  p.scene.objects = {object("floor", quad(10, 10), "white")};
  if (sheet) p.scene.objects.push_back(object("sheet", box(8, 0.01, 8), "nothing", at({0, 0.9, 0})));
  preset::Light panel;
  panel.type = preset::Light::Type::area;
  panel.spectrum.illuminant = "E";
  panel.position = {0.3, 1, -0.4};
  panel.direction = {0, -1, 0};
  panel.size = {1.6, 1.6};
  p.scene.lights = {panel};
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

// What crossed the sheet is the light itself, so its picture is the one that direct light makes, whose places on the panel are drawn by
// other code. A pixel has 1024 samples there, which are 1 % of noise, and some 2000 photons here, 3 %.
TEST(AreaLight, PhotonsMakeTheDirectPictureOfALargePanel)
{
  const job::Snapshot direct = render(floor_under_a_panel(false)), photons = render(floor_under_a_panel(true));
  const std::vector<float>&truth = layer(direct, "direct").rgb, &picture = layer(photons, "caustic").rgb;
  double mean = 0, worst = 0;
  for (std::size_t i = 0; i < truth.size(); i += 3) {
    const auto luminance = [&](const std::vector<float>& rgb) { return optics::linear_srgb_to_xyz({rgb[i], rgb[i + 1], rgb[i + 2]})[1]; };
    const double ratio = luminance(picture) / luminance(truth);
    mean += ratio / 64;
    worst = std::max(worst, std::abs(ratio - 1));
  }
  EXPECT_NEAR(mean, 1, 0.03);
  EXPECT_LT(worst, 0.25);
}

/// Of a surface element under a parallel panel at `height`, the part of the hemisphere, weighed by the cosine, that the panel's corner
/// fills between the foot of the perpendicular and a by b aside of it (Howell's catalogue of view factors, B-4).
double corner_factor(double a, double b, double height)
{
  const double u = std::hypot(a, height), v = std::hypot(b, height);
  return (a / u * std::atan(b / u) + b / v * std::atan(a / v)) / (2 * M_PI);
}

/// Irradiance of the floor at (x, z): the panel's exitance times its view factor, corner by corner.
double irradiance(const preset::Light& panel, double x, double z)
{
  const double right = panel.position[0] + panel.size[0] / 2 - x, far = panel.position[2] + panel.size[1] / 2 - z, h = panel.position[1];
  const double left = right - panel.size[0], near = far - panel.size[1];
  const double factor =
      corner_factor(right, far, h) - corner_factor(left, far, h) - corner_factor(right, near, h) + corner_factor(left, near, h);
  return panel.power_w / (panel.size[0] * panel.size[1]) * factor;
}

/// The power on every pixel's square of the floor, and on all together. The midpoint rule over 16 parts of a pixel each way is off by 1e-4
/// of it at most.
std::vector<double> power_on(const Screen& screen, const preset::Light& panel)
{
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

/// The same as `runs` short runs have it, each with a seed of its own. Their sequences are independent, so their scatter says how well the
/// mean is known.
std::vector<Estimate> rendered_power(preset::Preset p, const Screen& screen, int runs)
{
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

TEST(AreaLight, LowDiscrepancyPhotonsMakeThePanelsIrradiance)
{
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

} // namespace nephroid::area_light_test
