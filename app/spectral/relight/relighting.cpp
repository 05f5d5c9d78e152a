// SPDX-License-Identifier: Apache-2.0
#include "spectral/relight/relighting.h"

#include "spectral/relight/layer_light.h"

#include <utility>

namespace nephroid::spectral {

std::unique_ptr<Relighting> make_relighting(DeviceWorld& world, LayerLight light)
{
  const RunTables& tables = world.tables;
  auto made = std::make_unique<Relighting>();
  made->weights = layer_weights(light, tables.wavelengths);
  made->light = std::move(light);
  const FlatLight flat = flat_light(tables.wavelengths);
  made->mean_reflectance = compute::Buffer<float>(world.context, "mean reflectances", std::span(flat.mean_reflectance));
  made->luminance_share = compute::Buffer<float>(world.context, "luminance of each cluster", std::span(flat.luminance_share));

  const int width = tables.camera.width, height = tables.camera.height, reflectors = tables.wavelengths.reflector_count;
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  compute::Buffer<int> unbent(world.context, "survey", pixels * SURVEY_PLACES),
      bent(world.context, "survey through glass", pixels * SURVEY_PLACES * SURVEY_PATHS);
  compute::Kernel survey = compute::Program(world.context, "spectral/relight_direct.cl", world.defines).kernel("survey");
  world.run(survey, pixels, 64, {{"camera", tables.camera}, {"seed", world.seed}, {"unbent", unbent}, {"bent", bent}});
  const LayerBudget budget = layer_budget(tables.camera, tables.spheres);
  const std::vector<int> seen = unbent.read(), seen_bent = bent.read();
  made->unbent = make_layer_cells({seen, width, height, SURVEY_PLACES, reflectors}, budget.unbent, true);
  made->bent = make_layer_cells({seen_bent, width, height, SURVEY_PLACES * SURVEY_PATHS, reflectors}, budget.bent, false);
  return made;
}

void change_light(Relighting& relighting, DeviceWorld& world, LayerLight light)
{
  relighting.weights = layer_weights(light, world.tables.wavelengths);
  relighting.light = std::move(light);
  ++relighting.changes;
  world.tables.energy_scale = layer_energy_scale(relighting.light, world.tables);
  std::vector<std::int64_t> sums = world.energy.read();
  for (int outcome = 0; outcome < OUTCOME_COUNT; ++outcome)
    if (outcome != OUTCOME_REFUSED) sums[static_cast<std::size_t>(outcome)] = 0;
  world.energy.write(sums);
}

} // namespace nephroid::spectral
