// SPDX-License-Identifier: Apache-2.0
// Where a real window draws something: the window's own code, without a display, says so.
#pragma once
#include "fake_job.h"
#include "headless.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace nephroid::test {

/// A place on the screen as the pixel that events go to.
inline std::array<int, 2> pixel(const std::array<double, 2>& place)
{
  return {static_cast<int>(std::lround(place[0])), static_cast<int>(std::lround(place[1]))};
}

/// What `look(workspace, imgui, draw)` says of a window of this size and layout, in pixels; draw() draws one more frame, after a click.
/// preset: a file that is opened in it, or empty. Runs: where its runs come from, a FakeRuns.
template <class Runs = FakeRuns, class Look>
auto in_window_like(const std::array<int, 2>& size, const std::string& layout, const std::string& preset, Look look)
{
  Headless imgui;
  ImGui::GetIO().DisplaySize = {static_cast<float>(size[0]), static_cast<float>(size[1])};
  Runs runs;
  ui::Workbench workbench{runs};
  ui::Workspace workspace(layout);
  const auto draw = [&] { imgui.frame(workspace, workbench); };
  if (!preset.empty()) {
    workbench.open(preset);
    eventually(draw, [&] { return !workspace.panel<ui::ViewPanel>().texture().empty(); });
  }
  for (int i = 0; i < 5; ++i) draw(); // strips and docks take their final places
  return look(workspace, imgui, draw);
}

} // namespace nephroid::test
