// SPDX-License-Identifier: Apache-2.0
// The whole command line: verbs, help, errors as one line, exit codes. app/main.cpp adds the window to it.
#pragma once
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace nephroid::cli {

/// What `nephroid [FILE...]` does. Both functions are empty in a build without the window.
struct Window {
  std::function<void(CLI::App& program)> add_options;
  std::function<int(const std::vector<std::string>& files)> open; ///< returns the exit code
};

/// Parses and runs one command. Returns the exit code; every error is one line on standard error.
int run_command_line(int argc, const char* const* argv, const Window& window);

} // namespace nephroid::cli
