// SPDX-License-Identifier: Apache-2.0
// The panels of engine 1.
#include "run/prepare.h"
#include "ui/spectral/dispersion/panel.h"
#include "ui/spectral/spectra/panel.h"
#include "ui/widgets/panel.h"

namespace nephroid::ui {

std::vector<PanelEntry> spectral_panels() {
  return {{"dispersion", DispersionPanel::title, "spectral", make_panel<DispersionPanel>},
          {"spectra", SpectraPanel::title, "spectral", make_panel<SpectraPanel>,
           [](const preset::Preset& preset, const std::shared_ptr<const run::LoadedScene>& loaded, SceneFacts& facts) {
             facts.spectra = SeenByGlass::of(preset, loaded->scene, *loaded->bvh);
           }}};
}

} // namespace nephroid::ui
