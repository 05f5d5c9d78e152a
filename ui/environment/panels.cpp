// SPDX-License-Identifier: Apache-2.0
// The panels of engine 2.
#include "ui/environment/panel.h"
#include "ui/widgets/panel.h"

namespace nephroid::ui {

std::vector<PanelEntry> environment_panels()
{
  return {{.name = "environment",
           .title = EnvironmentPanel::title,
           .make = make_panel<EnvironmentPanel>,
           .serves = EnvironmentPanel::serves,
           .front_for = "environment"}};
}

} // namespace nephroid::ui
