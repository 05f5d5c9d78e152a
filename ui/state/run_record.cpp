// SPDX-License-Identifier: Apache-2.0
#include "ui/state/run_record.h"

#include "base/counted.h"
#include "base/error.h"
#include "base/files.h"
#include "base/json_output.h"
#include "image/image.h"
#include "measure/run_curves.h"
#include "measure/run_files.h"
#include "preset/animation.h"
#include "preset/read.h"
#include "report/report.h"
#include "run/prepare.h"
#include "run/write_run.h"
#include "ui/state/files.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <system_error>

namespace nephroid::ui {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::array text_files{"run.json", "plan.json", "preset.json"};

/// The engine names run.json's members. A member of another type counts as unknown.
void read_figures(const std::string& text, RunRecord& record) {
  const Json run = Json::parse(text, nullptr, false);
  if (!run.is_object()) return;
  const auto member = [](const Json& of, const std::string& key) {
    return of.is_object() ? of.value(key, Json()) : Json();
  };
  if (const Json engine = member(run, "engine"); engine.is_string()) record.engine = engine;
  if (const Json finished = member(run, "finished"); finished.is_boolean()) record.finished = finished;
  if (const Json seconds = member(run, "work_seconds"); seconds.is_number())
    record.work_seconds = seconds.get<double>();
  if (const Json steps = member(member(run, "units"), "steps"); steps.is_string()) record.steps_name = steps;
  if (const Json steps = member(run, record.steps_name); steps.is_number_integer())
    record.steps = steps.get<std::int64_t>();
}

std::string renamed(const std::string& text, const std::string& name) {
  Json json = Json::parse(text, nullptr, false);
  if (name.empty() || !json.is_object()) return text;
  json["name"] = name;
  return json_text(json, 2) + "\n";
}

std::string folder_name(std::size_t number, const std::string& name) {
  constexpr std::size_t longest = 40;
  std::string plain = name.substr(0, longest);
  for (char& c : plain)
    if (!std::isalnum(static_cast<unsigned char>(c)) && std::string_view("._-+=,").find(c) == std::string_view::npos)
      c = '-';
  return fmt::format("{:02}-{}", number, plain);
}

bool is_still_there(const RunRecord& record) {
  if (record.folder.empty()) return false;
  try {
    return std::ranges::all_of(record.texts,
                               [&](const auto& file) { return read_file(record.folder / file.first) == file.second; });
  } catch (const Error&) {
    return false;
  }
}

/// Removes the written folder at its end, unless it is kept.
struct Written {
  fs::path folder; ///< empty while nothing was written
  bool keep = false;
  ~Written() {
    std::error_code ignored;
    if (!keep && !folder.empty()) fs::remove_all(folder, ignored);
  }
};

} // namespace

PinnedRun look_at_run(const RunInHand& run) {
  const job::Progress& progress = run.snapshot()->progress;
  RunRecord record;
  record.steps_name = progress.units.steps;
  record.steps = progress.step;
  record.work_seconds = progress.work_seconds;
  record.finished = progress.fraction >= 1 && !run.snapshot()->stands_in;
  record.preset = run.snapshot_origin().preset;
  if (record.preset) record.engine = record.preset->settings.engine();
  PinnedRun now;
  now.name = run.snapshot_name();
  now.history = run.error_history() ? run.error_history() : std::make_shared<job::History>();
  now.picture = run.snapshot()->picture;
  now.record = std::make_shared<const RunRecord>(std::move(record));
  return now;
}

PinnedRun run_now(const RunInHand& run) {
  PinnedRun now = look_at_run(run);
  if (const RunOrigin& origin = run.snapshot_origin(); origin.preset && origin.plan) {
    auto record = std::make_shared<RunRecord>(*now.record);
    record->origin = origin;
    if (origin.preset->animation) { // the picture is of one frame, and so is what its folder will say
      record->preset = record->origin->preset = std::make_shared<const preset::Preset>(
          preset::at_frame(*origin.preset, origin.preset->provenance.frame.value_or(0)));
    }
    auto kept = std::make_shared<job::Snapshot>(*run.snapshot());
    kept->picture.reset();
    kept->files.clear(); // a mesh can be as large as the memory
    record->snapshot = std::move(kept);
    now.record = std::move(record);
  }
  return now;
}

std::vector<PinnedRun> runs_of_table(const Comparing& comparing, const RunInHand& run) {
  std::vector<PinnedRun> runs = comparing.pinned().runs();
  const auto& now = run.snapshot();
  if (now && std::ranges::find(runs, now->picture, &PinnedRun::picture) == runs.end()) runs.push_back(run_now(run));
  return runs;
}

std::shared_ptr<const RunRecord> read_record(const fs::path& folder) {
  if (!is_there(folder / "run.json")) return nullptr;
  auto record = std::make_shared<RunRecord>();
  record->folder = folder;
  for (const char* name : text_files)
    if (is_there(folder / name)) record->texts[name] = read_file(folder / name);
  read_figures(record->texts["run.json"], *record);
  if (!record->texts.contains("preset.json")) return record;
  try {
    record->preset = std::make_shared<const preset::Preset>(
        preset::parse_preset(record->texts["preset.json"], (folder / "preset.json").string()));
  } catch (const Error&) {
    // perhaps of another version of the program: the run is shown without it
  }
  return record;
}

std::optional<KnownError> known_error(const job::History& history) {
  if (history.rows.empty()) return std::nullopt;
  for (const std::string& column : {history.error_column, std::string("lab_mean"), std::string("estimated_lab_mean")}) {
    const double value = job::error_in(history, history.rows.back(), column);
    if (!std::isfinite(value)) continue;
    const measure::ErrorColumn parts = measure::error_column_of(column);
    return KnownError{value, parts.metric, parts.is_estimate};
  }
  return std::nullopt;
}

std::string why_no_folder(const PinnedRun& run) {
  if (!run.record) return "only its history was read, not the folder of a run";
  if (!run.record->finished) return "it is not finished";
  if (!run.picture) return "it has no picture";
  if (!run.record->origin) {
    for (const char* name : text_files)
      if (!run.record->texts.contains(name)) return std::string("its folder had no ") + name;
  }
  return {};
}

void write_run_folder(const fs::path& folder, const PinnedRun& run, const std::string& name, bool further) {
  if (run.record && run.record->origin) {
    const RunOrigin& origin = *run.record->origin;
    run::Prepared prepared{*origin.preset, nullptr, origin.plan};
    if (!name.empty()) prepared.preset.name = name;
    job::Snapshot snapshot = *run.record->snapshot;
    snapshot.picture = run.picture;
    if (!further) snapshot.pictures.clear();
    return run::write_run(folder, prepared, origin.device, snapshot, origin.reference.get(), run.record->finished);
  }
  // Writes what was read, without other files of the folder.
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw failed(folder.string(), "cannot be made: " + error.message());
  write_file_whole(folder / "history.csv", measure::to_csv(*run.history));
  if (run.picture) image::write_exr(folder / "image.exr", run::with_layers(*run.picture));
  if (!run.record) return;
  for (const auto& [file, text] : run.record->texts) {
    const bool moved = file == std::string("preset.json") && run.record->preset;
    write_file_whole(folder / file, renamed(moved ? preset::to_json(*run.record->preset, folder) + "\n" : text, name));
  }
}

std::string write_report(const fs::path& file, std::span<const PinnedRun> runs) {
  if (file.extension() != ".html")
    throw bad_input(file.string(), "a report is a page", "expected a name that ends in .html");
  std::string left_out;
  std::vector<const PinnedRun*> taken;
  for (const PinnedRun& run : runs) {
    std::string why = why_no_folder(run);
    if (taken.size() == report::max_runs) why = fmt::format("a page has at most {} runs", report::max_runs);
    if (why.empty())
      taken.push_back(&run);
    else
      left_out += fmt::format("{}\"{}\": {}", left_out.empty() ? "" : "; ", run.name, why);
  }
  if (taken.empty())
    throw bad_input(file.string(), "there is no run for a report" + (left_out.empty() ? "" : " (" + left_out + ")"),
                    "expected finished runs", "wait until the run is finished, or pin finished ones");
  Written written;
  std::vector<fs::path> folders;
  std::set<fs::path> seen;
  for (const PinnedRun* run : taken) {
    if (is_still_there(*run->record)) {
      if (seen.insert(run->record->folder).second) folders.push_back(run->record->folder); // else it was pinned twice
      continue;
    }
    if (written.folder.empty()) written.folder = make_new_folder(file.parent_path() / (file.stem().string() + "-runs"));
    folders.push_back(written.folder / folder_name(folders.size() + 1, run->name));
    write_run_folder(folders.back(), *run, run->name, true);
  }
  write_file_whole(file, report::report_html(folders));
  written.keep = true;
  std::string note = fmt::format("saved {}, a report over {}", file.string(), counted(folders.size(), "run"));
  if (!written.folder.empty()) note += fmt::format("; their files are in {}", written.folder.string());
  return left_out.empty() ? note : note + "; left out: " + left_out;
}

} // namespace nephroid::ui
