// SPDX-License-Identifier: Apache-2.0
#include "spectral/layer_plan.h"

#include "spectral/layer_cells.h"
#include "spectral/omissions.h"

#include <fmt/format.h>

namespace nephroid::spectral {

plan::Pass no_maps_of_layers()
{
  return {"photon maps", false, "spectral.relight is true: layers are kept of splats, not of photon maps", "/spectral/relight", false};
}

void plan_layers(const DeviceTables& tables, bool direct, bool photons, int halves, plan::Plan& plan)
{
  const std::size_t lights = tables.lights.size(), clusters = tables.wavelengths.clusters.size();
  std::erase_if(plan.passes, [](const plan::Pass& p) { return p.name == "dark_lights" || p.name == "unlit_wavelengths"; });
  plan.passes.push_back({"relighting", true,
                         fmt::format("{} of {} in {} are kept apart, dark ones included, so that spectra and powers can change",
                                     counted(static_cast<std::int64_t>(lights * clusters), "layer", "layers"),
                                     counted(static_cast<std::int64_t>(lights), "light", "lights"),
                                     counted(static_cast<std::int64_t>(clusters), "wavelength cluster", "wavelength clusters")),
                         "/spectral/relight", true});

  std::erase_if(plan.buffers, [](const plan::PlannedBuffer& b) { return b.name == "film direct" || b.name == "film caustic"; });
  const LayerBudget budget = layer_budget(tables.camera, tables.spheres);
  const int reflectors = tables.wavelengths.reflector_count;
  const std::size_t unbent = padded_cells(budget.unbent, reflectors), bent = padded_cells(budget.bent, reflectors);
  const auto film = [&](const char* name, std::size_t layers, std::size_t cells) {
    plan.buffers.push_back({name, sizeof(std::int64_t) * static_cast<std::uint64_t>(halves) * layers * cells});
  };
  if (direct) {
    film("film direct", lights, unbent);
    film("film direct through glass", lights * clusters, bent);
  }
  if (photons) film("film caustic", lights * clusters, unbent);
  const std::uint64_t pixels = static_cast<std::uint64_t>(tables.camera.width) * static_cast<std::uint64_t>(tables.camera.height);
  plan.buffers.push_back({"survey", pixels * SURVEY_PLACES * (1 + SURVEY_PATHS) * sizeof(int)});
}

} // namespace nephroid::spectral
