// SPDX-License-Identifier: Apache-2.0
// A virtual X display of a test's own: what is started on it, and the mouse and keys that xdotool plays to it.
#pragma once
#include "tests/support/child.h"

namespace nephroid::test {

inline bool there_is(const std::string& command) {
  return std::system(("command -v " + command + " > /dev/null 2>&1").c_str()) == 0;
}

/// Needs Xvfb.
class XDisplay {
public:
  XDisplay() {
    // The server takes a number that is free, however many start at once, prints it and a line's end when it can be
    // used, and stays when the last window has gone.
    if (!server_.until([&] { return server_.out().ends_with('\n'); })) throw std::runtime_error("Xvfb does not start");
    const std::string number = server_.out();
    name_ = fmt::format(":{}", number.substr(0, number.size() - 1));
  }

  /// The environment of a program that opens its windows here. The OpenGL driver unloads itself at the end, so
  /// LeakSanitizer cannot tell whose its memory was; the headless tests look for our leaks.
  Environment environment() const {
    const char* sanitizer = std::getenv("ASAN_OPTIONS");
    return {{"DISPLAY", name_},
            {"WAYLAND_DISPLAY", std::nullopt},
            {"ASAN_OPTIONS", fmt::format("{}:detect_leaks=0", sanitizer ? sanitizer : "")}};
  }

  /// Runs a program that knows the display to its end.
  Ended run(const std::string& program, const std::vector<std::string>& arguments) const {
    return Child(arguments, logs_.path(), logs_.path(), environment(), program).wait();
  }

private:
  static fs::path made(const fs::path& folder) {
    fs::create_directory(folder);
    return folder;
  }

  TemporaryFolder logs_;
  Child server_{{"-displayfd", "1", "-screen", "0", "1600x1000x24", "-nolisten", "tcp", "-noreset"},
                logs_.path(),
                made(logs_.path() / "server"),
                {},
                "Xvfb"};
  std::string name_;
};

} // namespace nephroid::test
