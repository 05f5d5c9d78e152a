// SPDX-License-Identifier: Apache-2.0
// One frame of the whole window, from menu bar to status line, without a back end: the window and the tests draw the same thing.
#pragma once
#include "ui/shell/dialogs.h"
#include "ui/shell/panels.h"
#include "ui/state/workbench.h"
#include "ui/widgets/plots.h"

#include <memory>
#include <string>
#include <typeinfo>
#include <vector>

namespace nephroid::ui {

class Workspace {
public:
  /// Throws bad_input where there is no such layout.
  explicit Workspace(std::string layout = {});
  /// Between ImGui::NewFrame and ImGui::Render. Returns what the person asked for; the caller gives it to Workbench::apply.
  /// No exception leaves it.
  Commands draw(Workbench& workbench);
  /// One more panel; those of the table are there from the start. entry: its make is not called.
  void add(const PanelEntry& entry, std::unique_ptr<Panel> panel) { panels_.push_back({entry, std::move(panel)}); }
  const Dialogs& dialogs() const { return dialogs_; }
  /// The panel of a class. Throws std::bad_cast where there is none.
  template <class P>
  const P& panel() const
  {
    for (const Open& open : panels_)
      if (const auto* found = dynamic_cast<const P*>(open.panel.get())) return *found;
    throw std::bad_cast();
  }

private:
  struct Open {
    PanelEntry entry;
    std::unique_ptr<Panel> panel;
  };
  void draw_dock_space(Workbench& workbench);

  std::string layout_;
  bool laid_out_ = false;
  PlotContext plots_;          ///< before the panels, which plot with it
  WavelengthAxis wavelengths_; ///< before the panels that share it
  std::vector<Open> panels_;
  Dialogs dialogs_;
};

} // namespace nephroid::ui
