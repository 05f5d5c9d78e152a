// SPDX-License-Identifier: Apache-2.0
#include "run/animation.h"

#include "base/files.h"
#include "base/numbers.h"
#include "image/image.h"
#include "measure/run_files.h"
#include "preset/animation.h"
#include "preset/read.h"
#include "run/afterimage.h"
#include "run/content.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <iterator>
#include <spawn.h>
#include <sstream>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace nephroid::run {
namespace fs = std::filesystem;
namespace {

constexpr std::array kinds{".png", ".exr"};
constexpr const char* of_all_frames[] = {"frames.csv", "animation.mp4"};

/// The number in "0003", -1 where the text is no frame's number.
int frame_number(std::string_view text) { return text.size() == 4 ? number_in<int>(text).value_or(-1) : -1; }

/// The number in "frame_0003.png"; -1 for another file.
int frame_of(const fs::path& file) {
  const std::string stem = file.stem().string(), extension = file.extension().string();
  const bool is_picture = std::find(kinds.begin(), kinds.end(), extension) != kinds.end();
  return is_picture && stem.starts_with("frame_") ? frame_number(std::string_view(stem).substr(6)) : -1;
}

std::vector<fs::path> entries(const fs::path& folder) {
  std::vector<fs::path> all;
  if (is_there(folder))
    for (const auto& entry : fs::directory_iterator(folder)) all.push_back(entry.path());
  return all;
}

bool can_be_read(const fs::path& picture) {
  try {
    image::read_image(picture);
    return true;
  } catch (const Error&) {
    return false;
  }
}

// ffmpeg is asked for a video as a person would, on a command line.
constexpr const char* unfinished = "animation.part.mp4";

/// 4:2:0 has a colour for two by two pixels. BT.709 is what players take a video for.
constexpr const char* filters = "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709,format=yuv420p,"
                                "setparams=color_primaries=bt709:color_trc=bt709:colorspace=bt709";

/// Words without blanks in them.
std::vector<std::string> command(int frames, double fps) {
  std::istringstream words(fmt::format(
      "ffmpeg -nostdin -loglevel error -y -framerate {} -start_number 0 -i frame_%04d.png -frames:v {} -vf {} "
      "-c:v libx264 -crf 16 -movflags +faststart {}",
      fps, frames, filters, unfinished));
  return {std::istream_iterator<std::string>(words), {}};
}

/// What a program that ran said on standard error, and how it ended, as waitpid gives it.
struct ProgramResult {
  int status = 0;
  std::string said;
};

/// Runs a program of the PATH in a folder, with no signal blocked. Returns the system's reason where it cannot be
/// started.
int run_in(const fs::path& folder, std::vector<std::string> words, ProgramResult& ended) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) return errno;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY,
                                   0); // results of this program go there
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
std::string last_line(const std::string& text) {
  const std::size_t end = text.find_last_not_of(" \r\n\t");
  if (end == std::string::npos) return {};
  const std::size_t begin = text.find_last_of("\r\n", end) + 1; // npos + 1 is 0: the first line
  return text.substr(begin, end + 1 - begin);
}

} // namespace

fs::path frame_folder(const fs::path& folder, int frame) { return folder / "frames" / fmt::format("{:04}", frame); }

fs::path frame_picture(const fs::path& folder, int frame) { return folder / fmt::format("frame_{:04}.png", frame); }

void show_frame(const fs::path& folder, int frame) {
  for (const char* kind : kinds) {
    const fs::path picture = frame_folder(folder, frame) / (std::string("image") + kind);
    const fs::path shown = frame_picture(folder, frame).replace_extension(kind);
    std::error_code error;
    if (fs::equivalent(picture, shown, error)) continue;
    fs::remove(shown, error);
    fs::create_hard_link(picture, shown, error);
    if (error) write_file_whole(shown, read_file(picture));
  }
}

void hide_frame(const fs::path& folder, int frame) {
  std::error_code ignored;
  for (const char* kind : kinds) fs::remove(frame_picture(folder, frame).replace_extension(kind), ignored);
  for (const char* name : of_all_frames) fs::remove(folder / name, ignored);
}

std::optional<FinishedRun> finished_frame(const fs::path& folder, int frame, const preset::Preset& preset,
                                          const Afterimage* before) {
  const fs::path own = frame_folder(folder, frame);
  auto done = finished_run(own, preset);
  if (!done || !can_be_read(own / "image.exr") || !can_be_read(own / "image.png")) return std::nullopt;
  if (before && done->changed.empty()) done->changed = changed_input(own, {before->input});
  return done;
}

fs::path frame_before(const fs::path& folder, int frame, const preset::Preset& animation) {
  if (frame == 0 || !is_there(frame_folder(folder, frame - 1) / afterimage_file)) return {};
  const auto done = finished_frame(folder, frame - 1, preset::at_frame(animation, frame - 1), nullptr);
  return done && done->changed.empty() ? frame_folder(folder, frame - 1) : fs::path();
}

std::vector<int> finished_frames(const fs::path& folder, const preset::Preset& preset) {
  std::vector<int> finished;
  const std::vector<plan::Input> inputs = read_inputs(preset); // all frames have the same
  for (int frame = 0; frame < preset.animation.value().frames; ++frame) {
    const auto done = finished_run(frame_folder(folder, frame), preset::at_frame(preset, frame), inputs);
    if (done && done->changed.empty()) finished.push_back(frame);
  }
  return finished;
}

void remove_frames(const fs::path& folder, int first) {
  std::error_code ignored;
  for (const fs::path& file : entries(folder))
    if (frame_of(file) >= first) fs::remove(file, ignored);
  for (const fs::path& own : entries(folder / "frames"))
    if (frame_number(own.filename().string()) >= first) fs::remove_all(own, ignored);
  fs::remove(folder / "frames", ignored); // where it is empty
  for (const char* name : of_all_frames) fs::remove(folder / name, ignored);
}

void write_frame_figures(const fs::path& folder, const std::vector<int>& frames) {
  std::string text = "frame,step,work,work_seconds,error\n";
  for (const int frame : frames) {
    const measure::RunDocument run(frame_folder(folder, frame) / "run.json");
    using Type = measure::RunDocument::Type;
    const auto number = [&](const std::string& name) { return run.at("/" + name, Type::number).dump(); };
    std::string error;
    if (run.has("/errors")) {
      const std::string column = "/errors/" + run.at("/error_column", Type::text).get<std::string>();
      if (run.has(column) && run.json()[nlohmann::ordered_json::json_pointer(column)].is_number())
        error = number(column.substr(1));
    }
    text += fmt::format("{},{},{},{},{}\n", frame, number(run.at("/units/steps", Type::text).get<std::string>()),
                        number(run.at("/units/work", Type::text).get<std::string>()), number("work_seconds"), error);
  }
  write_file_whole(folder / "frames.csv", text);
}

std::optional<std::string> make_video(const fs::path& folder, int frames, double fps) {
  ProgramResult ended;
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
