// SPDX-License-Identifier: Apache-2.0
// The dielectrics of a preset: which there are, which is meant, and dispersion data for one of them.
#pragma once
#include "preset/preset.h"

#include <string>
#include <vector>

namespace nephroid::ui {

/// Those that objects are made of, in the order of the objects, then the others by name.
std::vector<std::string> dielectrics(const preset::Preset& preset);

/// The one that is shown where `chosen` was asked for: that, else the first; empty where there is none.
std::string shown_dielectric(const preset::Preset& preset, const std::string& chosen);

/// A dispersion of a refractiveindex.info file: a path, or the name of a shipped material ("N-SF66"), for a preset from `preset_source`.
/// Throws bad_input where it cannot be read or has no n at one of the 401 wavelengths.
preset::Dispersion load_dispersion(const std::string& file, const std::string& preset_source);

} // namespace nephroid::ui
