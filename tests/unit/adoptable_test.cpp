// SPDX-License-Identifier: Apache-2.0
#include "engine/engine.h"
#include "preset/preset.h"
#include "preset/settings_type.h"

#include <gtest/gtest.h>

namespace nephroid {
namespace {

// A preset is edited into one of another engine while its run goes on: Parameters do so.
TEST(Adoptable, NoEngineTakesOnAnothersPreset)
{
  for (const engine::Engine* own : engine::engines()) {
    preset::Preset before;
    before.settings = preset::Settings(own->settings());
    for (const engine::Engine* other : engine::engines()) {
      if (other == own) continue;
      preset::Preset now = before;
      now.settings = preset::Settings(other->settings());
      EXPECT_FALSE(engine::adoptable(before, now)) << own->settings().name << " to " << other->settings().name;
    }
  }
}

} // namespace
} // namespace nephroid
