// SPDX-License-Identifier: Apache-2.0
// Every shipped preset makes a picture with the general kernels: finite, lit, its layers adding up, its energy
// accounted for, and noise falling as it should. statistics_test.cpp renders with those of the scene.
#include "preset/read.h"
#include "spectral/settings.h"
#include "tests/support/render.h"
#include "tests/support/test.h"

namespace nephroid::shipped_presets_test {

/// Those of engine 1.
std::vector<std::string> shipped_names() {
  std::vector<std::string> names;
  for (const preset::ShippedPreset& shipped : preset::shipped_presets())
    if (preset::read_presets(shipped.name).front().settings.engine() == "spectral") names.push_back(shipped.name);
  return names;
}

/// The preset small and short, so that all of them take seconds; of a sweep its first run.
preset::Preset small(const std::string& name) {
  preset::Preset p = preset::read_presets(name).front();
  p.scene.camera.resolution = {64, 64};
  // Progressive photon maps send these for each of up to 401 clusters.
  const bool for_each_cluster = spectral::settings(p).estimator == photons::Settings::Estimator::sppm;
  spectral::settings(p).photons_per_pass = for_each_cluster ? 1 << 8 : 1 << 15;
  p.stop.seconds.reset();
  p.stop.passes = 2;
  return p;
}

class ShippedPreset : public testing::TestWithParam<std::string> {};

TEST_P(ShippedPreset, MakesASoundPicture) {
  const preset::Preset p = small(GetParam());
  const job::Snapshot snapshot = render(p);
  const job::Picture& picture = *snapshot.picture;
  ASSERT_EQ(picture.rgb.size(), 3u * 64 * 64);
  EXPECT_TRUE(std::all_of(picture.rgb.begin(), picture.rgb.end(), [](float v) { return std::isfinite(v); }));
  const std::vector<float>& caustic = layer(snapshot, "caustic").rgb;
  EXPECT_GT(std::accumulate(caustic.begin(), caustic.end(), 0.0), 0);
  for (std::size_t i = 0; i < picture.rgb.size(); ++i) {
    float total = 0;
    for (const job::Layer& one : picture.layers) total += one.rgb[i];
    ASSERT_EQ(picture.rgb[i], total);
  }
  const photons::EnergyBalance& e = photons::energy_of(snapshot);
  EXPECT_GT(e.emitted_w, 0);
  for (const double part : {e.deposited_w, e.missed_w, e.absorbed_w, e.escaped_w, e.lost_w}) EXPECT_GE(part, 0);
  // A photon is counted as it starts and as it ends, in quanta of power: the balance is exact but for the rounding of
  // the sums to watts.
  EXPECT_NEAR(e.deposited_w + e.missed_w + e.absorbed_w + e.escaped_w + e.lost_w, e.emitted_w, 1e-12 * e.emitted_w);
  // Lost is what met 32 interfaces, as one photon of two thousand does in a bunny of flint; six standard deviations
  // above twice that.
  EXPECT_LT(e.lost_w, (1e-3 + 6 * std::sqrt(1e-3 / spectral::settings(p).photons_per_pass)) * e.emitted_w);
  EXPECT_EQ(e.refused_contributions, 0u);
}

// Two seeds of one pass and of sixteen: the mean square of their difference falls by sixteen, because an unbiased
// estimate's variance falls with the number of photons. The pixels' differences are heavy-tailed, so the bounds are
// wide.
TEST(Noise, FallsWithThePhotons) {
  const auto mean_square = [](int passes) {
    preset::Preset p = small("first-light");
    spectral::settings(p).direct = false;
    p.stop.passes = passes;
    const job::Snapshot a = render(p);
    p.seed = 2;
    const job::Snapshot b = render(p);
    double total = 0;
    for (std::size_t i = 0; i < a.picture->rgb.size(); ++i)
      total += std::pow(double(a.picture->rgb[i]) - b.picture->rgb[i], 2);
    return total;
  };
  const double ratio = mean_square(1) / mean_square(16);
  EXPECT_GT(ratio, 8);
  EXPECT_LT(ratio, 32);
}

// The prism's spectrum, read across the picture: dominant colours go from violet over blue, green and yellow to red
// without turning back. The hue angle of linear sRGB, from the channels' projection, says where a column stands.
TEST(Prism, ColoursComeInTheOrderOfTheirWavelengths) {
  preset::Preset p = small("spectral/prism");
  p.scene.camera.resolution = {128, 128};
  spectral::settings(p).photons_per_pass = 1 << 18;
  const job::Snapshot snapshot = render(p);
  const job::Layer& caustic = layer(snapshot, "caustic");
  std::vector<std::array<double, 3>> columns(128, {0, 0, 0});
  for (std::size_t i = 0; i < caustic.rgb.size(); ++i) columns[i / 3 % 128][i % 3] += caustic.rgb[i];
  double brightest = 0;
  for (const auto& c : columns) brightest = std::max(brightest, c[0] + c[1] + c[2]);
  // The centre of each primary's light along the row of columns.
  std::array<double, 3> centre{}, weight{};
  for (std::size_t x = 0; x < 128; ++x)
    for (std::size_t c = 0; c < 3; ++c) {
      const double light = std::max(columns[x][c] - (columns[x][(c + 1) % 3] + columns[x][(c + 2) % 3]) / 2, 0.0);
      if (light < 0.02 * brightest) continue;
      centre[c] += light * static_cast<double>(x);
      weight[c] += light;
    }
  for (std::size_t c = 0; c < 3; ++c) {
    ASSERT_GT(weight[c], 0) << "channel " << c << " of a brightest column of " << brightest;
    centre[c] /= weight[c];
  }
  const bool rising = centre[0] > centre[1] && centre[1] > centre[2],
             falling = centre[0] < centre[1] && centre[1] < centre[2];
  EXPECT_TRUE(rising || falling) << "red " << centre[0] << ", green " << centre[1] << ", blue " << centre[2];
}

INSTANTIATE_TEST_SUITE_P(All, ShippedPreset, testing::ValuesIn(shipped_names()), [](const auto& parameters) {
  std::string name = parameters.param;
  std::ranges::replace_if(
      name, [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
});

} // namespace nephroid::shipped_presets_test
