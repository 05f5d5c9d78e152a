// SPDX-License-Identifier: Apache-2.0
#include "preset/relight.h"

namespace nephroid::preset {

bool only_relit(const Preset& before, const Preset& now)
{
  if (!before.spectral.relight || before.scene.lights.size() != now.scene.lights.size()) return false;
  Preset same = now;
  same.name = before.name;
  same.description = before.description;
  same.white = before.white;
  for (std::size_t i = 0; i < same.scene.lights.size(); ++i) {
    const Light& light = before.scene.lights[i];
    same.scene.lights[i].spectrum = light.spectrum;
    same.scene.lights[i].power_w = light.power_w;
    same.scene.lights[i].irradiance_w_m2 = light.irradiance_w_m2;
  }
  return same == before;
}

} // namespace nephroid::preset
