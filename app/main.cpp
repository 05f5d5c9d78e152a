// SPDX-License-Identifier: Apache-2.0
// The program's entry: gives the command line to cli/, and the window's options to ui/ where the build has a window.
#include "base/memory.h"
#include "cli/verb.h"

#ifdef NEPHROID_UI
#include "ui/shell/window.h"

#include <memory>

namespace {

void add_window_options(CLI::App& program, nephroid::ui::Options& options) {
  nephroid::cli::Verb window(program, "Window");
  window.overrides(options.overrides);
  window.option("--device", options.device,
                {.type = "SEL", .says = "The device to use: an index or part of a name (nephroid devices)"});
  window.option("--kernels", options.kernels,
                {.type = "DIR", .says = "Load kernels from this folder and rebuild them when they change"});
  window.option("--screenshot", options.screenshot, {.type = "FILE", .says = "Write the window as PNG, then close"});
  window.option(
      "--frames", options.frames,
      {.type = "N", .says = "Close after this many frames (with --screenshot: 60)", .from = 0, .to = 1 << 30});
  window.option("--until", options.until,
                {.type = "F",
                 .says = "Before closing by --frames wait for this part of the run; 1: until it is over",
                 .from = 0.0,
                 .to = 1.0});
  window.option("--frame-times", options.frame_times, {.type = "FILE", .says = "Write every frame's time as CSV"});
  window.option("--layout", options.layout, {.type = "NAME", .says = "Where the panels are"});
  window.option(
      "--size", options.size,
      {.type = "WxH", .says = "Width and height of the window's content", .separator = 'x', .from = 64, .to = 16384});
}

} // namespace
#endif

int main(int argc, char** argv) {
  nephroid::keep_freed_memory();
  nephroid::cli::Window window;
#ifdef NEPHROID_UI
  const auto options = std::make_shared<nephroid::ui::Options>();
  window.add_options = [options](CLI::App& program) { add_window_options(program, *options); };
  window.open = [options](const std::vector<std::string>& files) {
    options->files = files;
    return nephroid::ui::open_window(*options);
  };
#endif
  return nephroid::cli::run_command_line(argc, argv, window);
}
