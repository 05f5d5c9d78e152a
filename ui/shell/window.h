// SPDX-License-Identifier: Apache-2.0
// The window of the workbench: opens it, runs its loop and closes it. The one door into ui/ for app/main.cpp; includes
// nothing of OpenGL, GLFW or Dear ImGui.
#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <vector>

namespace nephroid::ui {

struct Options {
  std::vector<std::string> files;     ///< presets by path or shipped name; the first that can be opened is shown
  std::vector<std::string> overrides; ///< --set a.b.c=v, applied to the presets named by `files`
  std::string device;                 ///< --device, as compute::DeviceOptions::selector takes it
  std::filesystem::path kernels;      ///< --kernels DIR; empty: the embedded ones
  std::filesystem::path screenshot;   ///< --screenshot FILE: write the window's content as PNG, then close
  int frames = 0;                     ///< --frames N: close after N frames; 0: 60 with a screenshot, else never
  double until = 0; ///< --until F: `frames` also wait for this fraction 0..1 of the run; 1: until it is over
  std::filesystem::path frame_times;  ///< --frame-times FILE: CSV of every frame as it is drawn
  std::string layout;                 ///< --layout NAME: the panel whose tab is in front; empty: the engine's
  std::array<int, 2> size{1280, 860}; ///< --size WxH: the window's content, in screen coordinates
};

/// Opens the window, runs until it is closed and returns the exit code: 0 but with a screenshot, where nobody reads
/// the window: there that of the first error among its messages. Call from the main thread.
/// A preset that cannot be read is shown as a message in the window; thrown only where there is no window. Throws
/// failed at "window" where there is no display or no OpenGL 3, and where the screenshot cannot be written; bad_input
/// for a layout that there is not.
int open_window(const Options& options);

} // namespace nephroid::ui
