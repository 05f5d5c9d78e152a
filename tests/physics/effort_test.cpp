// SPDX-License-Identifier: Apache-2.0
// Which clusters photons are dealt to changes the noise of a picture and not what it shows.
#include "tests/support/leaving_out_scenes.h"
#include "tests/support/passes.h"
#include "tests/support/render.h"
#include "tests/support/test.h"

namespace nephroid::effort_test {

using Effort = spectral::Settings::Effort;

/// X, Y and Z of the layer "caustic", and the power that came down.
std::vector<double> caustic_colour(const job::Snapshot& snapshot)
{
  const std::vector<float>& rgb = layer(snapshot, "caustic").rgb;
  optics::Colour sum{};
  for (std::size_t i = 0; i < rgb.size(); ++i) sum[i % 3] += rgb[i];
  const optics::Colour xyz = optics::linear_srgb_to_xyz(sum);
  return {xyz[0], xyz[1], xyz[2], spectral::energy_of(snapshot).deposited_w};
}

/// A ball under daylight and a candle, on a floor that reflects no blue below 480 nm, to which (4.15) gives no importance.
preset::Preset scene_by(Effort effort, std::uint64_t seed)
{
  preset::Preset p = ball_scene();
  p.seed = seed;
  p.scene.lights.push_back(p.scene.lights[0]);
  p.scene.lights[1].spectrum.illuminant = "A";
  p.scene.lights[1].position = {-0.5, 2.2, 0};
  preset::Reflectance& floor = p.scene.materials["white"].reflectance;
  floor.type = preset::Reflectance::Type::table;
  floor.table = {{479, 0}, {480, 0.8}};
  spectral::settings(p).direct = false;
  spectral::settings(p).effort = effort;
  p.stop.passes = 24;
  return p;
}

class DealtEffort : public testing::TestWithParam<Effort> {};

TEST_P(DealtEffort, LeavesThePictureAsItIs)
{
  static const std::vector<Estimate> power = render_passes(scene_by(Effort::power, 1), caustic_colour);
  const std::vector<Estimate> other = render_passes(scene_by(GetParam(), 1000), caustic_colour);
  double smallest = 1;
  for (std::size_t i = 0; i < power.size(); ++i) {
    const Estimate difference{power[i].mean - other[i].mean, power[i].variance + other[i].variance, power[i].degrees};
    smallest = std::min(smallest, p_value(difference, 0));
    EXPECT_GT(other[i].mean, 30 * other[i].error()); // enough photons to tell
  }
  EXPECT_GT(sidak(smallest, 4), false_alarm);
}

INSTANTIATE_TEST_SUITE_P(Choices, DealtEffort, testing::Values(Effort::equal, Effort::importance, Effort::radziszewski));

} // namespace nephroid::effort_test
