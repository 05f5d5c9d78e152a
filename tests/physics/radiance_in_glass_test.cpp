// SPDX-License-Identifier: Apache-2.0
// Radiance changes at an interface: what a path keeps is L / n^2 (Nicodemus 1963, "Radiance"). Paths that enter glass and leave it again
// say nothing of that, because n cancels; so here the lit surface is inside the glass and the eye outside.
#include "optics/spectrum.h"
#include "tests/support/render.h"
#include "tests/support/test.h"

namespace nephroid::radiance_in_glass_test {

// A white sheet and a lamp of intensity I = P / (4 pi) inside a block of glass, seen from above along the normal. The sheet has the
// radiance L = I cos(theta) / (pi d^2); of that the eye gets (1 - R) L / n^2 with R = ((n - 1) / (n + 1))^2 at normal incidence.
TEST(RadianceInGlass, IsDividedByTheSquareOfTheIndexOnTheWayOut)
{
  constexpr double n = 1.5, power = 5;
  preset::Preset p = empty_preset(9);
  p.scene.materials = {{"white", white()}, {"glass", glass(n)}};
  p.scene.objects = {object("block", box(4, 1, 4), "glass"), object("sheet", quad(2, 2), "white", at({0, -0.3, 0}))};
  preset::Light lamp;
  lamp.spectrum.illuminant = "E";
  lamp.position = {0.3, 0.2, 0.1};
  lamp.power_w = power;
  p.scene.lights = {lamp};
  p.scene.camera.position = {0, 2, 0};
  p.scene.camera.target = {0, 0, 0};
  p.scene.camera.up = {0, 0, -1};
  p.scene.camera.fov_deg = 1; // over 4 cm the radiance is linear to 1e-3, and R that of normal incidence
  spectral::settings(p).direct = true;
  spectral::settings(p).caustic = false;
  p.stop.passes = 64;

  double mean = 0;
  const job::Snapshot snapshot = render(p);
  const std::vector<float>& rgb = layer(snapshot, "direct").rgb;
  for (std::size_t i = 0; i < rgb.size(); i += 3) mean += optics::linear_srgb_to_xyz({rgb[i], rgb[i + 1], rgb[i + 2]})[1] / (9 * 9);

  const double d2 = 0.3 * 0.3 + 0.5 * 0.5 + 0.1 * 0.1, cosine = 0.5 / std::sqrt(d2);
  const double radiance = power / (4 * M_PI) * cosine / d2 / M_PI, reflected = std::pow((n - 1) / (n + 1), 2);
  const double truth = (1 - reflected) * radiance / (n * n) * optics::to_xyz(optics::illuminant("E"))[1];
  // 4 x 64 x 81 paths are reflected with a chance of 4 %: the mean is known to 0.14 %, of which 1 % is seven times.
  EXPECT_NEAR(mean / truth, 1, 0.01);
}

} // namespace nephroid::radiance_in_glass_test
