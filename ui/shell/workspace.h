// SPDX-License-Identifier: Apache-2.0
// One frame of the whole window, from menu bar to status line, without a back end: the window and the tests draw the
// same thing.
#pragma once
#include "ui/shell/dialogs.h"
#include "ui/shell/menus.h"
#include "ui/shell/panels.h"
#include "ui/shell/start_page.h"
#include "ui/state/workbench.h"
#include "ui/widgets/plots.h"

namespace nephroid::ui {

/// Names menus and the toolbar for place_of as menus.h does.
class Workspace : public Placed {
public:
  /// Throws bad_input where there is no such layout.
  explicit Workspace(std::string layout = {});
  /// Between ImGui::NewFrame and ImGui::Render. Returns what the person asked for; the caller gives it to
  /// Workbench::apply. No exception leaves it.
  Commands draw(Workbench& workbench);
  /// What a file is dropped for where the mouse is now: a picture on the panel that lists pictures is opened there, all
  /// else as Open says.
  static Command dropped(const std::string& file);
  /// One more panel; those of the table are there from the start. entry: its make is not called.
  void add(const PanelEntry& entry, std::unique_ptr<Panel> panel) { panels_.push_back({entry, std::move(panel)}); }
  const Dialogs& dialogs() const { return dialogs_; }
  /// The panel of a class. Throws std::bad_cast where there is none.
  template <class P>
  const P& panel() const {
    for (const Open& open : panels_)
      if (const auto* found = dynamic_cast<const P*>(open.panel.get())) return *found;
    throw std::bad_cast();
  }

  const Palette& palette() const { return palette_; }
  const StartPage& start_page() const { return start_page_; }

private:
  struct Open {
    PanelEntry entry;
    std::unique_ptr<Panel> panel;
  };
  void draw_start_page(Workbench& workbench, const Context& context);
  void draw_dock_space(Workbench& workbench, const Context& context);
  void draw_panel(const Open& open, const Context& context);

  std::string name_;                                      ///< the wanted layout's name; empty: each engine has its own
  std::optional<std::string> laid_out_for_;               ///< this engine
  std::array<float, 2> laid_out_size_{0, 0};              ///< in a window of this size,
  int frames_since_ = 0;                                  ///< so many frames ago;
  int frames_laid_out_ = 0;                               ///< since the layout was applied
  std::string before_;                                    ///< what it was before a person touched it
  FrontTabs front_tabs_;                                  ///< the front tabs of the newest layout
  std::shared_ptr<const preset::Preset> laid_out_opened_; ///< the preset of that layout, as it was opened
  FrontTabs kept_in_front_;    ///< the tabs that a person looked at when an edit changed the engine
  std::string to_front_;       ///< the panel that comes to the front in this frame
  PlotContext plots_;          ///< before the panels, which plot with it
  WavelengthAxis wavelengths_; ///< before the panels that share it
  std::vector<Open> panels_;
  bool list_was_open_ = false; ///< in the last frame: an Escape that closes it is for nothing else
  Dialogs dialogs_;
  Shortcuts shortcuts_;
  Palette palette_;
  StartPage start_page_;
};

} // namespace nephroid::ui
