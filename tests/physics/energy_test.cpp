// SPDX-License-Identifier: Apache-2.0
// No light is made and none disappears: where photons end. tests/images/shipped_presets_test.cpp looks at the balance of every preset.
#include "spectral/energy.h"
#include "tests/support/closed_form.h"

namespace nephroid::energy_test {

bool is_balanced(const spectral::EnergyBalance& e)
{
  const double parts = e.deposited_w + e.missed_w + e.absorbed_w + e.escaped_w + e.lost_w;
  return std::abs(parts - e.emitted_w) <= 1e-12 * e.emitted_w;
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

} // namespace nephroid::energy_test
