// SPDX-License-Identifier: Apache-2.0
// The real program in a real window on a virtual display of its own.
#pragma once
#include "base/files.h"
#include "image/image.h"
#include "tests/support/temporary_folder.h"

#include <fmt/format.h>
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
  std::string quoted(const std::string& name) const { return fmt::format("'{}'", (folder.path() / name).string()); }
  /// Opens a preset and plays lines of shell to the window, by X events and until it is closed; needs xdotool. Beside the shell's own
  /// words there are, in pixels of the window:
  ///   at X Y           the mouse goes there
  ///   press, let_go    the left button
  ///   glide X Y X Y    from one place to another in eight moves
  ///   drag X Y X Y     the same with the left button held
  ///   click X Y
  ///   chord KEY        Ctrl and a key
  ///   picture FILE     what the window shows now; needs ImageMagick
  /// The program's exit code; its last frame is in screen.png, what it printed in `log`.
  int play(const std::string& preset, const std::string& options, const std::string& events) const
  {
    // Kernels are compiled before the window's run needs them: the events wait three seconds for its first picture.
    shell(program + " run '" + preset + "' --passes 1 -o " + quoted("first"), log);
    // Keys slower than one frame: where Ctrl goes up before the key within a frame, Dear ImGui sees the key alone.
    write_file_whole(folder.path() / "events.sh", fmt::format(R"(#!/bin/sh
at() {{ xdotool mousemove --window $id $1 $2; sleep 0.1; }}
press() {{ sleep 0.9; xdotool mousedown 1; sleep 0.5; }}
let_go() {{ sleep 0.5; xdotool mouseup 1; sleep 0.5; }}
glide() {{ for i in 1 2 3 4 5 6 7 8; do at $(($1 + ($3 - $1) * i / 8)) $(($2 + ($4 - $2) * i / 8)); done; }}
drag() {{ at $1 $2; press; glide $1 $2 $3 $4; let_go; }}
click() {{ at $1 $2; press; let_go; }}
chord() {{ xdotool keydown ctrl; sleep 0.4; xdotool keydown $1; sleep 0.4; xdotool keyup $1; sleep 0.4; xdotool keyup ctrl; sleep 0.4; }}
picture() {{ import -window $id "png24:$1"; }}
{} '{}' {} --frames 100000 --screenshot {} &
id=$(timeout 20 xdotool search --sync --onlyvisible --name Nephroid | head -n 1)
xdotool windowfocus $id
sleep 3
{}
wait
)",
                                                              program, preset, options, quoted("screen.png"), events));
    return shell(on_display() + "timeout 60 sh " + quoted("events.sh"), log);
  }
  /// Opens a preset, drags with the left button from one place of the window to another, saves and quits.
  int drag_and_save(const std::string& file, const std::string& options, const std::array<int, 2>& from, const std::array<int, 2>& to) const
  {
    return play(file, options, fmt::format("drag {} {} {} {}\nchord s\nchord q", from[0], from[1], to[0], to[1]));
  }
};

} // namespace nephroid::test
