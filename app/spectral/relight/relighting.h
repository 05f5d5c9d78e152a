// SPDX-License-Identifier: Apache-2.0
// What the stages of a run that keeps layers share: the light as it is now, and which cells the films have (thesis 6.2.2).
#pragma once
#include "spectral/relight/layer_cells.h"
#include "spectral/relight/layer_light.h"
#include "spectral/settings.h"
#include "spectral/stage.h"
#include "spectral/tables/device_world.h"

#include <cstdint>
#include <memory>

namespace nephroid::spectral {

struct Relighting {
  LayerLight light;
  LayerWeights weights;
  std::uint64_t changes = 0;                                ///< of the light
  LayerCells unbent, bent;                                  ///< seen directly, and through glass and mirrors
  compute::Buffer<float> mean_reflectance, luminance_share; ///< FlatLight
};

/// Surveys what the camera sees on the device. world: of make_run_tables.
std::unique_ptr<Relighting> make_relighting(DeviceWorld& world, LayerLight light);

/// From now on the light is another one; the energy counters begin anew, but for refused contributions.
void change_light(Relighting& relighting, DeviceWorld& world, LayerLight light);

/// Layer "direct" and layer "caustic", kept as layers. world and relighting outlive the stage.
std::unique_ptr<Stage> make_layered_direct_stage(DeviceWorld& world, const Relighting& relighting, const Settings& settings);
std::unique_ptr<Stage> make_layered_photon_stage(DeviceWorld& world, const Relighting& relighting);

} // namespace nephroid::spectral
