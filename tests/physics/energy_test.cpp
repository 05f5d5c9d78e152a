// SPDX-License-Identifier: Apache-2.0
// No light is made and none disappears: every photon of every shipped preset ends somewhere, and what ends nowhere is little.
#include "spectral/energy.h"
#include "tests/support/closed_form.h"
#include "tests/support/shipped_presets.h"

namespace nephroid::energy_test {

/// Every run of a shipped preset, small and short: energy does not depend on the camera.
std::vector<preset::Preset> small_runs(const std::string& name)
{
  std::vector<preset::Preset> runs = preset::read_presets(name);
  for (preset::Preset& p : runs) {
    p.scene.camera.resolution = {16, 16};
    spectral::settings(p).direct = false;
    send_few_photons(p, 1 << 16);
    p.stop = {};
    p.stop.passes = 1;
    p.reference.reset();
    p.measure = {};
  }
  return runs;
}

/// The share of the emitted power that may be lost: met 32 interfaces, which one photon of two thousand does in a bunny of flint.
constexpr double largest_loss = 1e-3;

bool is_balanced(const spectral::EnergyBalance& e)
{
  const double parts = e.deposited_w + e.missed_w + e.absorbed_w + e.escaped_w + e.lost_w;
  return std::abs(parts - e.emitted_w) <= 1e-12 * e.emitted_w;
}

class ShippedPreset : public testing::TestWithParam<std::string> {};

// A photon is counted as it starts and as it ends, in quanta of power, so the balance is exact but for the rounding of the sums to watts.
TEST_P(ShippedPreset, AccountsForItsEnergy)
{
  for (const preset::Preset& p : small_runs(GetParam())) {
    const spectral::EnergyBalance e = spectral::energy_of(render(p));
    EXPECT_EQ(e.refused_contributions, 0u) << p.name;
    for (const double part : {e.deposited_w, e.missed_w, e.absorbed_w, e.escaped_w, e.lost_w}) EXPECT_GE(part, 0) << p.name;
    ASSERT_GT(e.emitted_w, 0) << p.name;
    EXPECT_TRUE(is_balanced(e)) << p.name;
    expect_truth("energy: accounted for / emitted, " + GetParam(),
                 (e.deposited_w + e.missed_w + e.absorbed_w + e.escaped_w + e.lost_w) / e.emitted_w, 1, 1e-12);
    expect_truth("energy: lost / emitted, " + GetParam(), e.lost_w / e.emitted_w, 0,
                 largest_loss + sigmas * std::sqrt(largest_loss / spectral::settings(p).photons_per_pass));
  }
}

// The same photons (one seed) in the open and in a room: what escaped there lands on the room's walls here, and nothing else changes. A
// balance that only counted each photon once, wherever it went, would not notice a photon that ends in the wrong place.
TEST(Energy, WhatEscapesIsWhatARoomCatches)
{
  preset::Preset p = empty_preset(16);
  p.scene.materials["glass"] = glass(1.8);
  p.scene.materials["mirror"].type = preset::Material::Type::mirror;
  p.scene.materials["white"] = white();
  preset::Shape stone;
  stone.type = preset::Shape::Type::brilliant;
  p.scene.objects = {object("stone", stone, "glass", at({0, 0, 0}, {20, 0, 30})),
                     object("mirror", quad(1, 1), "mirror", at({1, 0, 0}, {0, 0, 70})),
                     object("floor", quad(2, 2), "white", at({0, -1, 0}))};
  preset::Light light;
  light.position = {0.3, 2, 0.4};
  p.scene.lights = {light};
  spectral::settings(p).photons_per_pass = 1 << 16;
  const spectral::EnergyBalance open = spectral::energy_of(render(p));
  preset::Shape walls = box(8, 8, 8);
  walls.inwards = true;
  p.scene.objects.push_back(object("room", walls, "white"));
  const spectral::EnergyBalance room = spectral::energy_of(render(p));
  EXPECT_TRUE(is_balanced(open) && is_balanced(room));
  EXPECT_GT(open.escaped_w, 0.3 * open.emitted_w);
  EXPECT_EQ(room.escaped_w, 0);
  // Another tree of triangles rounds hits otherwise: a photon in some ten thousand may take another way.
  const double few = 1e-4;
  expect_truth("energy: caught by a room / deposited or escaped in the open", room.deposited_w / (open.deposited_w + open.escaped_w), 1,
               few);
  expect_truth("energy: emitted, in a room / in the open", room.emitted_w / open.emitted_w, 1, few);
  expect_truth("energy: absorbed by the mirror, in a room / in the open", room.absorbed_w / open.absorbed_w, 1, few);
  expect_truth("energy: passed by the glass, in a room / in the open", room.missed_w / open.missed_w, 1, few);
}

INSTANTIATE_TEST_SUITE_P(All, ShippedPreset, testing::ValuesIn(shipped_names("spectral")), shipped_test_name);

} // namespace nephroid::energy_test
