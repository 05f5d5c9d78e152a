// SPDX-License-Identifier: Apache-2.0
// One frame of the whole window, from menu bar to status line, without a back end: the window and the tests draw the same thing.
#pragma once
#include "ui/dispersion/panel.h"
#include "ui/error/panel.h"
#include "ui/parameters/panel.h"
#include "ui/plan/panel.h"
#include "ui/shell/dialogs.h"
#include "ui/spectra/panel.h"
#include "ui/view/panel.h"
#include "ui/widgets/panel.h"
#include "ui/widgets/plots.h"
#include "ui/widgets/wavelength_axis.h"

#include <memory>
#include <string>
#include <vector>

namespace nephroid::ui {

class Workspace {
public:
  /// Throws bad_input where there is no such layout.
  explicit Workspace(std::string layout = {});
  /// Between ImGui::NewFrame and ImGui::Render. Returns what the person asked for; the caller gives it to Workbench::apply.
  /// No exception leaves it.
  Commands draw(Workbench& workbench);
  /// One more panel; the program's own are there from the start.
  void add(std::unique_ptr<Panel> panel) { panels_.push_back(std::move(panel)); }
  const ViewPanel& view() const { return *view_; }
  const ErrorPanel& error() const { return *error_; }
  const DispersionPanel& dispersion() const { return *dispersion_; }
  const SpectraPanel& spectra() const { return *spectra_; }
  const PlanPanel& plan() const { return *plan_; }
  const ParametersPanel& parameters() const { return *parameters_; }

private:
  template <class P, class... Arguments>
  P* add_own(Arguments&... arguments);
  void draw_dock_space(Workbench& workbench);
  void draw_panel(Panel& panel, const Workbench& workbench, Commands& commands) const;

  std::string layout_;
  bool laid_out_ = false;
  PlotContext plots_;          ///< before the panels, which plot with it
  WavelengthAxis wavelengths_; ///< before the panels that share it
  std::vector<std::unique_ptr<Panel>> panels_;
  ViewPanel* view_ = nullptr;
  ErrorPanel* error_ = nullptr;
  DispersionPanel* dispersion_ = nullptr;
  SpectraPanel* spectra_ = nullptr;
  PlanPanel* plan_ = nullptr;
  ParametersPanel* parameters_ = nullptr;
  Dialogs dialogs_;
};

} // namespace nephroid::ui
