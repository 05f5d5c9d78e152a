// SPDX-License-Identifier: Apache-2.0
// The stages there are; each file NAME_stage.cpp has one.
#pragma once
#include "preset/preset.h"
#include "spectral/device_world.h"
#include "spectral/stage.h"

#include <memory>

namespace nephroid::spectral {

/// Layer "direct": spectral.pixel_samples samples a pixel, one a pass. world outlives the stage.
std::unique_ptr<Stage> make_direct_stage(DeviceWorld& world, const preset::Spectral& settings);

/// Layer "caustic" where the camera sees the receiver directly: DeviceTables::photons_per_pass splats a pass.
std::unique_ptr<Stage> make_photon_stage(DeviceWorld& world);

} // namespace nephroid::spectral
