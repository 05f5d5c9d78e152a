// SPDX-License-Identifier: Apache-2.0
#include "spectral/relight/layer_plan.h"

#include "base/counted.h"
#include "spectral/clusters/scene_clusters.h"
#include "spectral/relight/layer_cells.h"
#include "tracing/omissions.h"

#include <fmt/format.h>

namespace nephroid::spectral {

plan::Pass no_maps_of_layers()
{
  return {"photon maps", false, "spectral.relight is true: layers are kept of splats, not of photon maps", "/spectral/relight", false};
}

void plan_layers(const RunTables& tables, bool direct, bool photons, int halves, plan::Plan& plan)
{
  const std::size_t lights = tables.lights.size(), clusters = tables.wavelengths.clusters.size();
  std::erase_if(plan.passes, [](const plan::Pass& p) { return p.name == "dark lights" || p.name == "unlit wavelengths"; });
  const std::string split =
      fmt::format("; in a cluster, what a material leaves of two wavelengths differs by at most {}", largest_loss_difference);
  plan.passes.push_back({"relighting", true,
                         fmt::format("{} of {} in {} are kept apart, so that spectra and powers can change; dark ones too, for which "
                                     "half of the photons go to every cluster alike{}",
                                     counted(lights * clusters, "layer"), counted(lights, "light"), counted(clusters, "wavelength cluster"),
                                     tables.wavelengths.attenuator_count > 0 ? split : ""),
                         "/spectral/relight", true});

  std::erase_if(plan.buffers, [](const plan::PlannedBuffer& b) { return b.name == "film direct" || b.name == "film caustic"; });
  const LayerBudget budget = layer_budget(tables.camera, tables.spheres);
  const int reflectors = tables.wavelengths.reflector_count;
  const std::size_t unbent = padded_cells(budget.unbent, reflectors), bent = padded_cells(budget.bent, reflectors);
  const std::size_t pixels = static_cast<std::size_t>(tables.camera.width) * static_cast<std::size_t>(tables.camera.height);
  std::uint64_t beside = pixels * SURVEY_PLACES * (1 + SURVEY_PATHS) * sizeof(int); // the survey
  const auto film = [&](const char* name, std::size_t layers, std::size_t cells) {
    plan.buffers.push_back({name, sizeof(std::int64_t) * static_cast<std::uint64_t>(halves) * layers * cells});
    // Where the cells are, and two weighed pictures by cell and by pixel.
    beside += cells * sizeof(shared::LayerCell) + pixels * sizeof(int) + 6 * sizeof(float) * (cells + pixels);
  };
  if (direct) {
    film("film direct", lights, unbent);
    film("film direct through glass", lights * clusters, bent);
  }
  if (photons) film("film caustic", lights * clusters, unbent);
  plan.buffers.push_back({"survey and weighing", beside});
}

} // namespace nephroid::spectral
