// SPDX-License-Identifier: Apache-2.0
#include "ui/state/pinned_runs.h"

#include "base/files.h"
#include "measure/read_picture.h"
#include "measure/run_files.h"
#include "ui/state/files.h"
#include "ui/state/run_record.h"
#include "ui/state/selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace nephroid::ui {
namespace {

/// The colours of Okabe and Ito (2008), without black, as IM_COL32. People with any colour vision tell them apart.
constexpr std::array<std::uint32_t, 7> colours{0xff009fe6, 0xffe9b456, 0xff739e00, 0xff42e4f0,
                                               0xffa779cc, 0xff005ed5, 0xffb27200};

constexpr const char* history_name = "history.csv";

std::filesystem::path history_file(const std::filesystem::path& path) {
  constexpr const char* expected = "expected the folder of a run, its history.csv, or a picture";
  constexpr const char* remedy = "give the folder of `nephroid run PRESET -o FOLDER`";
  if (!is_there(path)) throw bad_input(path.string(), "there is no such run", expected, remedy);
  if (std::error_code ignored; !std::filesystem::is_directory(path, ignored)) {
    if (!is_history(path)) throw bad_input(path.string(), "is no run's history", expected, remedy);
    return path;
  }
  if (!is_there(path / history_name)) throw bad_input(path.string(), "has no history.csv", expected, remedy);
  return path / history_name;
}

PinnedRun read_picture_pin(const std::filesystem::path& path) {
  PinnedRun pin;
  std::error_code ignored;
  pin.file = std::filesystem::absolute(path, ignored).lexically_normal();
  pin.name = path.filename().string();
  pin.history = std::make_shared<job::History>();
  measure::OpenedPicture opened = measure::open_picture(path);
  pin.read_as = opened.picture.decoded ? "sRGB integers, decoded" : "floats, linear";
  if (opened.picture.grey) pin.read_as += ", grey";
  if (!opened.stands_in.empty()) pin.read_as += fmt::format(", layer {}", opened.stands_in);
  auto picture = std::make_shared<job::Picture>();
  picture->width = opened.picture.width;
  picture->height = opened.picture.height;
  picture->rgb = std::move(opened.picture.rgb);
  picture->layers = std::move(opened.layers);
  pin.picture = std::move(picture);
  return pin;
}

} // namespace

std::vector<PinnedRun> PinnedRuns::runs() const {
  std::vector<PinnedRun> runs;
  std::ranges::copy_if(runs_, std::back_inserter(runs), &PinnedRun::is_run);
  return runs;
}

const PinnedRun* PinnedRuns::find(std::uint64_t id) const {
  const auto run = std::ranges::find(runs_, id, &PinnedRun::id);
  return run == runs_.end() ? nullptr : &*run;
}

std::string PinnedRuns::own_name(const std::string& wanted, std::uint64_t id) const {
  const auto taken = [&](const std::string& name) {
    return std::ranges::any_of(runs_, [&](const PinnedRun& run) { return run.id != id && run.name == name; });
  };
  return untaken_name(wanted, taken, "{} ({})");
}

std::uint32_t PinnedRuns::free_colour() const {
  for (const std::uint32_t colour : colours)
    if (std::none_of(runs_.begin(), runs_.end(), [&](const PinnedRun& run) { return run.colour == colour; }))
      return colour;
  return colours[runs_.size() % colours.size()];
}

const PinnedRun& PinnedRuns::add(PinnedRun run) {
  run.id = ++last_id_;
  run.name = own_name(run.name, run.id);
  if (run.colour == 0) run.colour = free_colour();
  return runs_.emplace_back(std::move(run));
}

void PinnedRuns::change(std::uint64_t id, std::string name, std::uint32_t colour, bool shown) {
  const auto run = std::ranges::find(runs_, id, &PinnedRun::id);
  if (run == runs_.end()) return;
  if (!name.empty() && name != run->name) run->name = own_name(name, id);
  run->colour = colour;
  run->shown = shown;
}

void PinnedRuns::remove(std::uint64_t id) {
  std::erase_if(runs_, [&](const PinnedRun& run) { return run.id == id; });
}

bool is_history(const std::filesystem::path& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) return is_there(path / history_name);
  return path.extension() == ".csv";
}

std::string preset_of_run(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "preset.json";
  return is_there(file) ? file.string() : "";
}

bool is_picture(const std::filesystem::path& path) {
  const FileKind kind = kind_of(path);
  return kind == FileKind::map || kind == FileKind::picture;
}

PinnedRun read_pin(const std::filesystem::path& path) {
  if (is_picture(path)) return read_picture_pin(path);
  const std::filesystem::path file = history_file(path);
  const std::filesystem::path folder = std::filesystem::absolute(file).lexically_normal().parent_path();
  PinnedRun run;
  const bool is_of_folder = file.filename() == history_name; // the files beside it belong to the same run
  run.history =
      std::make_shared<job::History>(is_of_folder ? measure::read_run_history(folder) : measure::read_history(file));
  run.name = is_of_folder ? folder.filename().string() : file.stem().string();
  if (const std::filesystem::path image = folder / "image.exr"; is_of_folder && is_there(image)) {
    auto picture = std::make_shared<job::Picture>();
    measure::LinearPicture read = measure::read_linear_rgb(image, picture->layers);
    picture->width = read.width;
    picture->height = read.height;
    picture->rgb = std::move(read.rgb);
    run.picture = std::move(picture);
  }
  if (is_of_folder) run.record = read_record(folder);
  return run;
}

} // namespace nephroid::ui
