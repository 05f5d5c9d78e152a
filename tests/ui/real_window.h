// SPDX-License-Identifier: Apache-2.0
// The real program in a real window on a virtual display of its own.
#pragma once
#include "image/image.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <sys/wait.h>

namespace nephroid::test {

inline const std::string program = "'" NEPHROID_PROGRAM "'";

inline bool there_is(const std::string& command) { return std::system(("command -v " + command + " > /dev/null 2>&1").c_str()) == 0; }

/// Exit code of a line of shell, with what it printed in `output`.
inline int shell(const std::string& line, const std::filesystem::path& output)
{
  const int status = std::system(("{ " + line + "; } > '" + output.string() + "' 2>&1").c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Of a screenshot.
inline std::array<int, 3> bytes_at(const image::Image& picture, double x, double y)
{
  const std::size_t index = static_cast<std::size_t>(static_cast<int>(y) * picture.width + static_cast<int>(x)) * picture.channels.size();
  std::array<int, 3> bytes{};
  for (std::size_t c = 0; c < 3; ++c) bytes[c] = static_cast<int>(std::lround(255 * picture.data[index + c]));
  return bytes;
}

class RealWindow : public ::testing::Test {
protected:
  TemporaryFolder folder;
  std::filesystem::path log = folder.path() / "log.txt";
  /// What runs the rest of a command line on a display of its own. The X authority file is ours: xvfb-run's own temporary folder may still
  /// be written to when xvfb-run removes it, and then it exits with 5.
  /// The OpenGL driver unloads itself at the end, so LeakSanitizer cannot tell whose its memory was; the headless tests look for our leaks.
  std::string on_display() const
  {
    return "ASAN_OPTIONS=\"$ASAN_OPTIONS:detect_leaks=0\" xvfb-run -a -f " + quoted("authority") + " -s '-screen 0 1600x1000x24' ";
  }
  std::string quoted(const std::string& name) const { return "'" + (folder.path() / name).string() + "'"; }
};

} // namespace nephroid::test
