// SPDX-License-Identifier: Apache-2.0
#include "run/folder.h"

#include "preset/read.h"
#include "run/afterimage.h"
#include "run/animation.h"
#include "run/content.h"
#include "run/write_run.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fcntl.h>

namespace nephroid::run {
namespace fs = std::filesystem;
namespace {

constexpr std::array results{"image.exr",   "image.png",      "run.json",     "history.csv",
                             "report.html", "checkpoint.bin", afterimage_file};

/// Ours are the folders with all of these files, and those with nothing but what a killed writer left.
bool is_ours(const fs::path& folder, const std::vector<std::string>& files) {
  if (std::ranges::all_of(files, [&](const std::string& name) { return is_there(folder / name); })) return true;
  for (const auto& entry : fs::directory_iterator(folder))
    if (!is_temporary_name(entry.path())) return false;
  return true;
}

} // namespace

ClaimedFolder::ClaimedFolder(const fs::path& folder, bool alone, const FolderContent& content) : folder_{folder} {
  try {
    claim(alone, content);
  } catch (const fs::filesystem_error& error) {
    throw failed(folder.string(), "cannot be used: " + error.code().message(),
                 "expected a folder that can be written to", "choose another one with -o");
  }
}

ClaimedFolder::Made::~Made() {
  std::error_code ignored;
  if (is_new) fs::remove(path, ignored); // refused where anything is in it
}

void ClaimedFolder::claim(bool alone, const FolderContent& content) {
  const fs::path& folder = folder_.path;
  if (is_there(folder) && !fs::is_directory(folder))
    throw bad_input(folder.string(), "is a file", "expected a folder for the files of " + content.whose,
                    "choose another one with -o");
  folder_.is_new = fs::create_directories(folder);
  lock_ = lock_open_file(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC), alone);
  if (!lock_ && errno == EWOULDBLOCK)
    throw bad_input(folder.string(), "is written into by another command", {},
                    "wait for its end, or choose another folder with -o");
  if (!is_ours(folder, content.files))
    throw bad_input(folder.string(), "holds files that are not of " + content.whose,
                    "expected an empty or a new folder", "choose another one with -o");
  if (alone) // else they may be others'
    for (const auto& entry : fs::directory_iterator(folder))
      if (is_temporary_name(entry.path())) fs::remove(entry.path());
  const fs::path probe = folder / "probe";
  write_file_whole(probe, "writable?\n");
  fs::remove(probe);
}

std::vector<std::string> engine_files(const fs::path& folder) {
  std::vector<std::string> names;
  if (!is_there(folder / "run.json")) return names;
  try {
    const auto run = nlohmann::json::parse(read_file(folder / "run.json"));
    for (const auto& entry : run.at("files")) {
      const fs::path name = fs::path(entry.get<std::string>()).lexically_normal();
      if (name.is_relative() && *name.begin() != "..") names.push_back(name.string()); // nothing outside the folder
    }
  } catch (const nlohmann::json::exception&) {
    names.clear(); // written by something else
  }
  return names;
}

std::optional<double> white_of_run(const fs::path& folder) {
  if (!is_there(folder / "preset.json")) return std::nullopt;
  try {
    return nlohmann::json::parse(read_file(folder / "preset.json")).at("white").get<double>();
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

void begin_run(const fs::path& folder, const Prepared& prepared) {
  std::error_code ignored;
  for (const std::string& name : engine_files(folder)) fs::remove(folder / name, ignored); // an older run's
  for (const char* name : results) fs::remove(folder / name, ignored);
  remove_pictures_after(folder, -1);
  remove_frames(folder, 0);
  write_settings(folder, prepared);
}

void write_settings(const fs::path& folder, const Prepared& prepared) {
  write_file_whole(folder / "preset.json", preset::to_json(prepared.preset, folder) + "\n");
  write_file_whole(folder / "plan.json", plan::to_json(*prepared.plan) + "\n");
}

std::optional<FinishedRun> finished_run(const fs::path& folder, const preset::Preset& preset,
                                        const std::vector<plan::Input>& known) {
  for (const char* name : {"image.exr", "run.json", "preset.json"})
    if (!is_there(folder / name)) return std::nullopt;
  try {
    auto its = nlohmann::json::parse(read_file(folder / "preset.json")),
         ours = nlohmann::json::parse(preset::to_json(preset, folder));
    const bool is_shown_otherwise = its["display"] != ours["display"];
    its.erase("display"), ours.erase("display");
    if (its != ours) return std::nullopt;
    const auto run = nlohmann::json::parse(read_file(folder / "run.json"));
    if (!run.at("finished").get<bool>()) return std::nullopt;
    const auto& units = run.at("units"); // what the engine calls them
    const std::string steps = units.at("steps"), work = units.at("work");
    const auto words =
        std::make_shared<const std::vector<std::string>>(std::vector{units.value("step", steps), steps, work});
    job::Progress progress;
    progress.fraction = 1;
    progress.step = progress.steps = run.at(steps).get<std::int64_t>();
    progress.work = run.at(work).get<std::uint64_t>();
    progress.work_seconds = run.at("work_seconds").get<double>();
    progress.units = {.step = words->at(0), .steps = words->at(1), .work = words->at(2), .works = words->at(2)};
    return FinishedRun{progress, words, changed_input(folder, read_inputs(preset, known)), is_shown_otherwise};
  } catch (const nlohmann::json::exception&) {
    return std::nullopt; // written by something else: the run is done again
  }
}

} // namespace nephroid::run
