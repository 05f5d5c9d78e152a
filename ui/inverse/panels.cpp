// SPDX-License-Identifier: Apache-2.0
// The panels of engine 3.
#include "ui/inverse/annealing/panel.h"
#include "ui/widgets/panel.h"

namespace nephroid::ui {

std::vector<PanelEntry> inverse_panels()
{
  return {{.name = "annealing",
           .title = AnnealingPanel::title,
           .engine = "inverse",
           .make = make_panel<AnnealingPanel>,
           .front_for = "inverse"}};
}

} // namespace nephroid::ui
