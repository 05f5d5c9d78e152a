// SPDX-License-Identifier: Apache-2.0
// Which edits of a preset are another light on the same scene, so that a run that keeps layers (Settings::relight) can take them on.
#pragma once
#include "spectral/settings.h"

namespace nephroid::spectral {

/// Whether `now` is `before`, which keeps layers, but for the spectra and powers of its lights, its white, its name and its description.
/// Also true where nothing differs.
bool only_relit(const preset::Preset& before, const preset::Preset& now);

} // namespace nephroid::spectral
