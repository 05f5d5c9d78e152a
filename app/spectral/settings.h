// SPDX-License-Identifier: Apache-2.0
// The settings of engine 1: its section "spectral" of a preset holds those of photons and paths from the eye.
#pragma once
#include "photons/settings.h"
#include "preset/preset.h"

namespace nephroid::spectral {

const preset::SettingsType& settings_type();

inline photons::Settings& settings(preset::Preset& preset) { return preset.settings.as<photons::Settings>(); }
inline const photons::Settings& settings(const preset::Preset& preset) {
  return preset.settings.as<photons::Settings>();
}

} // namespace nephroid::spectral
