// SPDX-License-Identifier: Apache-2.0
// ffmpeg is asked for a video as a person would, on a command line.
#include "run/video.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <vector>

namespace nephroid::run {
namespace fs = std::filesystem;
namespace {

constexpr const char* unfinished = "animation.part.mp4";

/// 4:2:0 has a colour for two by two pixels. BT.709 is what players take a video for.
constexpr const char* filters = "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709,format=yuv420p,"
                                "setparams=color_primaries=bt709:color_trc=bt709:colorspace=bt709";

std::vector<std::string> command(int frames, double fps)
{
  return {"ffmpeg",
          "-nostdin",
          "-loglevel",
          "error",
          "-y",
          "-framerate",
          fmt::format("{}", fps),
          "-start_number",
          "0",
          "-i",
          "frame_%04d.png",
          "-frames:v",
          std::to_string(frames),
          "-vf",
          filters,
          "-c:v",
          "libx264",
          "-crf",
          "16",
          "-movflags",
          "+faststart",
          unfinished};
}

/// What a program that ran said on standard error, and how it ended, as waitpid gives it.
struct Ended {
  int status = 0;
  std::string said;
};

/// Runs a program of the PATH in a folder, with no signal blocked. Returns the system's reason where it cannot be started.
int run_in(const fs::path& folder, std::vector<std::string> words, Ended& ended)
{
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return errno;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0); // results of this program go there
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  pid_t id = -1;
  const int reason = posix_spawnp(&id, arguments[0], &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  if (reason == 0) {
    std::array<char, 4096> piece{};
    for (ssize_t count = 0; (count = read(ends[0], piece.data(), piece.size())) > 0 || (count < 0 && errno == EINTR);)
      if (count > 0) ended.said.append(piece.data(), static_cast<std::size_t>(count));
    while (waitpid(id, &ended.status, 0) < 0 && errno == EINTR) {
    }
  }
  close(ends[0]);
  return reason;
}

/// The last line that says anything: ffmpeg gives its reasons first, and what it could not do in the end.
std::string last_line(const std::string& text)
{
  const std::size_t end = text.find_last_not_of(" \r\n\t");
  if (end == std::string::npos) return {};
  const std::size_t begin = text.find_last_of("\r\n", end);
  return text.substr(begin == std::string::npos ? 0 : begin + 1, end - (begin == std::string::npos ? 0 : begin + 1) + 1);
}

} // namespace

std::optional<std::string> make_video(const fs::path& folder, int frames, double fps)
{
  Ended ended;
  const int reason = run_in(folder, command(frames, fps), ended);
  if (reason == ENOENT) return "ffmpeg is not installed, or not on the PATH";
  if (reason != 0) return fmt::format("ffmpeg cannot be started: {}", std::strerror(reason));
  std::error_code error;
  if (WIFEXITED(ended.status) && WEXITSTATUS(ended.status) == 0) {
    fs::rename(folder / unfinished, folder / "animation.mp4", error);
    if (!error) return std::nullopt;
    return "ffmpeg made none: " + error.message();
  }
  fs::remove(folder / unfinished, error);
  const std::string said = last_line(ended.said);
  return "ffmpeg failed" + (said.empty() ? std::string() : ": " + said);
}

} // namespace nephroid::run
