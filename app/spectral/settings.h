// SPDX-License-Identifier: Apache-2.0
// The settings of engine 1, the section "spectral" of a preset, are those of photons and paths from the eye.
#pragma once
#include "photons/settings.h"
#include "preset/preset.h"

namespace nephroid::spectral {

/// The settings of this engine, as a preset knows them.
const preset::SettingsType& settings_type();

/// Of a preset of this engine.
inline photons::Settings& settings(preset::Preset& preset) { return preset.settings.as<photons::Settings>(); }
inline const photons::Settings& settings(const preset::Preset& preset) {
  return preset.settings.as<photons::Settings>();
}

} // namespace nephroid::spectral
