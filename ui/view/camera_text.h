// SPDX-License-Identifier: Apache-2.0
// The preset's camera as text to be pasted elsewhere.
#pragma once
#include "preset/preset.h"

#include <string>

namespace nephroid::ui {

/// {"camera": {...}}, as it stands in a preset's scene.
std::string camera_json(const preset::Preset& preset);
/// "--set 'scene.camera.position=[0,0,4]' --set ...", a field each, quoted for a shell.
std::string camera_settings(const preset::Preset& preset);

} // namespace nephroid::ui
