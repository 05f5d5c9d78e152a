// SPDX-License-Identifier: Apache-2.0
// What a person chose to see. Nothing here needs a new run.
#pragma once
#include "ui/state/tone.h"

#include <algorithm>

namespace nephroid::ui {

struct ViewState {
  ViewSettings view_settings;
  std::string error_metric;                ///< the plotted metric; empty: the run's own. Not every run has it.
  std::optional<std::array<int, 2>> pixel; ///< the inspected column and row; may lie outside of the picture
  std::optional<PixelRegion> region;       ///< the region with statistics; may reach out of the picture, never empty
  std::vector<std::vector<preset::Vec3>> lines; ///< drawn over the View's picture: command::ShowLines
  std::string material; ///< the dielectric to show; empty or unknown: the first (shown_dielectric)
  Selection selection;  ///< may be an earlier preset's: in_preset()
  Handles handles;
  command::Nudged nudged;          ///< the newest nudge
  std::vector<Bookmark> bookmarks; ///< saved cameras
  bool operator==(const ViewState&) const = default;

  void carry_out(const command::SetViewSettings& c) {
    view_settings = c.view_settings;
    if (view_settings.range) view_settings.range = valid_range(*view_settings.range);
    view_settings.exposure_stops = std::clamp(view_settings.exposure_stops, -20.0, 20.0);
  }
  void carry_out(const command::SelectRegion& c) {
    region = c.region;
    if (region && (region->from[0] >= region->to[0] || region->from[1] >= region->to[1])) region.reset();
  }
  void carry_out(const command::ShowLines& c) { lines = c.lines; }
  void carry_out(const command::ChooseMetric& c) { error_metric = c.metric; }
  void carry_out(const command::ChooseMaterial& c) { material = c.material; }
  void carry_out(const command::SetHandles& c) { handles = c.handles; }
  void carry_out(const command::Nudged& c) { nudged = c; }
  void carry_out(const command::SetBookmarks& c) { bookmarks = c.bookmarks; }
};

} // namespace nephroid::ui
