// SPDX-License-Identifier: Apache-2.0
// How a preset may differ from another for a run to go on (environment::adoptable), in parts.
#pragma once
#include "preset/preset.h"

namespace nephroid::environment {

/// The preset with what a renderer takes on as it goes: camera, turn of the environment, segmentation and white of another.
preset::Preset with_view_of(const preset::Preset& preset, const preset::Preset& other);

/// The preset with objects turned and moved as in another.
preset::Preset with_places_of(const preset::Preset& preset, const preset::Preset& other);

} // namespace nephroid::environment
