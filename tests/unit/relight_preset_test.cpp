// SPDX-License-Identifier: Apache-2.0
// Which edits are another light on the same scene.
#include "spectral/engine.h"
#include "tests/support/presets.h"
#include "tests/support/test.h"

namespace nephroid::relight_preset_test {

preset::Preset layered()
{
  preset::Preset p = test::empty_preset(8);
  spectral::settings(p).relight = true;
  p.scene.lights.resize(2);
  return p;
}

TEST(OnlyRelit, IsAnotherSpectrumPowerWhiteOrName)
{
  const preset::Preset before = layered();
  preset::Preset now = before;
  EXPECT_TRUE(spectral::adoptable(before, now));
  now.scene.lights[1].spectrum.illuminant = "F10";
  now.scene.lights[1].power_w = 0;
  now.scene.lights[0].irradiance_w_m2 = 7;
  now.white = 3;
  now.name = "evening";
  EXPECT_TRUE(spectral::adoptable(before, now));
}

TEST(OnlyRelit, IsNothingElse)
{
  const preset::Preset before = layered();
  const auto differs = [&](auto change) {
    preset::Preset now = before;
    change(now);
    return !spectral::adoptable(before, now);
  };
  EXPECT_TRUE(differs([](preset::Preset& p) { spectral::settings(p).relight = false; }));
  EXPECT_TRUE(differs([](preset::Preset& p) { p.scene.lights.pop_back(); }));
  EXPECT_TRUE(differs([](preset::Preset& p) { p.scene.lights[0].position[0] += 1; }));
  EXPECT_TRUE(differs([](preset::Preset& p) { p.scene.lights[0].type = preset::Light::Type::spot; }));
  EXPECT_TRUE(differs([](preset::Preset& p) { p.scene.camera.fov_deg += 1; }));
  EXPECT_TRUE(differs([](preset::Preset& p) { p.seed += 1; }));
  EXPECT_TRUE(differs([](preset::Preset& p) { spectral::settings(p).threshold_deg *= 2; }));
  EXPECT_TRUE(differs([](preset::Preset& p) { p.stop.passes = 3; }));
  preset::Preset without = before;
  spectral::settings(without).relight = false;
  EXPECT_FALSE(spectral::adoptable(without, without)) << "a run without layers has nothing to weigh";
}

} // namespace nephroid::relight_preset_test
