// SPDX-License-Identifier: Apache-2.0
// How the mouse moves a camera: pure functions from one camera of a preset to the next; and the camera as text. No Dear ImGui.
#pragma once
#include "preset/preset.h"

namespace nephroid::ui {

/// Moves the camera round its target: right_deg about the camera's up (positive: the camera goes to its right), then up_deg
/// towards up. It stops 1 degree short of looking along up, where left and right would swap.
preset::Camera orbit(const preset::Camera& camera, double right_deg, double up_deg);

/// Multiplies the distance to the target; the target stays. factor > 0.
preset::Camera dolly(const preset::Camera& camera, double factor);

/// Shifts position and target together, in parts of the picture's height at the target's distance: a thing at the target moves
/// by (right, down) in the picture.
preset::Camera pan(const preset::Camera& camera, double right, double down);

/// {"camera": {...}}, as it stands in a preset's scene.
std::string camera_json(const preset::Preset& preset);
/// "--set 'scene.camera.position=[0,0,4]' --set ...", a field each, quoted for a shell.
std::string camera_settings(const preset::Preset& preset);

} // namespace nephroid::ui
