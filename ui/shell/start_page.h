// SPDX-License-Identifier: Apache-2.0
// What the window shows while no preset is open: what the three engines do, the presets, the devices, and what to do
// where there is none.
#pragma once
#include "compute/compute.h"
#include "ui/presets/catalogue.h"
#include "ui/widgets/panel.h"

namespace nephroid::ui {

/// Names a card's button by its preset, for place_of.
class StartPage : public Placed {
public:
  /// In the window's area between the menu bar and the status line. presets: the panel of that name, which is a part of
  /// the page. to_presets: the keyboard goes to it.
  void draw(const Context& context, Panel& presets, bool to_presets);

private:
  struct Devices {
    std::vector<compute::DeviceInfo> list;
    std::string why_none; ///< where none was found: why, and what to do
  };
  void draw_engines(const Context& context);
  void draw_devices(TaskQueue& tasks);

  Thumbnails thumbnails_;
  std::vector<std::filesystem::path> pictures_; ///< one a card
  TaskKey asking_;
  std::optional<Devices> devices_; ///< nothing before drivers have answered, which may take seconds
};

} // namespace nephroid::ui
