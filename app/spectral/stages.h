// SPDX-License-Identifier: Apache-2.0
// The stages there are; each file NAME_stage.cpp has one.
#pragma once
#include "scene/scene.h"
#include "spectral/maps/photon_map.h"
#include "spectral/settings.h"
#include "spectral/stage.h"
#include "spectral/tables/device_world.h"

#include <memory>

namespace nephroid::spectral {

/// Layer "direct": spectral.pixel_samples samples a pixel, one a pass. world outlives the stage.
std::unique_ptr<Stage> make_direct_stage(DeviceWorld& world, const Settings& settings);

/// Layer "caustic" where the camera sees the receiver directly: RunTables::photons_per_pass splats a pass. map: stores the photons too;
/// nullptr: nothing gathers them.
std::unique_ptr<Stage> make_photon_stage(DeviceWorld& world, const Settings& settings, PhotonMap* map);

/// Layer "caustic" through glass and in mirrors, from the photons in the map, after the photon stage; map outlives the stage.
std::unique_ptr<Stage> make_map_stage(DeviceWorld& world, const scene::Scene& scene, const Settings& settings, PhotonMap& map);

/// Layer "caustic" by progressive photon mapping alone: spectral.photons_per_pass photons for every cluster that has its turn in a pass.
std::unique_ptr<Stage> make_sppm_stage(DeviceWorld& world, const scene::Scene& scene, const Settings& settings);

/// Layer "indirect": spectral.indirect_photons_per_pass photons a pass.
std::unique_ptr<Stage> make_indirect_stage(DeviceWorld& world, const scene::Scene& scene, const Settings& settings);

/// Layer "background": the scene's environment, which is there; spectral.pixel_samples samples a pixel, one a pass.
std::unique_ptr<Stage> make_background_stage(DeviceWorld& world, const scene::Scene& scene, const Settings& settings);

} // namespace nephroid::spectral
