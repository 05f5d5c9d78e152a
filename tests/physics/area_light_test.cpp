// SPDX-License-Identifier: Apache-2.0
// Photons of a large area light leave every place in every direction: where place and direction had random numbers in common, a floor close
// to the light would show it, and a far one would not.
#include "compute/compute.h"
#include "optics/colour.h"
#include "scene/scene.h"
#include "spectral/engine.h"
#include "tests/support/render.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace nephroid;
using namespace nephroid::test;

namespace {

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
  p.spectral.direct = !sheet;
  p.spectral.caustic = sheet;
  p.spectral.pixel_samples = 1024;
  p.spectral.photons_per_pass = 1 << 18;
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

} // namespace
