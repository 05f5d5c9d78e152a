// SPDX-License-Identifier: Apache-2.0
#include "spectral/engine.h"

namespace nephroid::spectral {

bool adoptable(const preset::Preset& before, const preset::Preset& now)
{
  if (!settings(before).relight || before.scene.lights.size() != now.scene.lights.size()) return false;
  preset::Preset same = now;
  same.name = before.name;
  same.description = before.description;
  same.white = before.white;
  for (std::size_t i = 0; i < same.scene.lights.size(); ++i) {
    const preset::Light& light = before.scene.lights[i];
    same.scene.lights[i].spectrum = light.spectrum;
    same.scene.lights[i].power_w = light.power_w;
    same.scene.lights[i].irradiance_w_m2 = light.irradiance_w_m2;
  }
  return same == before;
}

} // namespace nephroid::spectral
