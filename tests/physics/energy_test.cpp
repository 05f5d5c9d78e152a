// SPDX-License-Identifier: Apache-2.0
// No light is made and none disappears: every photon of every shipped preset ends somewhere, and what ends nowhere is little.
#include "compute/compute.h"
#include "preset/read.h"
#include "scene/scene.h"
#include "spectral/engine.h"
#include "tests/support/closed_form.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

using namespace nephroid;
using namespace nephroid::test;

namespace {

/// Every run of a shipped preset, small and short: energy does not depend on the camera.
std::vector<preset::Preset> small_runs(const std::string& name)
{
  std::vector<preset::Preset> runs = preset::read_presets(name);
  for (preset::Preset& p : runs) {
    p.scene.camera.resolution = {16, 16};
    p.spectral.direct = false;
    p.spectral.photons_per_pass = std::min(p.spectral.photons_per_pass, 1 << 14);
    p.stop = {};
    p.stop.passes = 1;
    p.reference.reset();
    p.measure = {};
  }
  return runs;
}

/// The share of the emitted power that may be lost.
double largest_loss(const preset::Preset&) { return 1e-3; }

class ShippedPreset : public testing::TestWithParam<std::string> {};

// A photon is counted as it starts and as it ends, in quanta of power, so the balance is exact but for the rounding of the sums to watts.
// Losses are paths with more than max_surfaces interfaces. With that raised as far as it goes they all end: total reflection keeps light in
// glass for ever only where shape and start are special (a cube, lit from inside), and chance ends a path as soon as one of its
// angles lets it.
TEST_P(ShippedPreset, AccountsForItsEnergy)
{
  for (const preset::Preset& p : small_runs(GetParam())) {
    const job::EnergyBalance e = render(p).energy;
    EXPECT_EQ(e.refused_contributions, 0u) << p.name;
    for (const double part : {e.emitted_w, e.deposited_w, e.missed_w, e.absorbed_w, e.escaped_w, e.lost_w}) EXPECT_GE(part, 0) << p.name;
    expect_truth("energy: accounted for / emitted, " + p.name,
                 e.emitted_w > 0 ? (e.deposited_w + e.missed_w + e.absorbed_w + e.escaped_w + e.lost_w) / e.emitted_w : 1, 1, 1e-12);
    expect_truth("energy: lost / emitted, " + p.name, e.emitted_w > 0 ? e.lost_w / e.emitted_w : 0, 0, largest_loss(p));
  }
}

std::vector<std::string> shipped_names()
{
  std::vector<std::string> names;
  for (const preset::ShippedPreset& shipped : preset::shipped_presets()) names.push_back(shipped.name);
  return names;
}

std::string test_name(const testing::TestParamInfo<std::string>& parameter)
{
  std::string name = parameter.param;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, ShippedPreset, testing::ValuesIn(shipped_names()), test_name);

} // namespace
