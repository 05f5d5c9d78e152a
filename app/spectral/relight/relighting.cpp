// SPDX-License-Identifier: Apache-2.0
#include "spectral/relight/relighting.h"

#include "base/counted.h"
#include "spectral/clusters/clusters.h"

#include <fmt/format.h>

#include <utility>

namespace nephroid::spectral {
namespace {

PlanPart plan_relighting(const PlanInput& input)
{
  if (!input.settings.relight) return {};
  const std::size_t lights = input.tables.lights.size(), clusters = input.tables.wavelengths.clusters.size();
  const std::string split =
      input.tables.wavelengths.attenuator_count > 0
          ? fmt::format("; in a cluster, what a material leaves of two wavelengths differs by at most {}", largest_loss_difference)
          : "";
  return {.passes = {{"relighting", true,
                      fmt::format("{} of {} in {} are kept apart, so that spectra and powers can change; dark ones too, for which "
                                  "half of the photons go to every cluster alike{}",
                                  counted(lights * clusters, "layer"), counted(lights, "light"), counted(clusters, "wavelength cluster"),
                                  split),
                      "/spectral/relight", true}},
          .buffers = {{"survey and weighing", input.pixels() * SURVEY_PLACES * (1 + SURVEY_PATHS) * sizeof(int)}}};
}

} // namespace

const RunPart relighting_part{plan_relighting};

void plan_layer_film(const char* name, std::size_t layers, std::size_t cells, const PlanInput& input, PlanPart& part)
{
  const std::uint64_t padded = padded_cells(cells, input.tables.wavelengths.reflector_count), pixels = input.pixels();
  part.buffers.push_back({name, sizeof(std::int64_t) * input.halves() * layers * padded});
  // Where the cells are, and two weighed pictures by cell and by pixel.
  part.buffers.push_back(
      {"survey and weighing", padded * sizeof(shared::LayerCell) + pixels * sizeof(int) + 6 * sizeof(float) * (padded + pixels)});
}

const Relighting& relighting_of(DeviceWorld& world, const scene::Scene& scene)
{
  if (world.relighting) return *world.relighting;
  const RunTables& tables = world.tables;
  world.relighting = std::make_shared<Relighting>();
  Relighting& relighting = *world.relighting;
  relighting.light = layer_light(scene, world.white);
  relighting.weights = layer_weights(relighting.light, tables.wavelengths);
  const FlatLight flat = flat_light(tables.wavelengths);
  relighting.mean_reflectance = compute::Buffer<float>(world.context, "mean reflectances", std::span(flat.mean_reflectance));
  relighting.luminance_share = compute::Buffer<float>(world.context, "luminance of each cluster", std::span(flat.luminance_share));

  const int width = tables.camera.width, height = tables.camera.height, reflectors = tables.wavelengths.reflector_count;
  const std::size_t pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  compute::Buffer<int> unbent(world.context, "survey", pixels * SURVEY_PLACES),
      bent(world.context, "survey through glass", pixels * SURVEY_PLACES * SURVEY_PATHS);
  compute::Kernel survey = compute::Program(world.context, "spectral/relight_direct.cl", world.defines).kernel("survey");
  world.run(survey, pixels, 64, {{"camera", tables.camera}, {"seed", world.seed}, {"unbent", unbent}, {"bent", bent}});
  const std::vector<int> seen = unbent.read(), seen_bent = bent.read();
  relighting.unbent = make_layer_cells({seen, width, height, SURVEY_PLACES, reflectors}, unbent_cells(tables.camera), true);
  relighting.bent = make_layer_cells({seen_bent, width, height, SURVEY_PLACES * SURVEY_PATHS, reflectors},
                                     bent_cells(tables.camera, tables.spheres), false);
  return relighting;
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
