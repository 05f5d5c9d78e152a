// SPDX-License-Identifier: Apache-2.0
// The program's entry: gives the command line to cli/, and the window's options to ui/ where the build has a window.
#include "cli/command_line.h"

#ifdef NEPHROID_UI
#include "cli/numbers.h"
#include "ui/shell/window.h"

#include <CLI/CLI.hpp>

#include <memory>

namespace {

void add_window_options(CLI::App& program, nephroid::ui::Options& options)
{
  const char* group = "Window";
  program.add_option("--set", options.overrides, "Change a setting: scene.lights.0.power_w=2; may be repeated")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all()
      ->group(group);
  program.add_option("--device", options.device, "The device to use: an index or part of a name (nephroid devices)")
      ->type_name("SEL")
      ->group(group);
  program.add_option("--kernels", options.kernels, "Load kernels from this folder and rebuild them when they change")
      ->type_name("DIR")
      ->group(group);
  program.add_option("--screenshot", options.screenshot, "Write the window as PNG, then close")->type_name("FILE")->group(group);
  program.add_option("--frames", options.frames, "Close after this many frames (with --screenshot: 60)")
      ->transform(nephroid::cli::number_from_to(0, 1 << 30))
      ->type_name("N")
      ->group(group);
  program.add_option("--until", options.until, "Before closing by --frames wait for this part of the run; 1: until it is over")
      ->transform(nephroid::cli::number_from_to(0.0, 1.0))
      ->type_name("F")
      ->group(group);
  program.add_option("--frame-times", options.frame_times, "Write every frame's time as CSV")->type_name("FILE")->group(group);
  program.add_option("--layout", options.layout, "Where the panels are")->type_name("NAME")->group(group);
  program.add_option("--size", options.size, "Width and height of the window's content")
      ->delimiter('x')
      ->transform(nephroid::cli::number_from_to(64, 16384))
      ->type_name("WxH")
      ->group(group);
}

} // namespace
#endif

int main(int argc, char** argv)
{
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
