// SPDX-License-Identifier: Apache-2.0
// What the stages of a run that keeps layers share: the light as it is now, and which cells the films have (thesis 6.2.2).
#pragma once
#include "spectral/plan_part.h"
#include "spectral/relight/layer_film.h"
#include "spectral/relight/layer_light.h"
#include "spectral/tables/device_world.h"

#include <cstdint>

namespace nephroid::spectral {

struct Relighting {
  LayerLight light;
  LayerWeights weights;
  std::uint64_t changes = 0;                                ///< of the light
  LayerCells unbent, bent;                                  ///< seen directly, and through glass and mirrors
  compute::Buffer<float> mean_reflectance, luminance_share; ///< FlatLight
};

/// DeviceWorld::relighting; the first call surveys what the camera sees on the device. world: of make_run_tables for the scene.
const Relighting& relighting_of(DeviceWorld& world, const scene::Scene& scene);

/// From now on the light is another one; the energy counters begin anew, but for refused contributions.
void change_light(Relighting& relighting, DeviceWorld& world, LayerLight light);

/// Adds a film of so many cells to the plan: its sums by their name, its cells and the pictures that are weighed of it by theirs.
void plan_layer_film(const char* name, std::size_t layers, std::size_t cells, const PlanInput& input, PlanPart& part);

} // namespace nephroid::spectral
