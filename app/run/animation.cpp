// SPDX-License-Identifier: Apache-2.0
#include "run/animation.h"

#include "base/error.h"
#include "base/files.h"
#include "image/image.h"
#include "measure/run_files.h"
#include "preset/animation.h"
#include "run/content.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <system_error>

namespace nephroid::run {
namespace fs = std::filesystem;
namespace {

constexpr std::array kinds{".png", ".exr"};
constexpr const char* of_all_frames[] = {"frames.csv", "animation.mp4"};

/// The number in "0003", -1 where the text is no frame's number.
int frame_number(std::string_view text)
{
  int number = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return text.size() == 4 && error == std::errc() && end == text.data() + text.size() ? number : -1;
}

/// Of "frame_0003.png"; -1 of another file.
int frame_of(const fs::path& file)
{
  const std::string stem = file.stem().string(), extension = file.extension().string();
  const bool is_picture = std::find(kinds.begin(), kinds.end(), extension) != kinds.end();
  return is_picture && stem.starts_with("frame_") ? frame_number(std::string_view(stem).substr(6)) : -1;
}

std::vector<fs::path> entries(const fs::path& folder)
{
  std::vector<fs::path> all;
  if (is_there(folder))
    for (const auto& entry : fs::directory_iterator(folder)) all.push_back(entry.path());
  return all;
}

bool can_be_read(const fs::path& picture)
{
  try {
    image::read_image(picture);
    return true;
  } catch (const Error&) {
    return false;
  }
}

} // namespace

fs::path frame_folder(const fs::path& folder, int frame) { return folder / "frames" / fmt::format("{:04}", frame); }

fs::path frame_picture(const fs::path& folder, int frame) { return folder / fmt::format("frame_{:04}.png", frame); }

void show_frame(const fs::path& folder, int frame)
{
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

void hide_frame(const fs::path& folder, int frame)
{
  std::error_code ignored;
  for (const char* kind : kinds) fs::remove(frame_picture(folder, frame).replace_extension(kind), ignored);
  for (const char* name : of_all_frames) fs::remove(folder / name, ignored);
}

std::optional<FinishedRun> finished_frame(const fs::path& folder, int frame, const preset::Preset& preset)
{
  const fs::path own = frame_folder(folder, frame);
  auto done = finished_run(own, preset);
  if (!done || !can_be_read(own / "image.exr") || !can_be_read(own / "image.png")) return std::nullopt;
  return done;
}

std::vector<int> finished_frames(const fs::path& folder, const preset::Preset& preset)
{
  std::vector<int> finished;
  const std::vector<plan::Input> inputs = read_inputs(preset); // all frames have the same
  for (int frame = 0; frame < preset.animation.value().frames; ++frame) {
    const auto done = finished_run(frame_folder(folder, frame), preset::at_frame(preset, frame), inputs);
    if (done && done->changed.empty()) finished.push_back(frame);
  }
  return finished;
}

void remove_frames(const fs::path& folder, int first)
{
  std::error_code ignored;
  for (const fs::path& file : entries(folder))
    if (frame_of(file) >= first) fs::remove(file, ignored);
  for (const fs::path& own : entries(folder / "frames"))
    if (frame_number(own.filename().string()) >= first) fs::remove_all(own, ignored);
  fs::remove(folder / "frames", ignored); // where it is empty
  for (const char* name : of_all_frames) fs::remove(folder / name, ignored);
}

void write_frame_figures(const fs::path& folder, const std::vector<int>& frames)
{
  std::string text = "frame,step,work,work_seconds,error\n";
  for (const int frame : frames) {
    const measure::RunDocument run(frame_folder(folder, frame) / "run.json");
    using Type = measure::RunDocument::Type;
    const auto number = [&](const std::string& name) { return run.at("/" + name, Type::number).dump(); };
    std::string error;
    if (run.has("/errors")) {
      const std::string column = "/errors/" + run.at("/error_column", Type::text).get<std::string>();
      if (run.has(column) && run.json()[nlohmann::ordered_json::json_pointer(column)].is_number()) error = number(column.substr(1));
    }
    text += fmt::format("{},{},{},{},{}\n", frame, number(run.at("/units/steps", Type::text).get<std::string>()),
                        number(run.at("/units/work", Type::text).get<std::string>()), number("work_seconds"), error);
  }
  write_file_whole(folder / "frames.csv", text);
}

} // namespace nephroid::run
