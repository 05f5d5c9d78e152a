// SPDX-License-Identifier: Apache-2.0
// What a run writes is required, but for what older versions did not write yet: a report with holes would be believed.
#include "measure/run_summary.h"

#include "base/error.h"
#include "base/files.h"
#include "measure/history_file.h"
#include "measure/json_object.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <system_error>

namespace nephroid::measure {
namespace fs = std::filesystem;
namespace {

std::map<std::string, double> as_map(std::vector<std::pair<std::string, double>> values)
{
  return {std::make_move_iterator(values.begin()), std::make_move_iterator(values.end())};
}

/// The entries that are powers, without their unit; the count of refused contributions is none.
std::vector<std::pair<std::string, double>> powers(const JsonObject& energy)
{
  std::vector<std::pair<std::string, double>> all;
  for (const auto& [key, watts] : energy.numbers())
    if (key.ends_with("_w")) all.emplace_back(key.substr(0, key.size() - 2), watts);
  return all;
}

std::optional<RunReference> reference_of(const JsonObject& json)
{
  if (!json.has("reference")) return std::nullopt;
  const JsonObject reference = json.object("reference");
  RunReference result{reference.text("origin"), {}};
  if (reference.has("noise_floor")) result.noise_floor = as_map(reference.object("noise_floor").numbers());
  return result;
}

void read_optional(RunSummary& run, const JsonObject& json)
{
  if (json.has("wall_seconds")) run.wall_seconds = json.number("wall_seconds");
  if (json.has("measuring_seconds")) run.measuring_seconds = json.number("measuring_seconds");
  if (json.has("error_column")) run.error_column = json.text("error_column");
  if (json.has("errors")) run.errors = as_map(json.object("errors").numbers());
  run.reference = reference_of(json);
}

void read_run_json(RunSummary& run)
{
  const fs::path file = run.folder / "run.json";
  const Json document = read_json(file);
  const JsonObject json(document, file.string());
  run.passes = json.count<std::int64_t>("passes");
  if (!json.flag("finished"))
    throw bad_input(run.folder.string(), fmt::format("this run is not finished: it stopped in pass {}", run.passes + 1),
                    "expected a finished run", "go on with `nephroid run --resume`");
  run.name = json.text("name");
  run.engine = json.text("engine");
  run.seed = json.count<std::uint64_t>("seed");
  run.version = json.text("version");
  run.commit = json.text("commit");
  run.compiler = json.text("compiler");
  run.device = json.object("device").texts();
  run.photons = json.count<std::uint64_t>("photons");
  run.work_seconds = json.number("work_seconds");
  run.phase_seconds = json.object("phase_seconds").numbers();
  run.energy_w = powers(json.object("energy"));
  read_optional(run, json);
}

void read_settings(RunSummary& run)
{
  const fs::path file = run.folder / "preset.json";
  const Json document = read_json(file);
  if (!document.is_object()) throw bad_input(file.string(), "is no object");
  const Json flat = document.flatten();
  for (const auto& [pointer, value] : flat.items()) { // "/scene/lights/0/power_w"
    std::string key = pointer.empty() ? pointer : pointer.substr(1);
    std::replace(key.begin(), key.end(), '/', '.');
    run.settings[key] = value.dump();
  }
}

void read_plan(RunSummary& run)
{
  const fs::path file = run.folder / "plan.json";
  const Json document = read_json(file);
  const JsonObject json(document, file.string());
  run.plan.engine = json.text("engine");
  for (const JsonObject& pass : json.objects("passes"))
    run.plan.passes.push_back({pass.text("name"), pass.flag("runs"), pass.text("reason")});
  for (const JsonObject& buffer : json.objects("buffers"))
    run.plan.buffers.push_back({buffer.text("name"), buffer.count<std::uint64_t>("bytes")});
  for (const auto& [name, value] : json.object("defines").texts()) run.plan.defines[name] = value;
  if (json.has("notes")) run.plan.notes = json.texts("notes");
}

/// A run's folder before or while it runs: begin_run has written these two, nothing has written run.json.
bool is_begun_run(const fs::path& folder) { return is_there(folder / "plan.json") && is_there(folder / "preset.json"); }

/// The run in a folder, or the runs in its folders; those that have begun but not ended are among them, for read_run to refuse.
std::vector<fs::path> runs_in(const fs::path& folder)
{
  const auto is_run = [](const fs::path& path) { return is_there(path / "run.json") || is_begun_run(path); };
  std::error_code error;
  if (!fs::exists(folder, error)) throw bad_input(folder.string(), "there is no such folder");
  if (!fs::is_directory(folder, error)) throw bad_input(folder.string(), "is a file", "expected the folder of a run");
  if (is_run(folder)) return {folder};
  std::vector<fs::path> runs;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (std::error_code ignored; entry->is_directory(ignored) && is_run(entry->path())) runs.push_back(entry->path());
  if (error) throw bad_input(folder.string(), "cannot be read: " + error.message());
  if (runs.empty())
    throw bad_input(folder.string(), "holds no run", "expected a folder with run.json, or one of a sweep with such folders inside",
                    "make one with `nephroid run`");
  std::sort(runs.begin(), runs.end());
  return runs;
}

} // namespace

std::vector<fs::path> find_runs(std::span<const fs::path> folders)
{
  std::vector<fs::path> runs;
  std::set<fs::path> seen;
  for (const fs::path& folder : folders)
    for (fs::path& run : runs_in(folder)) {
      if (!seen.insert(fs::weakly_canonical(run)).second)
        throw bad_input(run.string(), "this run is named twice", "expected every run once");
      runs.push_back(std::move(run));
    }
  if (runs.size() > max_reported_runs)
    throw bad_input(folders.front().string(), fmt::format("{} runs are too many for one page", runs.size()),
                    fmt::format("expected at most {}", max_reported_runs), "name the folders of some of them");
  return runs;
}

RunSummary read_run(const fs::path& folder)
{
  RunSummary run;
  run.folder = folder;
  if (!is_there(folder / "run.json") && is_begun_run(folder))
    throw bad_input(folder.string(), "this run is not finished: it has no run.json", "expected a finished run",
                    "wait for it, or go on with `nephroid run --resume`");
  read_run_json(run);
  read_settings(run);
  read_plan(run);
  if (is_there(folder / "history.csv")) run.history = read_history(folder / "history.csv");
  return run;
}

std::optional<RunReference> read_run_reference(const fs::path& folder)
{
  const fs::path file = folder / "run.json";
  if (!is_there(file)) return std::nullopt;
  const Json document = read_json(file);
  return reference_of(JsonObject(document, file.string()));
}

} // namespace nephroid::measure
