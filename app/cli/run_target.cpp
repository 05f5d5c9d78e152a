// SPDX-License-Identifier: Apache-2.0
#include "cli/run_target.h"

#include "base/counted.h"
#include "base/error.h"
#include "base/files.h"
#include "base/json_output.h"
#include "cli/progress.h"
#include "run/animation.h"
#include "run/meter_files.h"
#include "run/recorder.h"
#include "run/reference.h"
#include "run/write_run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace nephroid::cli {
namespace fs = std::filesystem;
namespace {

/// A run's files beside the engine's own.
constexpr const char* result_files[] = {"preset.json", "plan.json",     "run.json",      "history.csv",
                                        "report.html", "pictures.json", "checkpoint.bin"};

/// What people are shown: the picture, or the folder if there is no picture yet.
fs::path shown_of(const Target& target) {
  const fs::path picture = target.animation.empty()
                               ? target.folder / "image.png"
                               : run::frame_picture(target.animation, target.preset.provenance.frame.value());
  return fs::exists(picture) ? picture : target.folder;
}

/// "10.1 s of work: bake 9.8 s, render 0.3 s".
std::string where_time_went(const job::Snapshot& snapshot) {
  std::string phases;
  for (const auto& [name, seconds] : snapshot.phases)
    if (seconds >= 0.05) phases += fmt::format("{} {} {:.1f} s", phases.empty() ? ":" : ",", name, seconds);
  return fmt::format("{:.1f} s of work{}", snapshot.progress.work_seconds, phases);
}

bool is_frame(const Target& target) { return !target.animation.empty(); }

/// The reference; renders a recipe's if that is not in the cache.
std::shared_ptr<const measure::Reference> reference_of(const RunOptions& options, const Target& target,
                                                       const std::stop_token& interrupted,
                                                       const run::Prepared& prepared, const compute::Context& context) {
  const auto& recipe = prepared.preset.reference;
  auto reference = run::find_reference(prepared, context);
  if (reference || !recipe) return reference;
  fmt::print(stderr, "{}: rendering the reference, 2 x {}; it is kept for later runs\n", target.label,
             counted(recipe->passes, "pass", "passes"));
  job::Progress progress;
  progress.steps = 2 * static_cast<std::int64_t>(recipe->passes);
  ProgressDisplay display(progress_style(options.json), {target.label + " reference", target.preset.name, "reference"},
                          progress);
  reference = run::make_reference(prepared, context, interrupted, [&](double fraction, double seconds) {
    progress.fraction = fraction;
    progress.step = static_cast<std::int64_t>(fraction * static_cast<double>(progress.steps));
    progress.work_seconds = seconds;
    display.update(progress);
  });
  display.finish(progress);
  return reference;
}

/// A frame whose preset has changed starts anew; the other frames may be unchanged.
void say_bad_checkpoint(const Target& target, const Error& error) {
  if (!is_frame(target)) throw error.noting("run without --resume to start over");
  fmt::print(stderr, "note: {}; the frame starts anew\n", error.line());
}

void make_ready(const RunOptions& options, const Target& target, const std::stop_token& interrupted,
                RunSeries& series) {
  const bool is_root = Communicator(series.ranks).is_root();
  LiveLine activity; // shown before there are figures
  run::ReadyOptions ready{.watch = {interrupted, {}},
                          .ranks = series.ranks,
                          .folder = target.folder,
                          .is_frame = is_frame(target),
                          .frame_before = target.frame_before,
                          .resume = options.resume};
  ready.watch.tell = [&](const std::string& doing) {
    if (progress_style(options.json) == ProgressStyle::live) activity.show(target.label + "  " + doing);
  };
  ready.measure_at = options.pictures_at;
  ready.planned = [&](const run::Prepared& prepared) {
    activity.clear();
    for (const std::string& note : prepared.plan->notes)
      if (is_root && (!is_frame(target) || series.notes.insert(note).second)) fmt::print(stderr, "note: {}\n", note);
  };
  ready.reference = [&](const run::Prepared& prepared, const compute::Context& context) {
    activity.clear();
    return reference_of(options, target, interrupted, prepared, context);
  };
  ready.bad_checkpoint = [&](const Error& error) {
    activity.clear();
    say_bad_checkpoint(target, error);
  };
  run::make_ready(series.run, target.preset, ready);
}

void say_beginning(const RunOptions& options, const Target& target, const run::ReadyRun& run) {
  const job::Progress progress = run.job->progress();
  if (run.resumed)
    fmt::print(stderr, "{}: going on in {} {} ({:.1f} s of work so far)\n", target.label, progress.units.step,
               progress.step + 1, progress.work_seconds);
  else if (options.resume && !is_frame(target))
    fmt::print(stderr, "{}: no checkpoint in {}, starting from the beginning\n", target.label, target.folder.string());
}

/// Reports a run's progress while its folder is written.
class Console final : public run::Recorder {
public:
  Console(const RunOptions& options, const Target& target, const run::ReadyRun& run)
      : Recorder(run, {target.folder, options.checkpoint_seconds, options.pictures_at, is_frame(target)}),
        options_(options), target_(target) {}

  void begun(job::Job& job) override {
    Recorder::begun(job);
    display_.emplace(progress_style(options_.json), ProgressSubject{target_.label, target_.preset.name},
                     job.progress());
  }
  void advanced(job::Job& job) override {
    display_->update(job.progress());
    Recorder::advanced(job);
  }
  void ended(job::Job& job) override {
    display_->finish(job.progress());
    Recorder::ended(job);
  }

private:
  void clear() {
    if (display_) display_->clear();
  }
  void note(const std::string& sentence) override {
    clear();
    fmt::print(stderr, "note: {}: {}\n", target_.label, sentence);
  }
  void warn(const std::string& sentence) override {
    clear();
    fmt::print(stderr, "warning: {}\n", sentence);
  }
  void picture_written(const nlohmann::ordered_json& entry, const std::string& error_column) override {
    clear();
    if (options_.json) {
      nlohmann::ordered_json line{{"type", "picture"}, {"name", target_.preset.name}};
      line.update(entry);
      fmt::print("{}\n", json_text(line));
      std::fflush(stdout);
      return;
    }
    const auto error = entry["errors"].find(error_column);
    const bool is_known = error != entry["errors"].end() && error->is_number();
    fmt::print(stderr, "{}: {} after {:.1f} s of work{}\n", target_.label,
               (target_.folder / entry["picture"].get<std::string>()).string(), entry["work_seconds"].get<double>(),
               is_known ? fmt::format(", {} {:.3g}", error_column, error->get<double>()) : "");
  }

  const RunOptions& options_;
  const Target& target_;
  std::optional<ProgressDisplay> display_;
};

void say_meters(const RunOptions& options, const Target& target, const meters::Readings& readings) {
  for (const std::string& note : readings.notes) fmt::print(stderr, "note: {}: meters: {}\n", target.label, note);
  if (options.json) return;
  for (const std::string& line : run::summary(readings)) fmt::print("{}\n", line);
}

/// Throws if the run was interrupted or has no picture.
void say_end(const RunOptions& options, const Target& target, const job::Job& job, const Console& console) {
  const job::Snapshot& last = console.last();
  const job::Progress& progress = last.progress;
  report_result(options, target, progress, console.is_finished());
  if (last.meters)
    say_meters(options, target, *last.meters);
  else if (!target.preset.scene.meters.empty())
    fmt::print(stderr, "note: {}: the run ended before its meters had read: nephroid measure gives them more time\n",
               target.label);
  for (const std::string& warning : last.warnings) fmt::print(stderr, "note: {}: {}\n", target.label, warning);
  if (job.finished() && last.stands_in)
    throw failed(target.folder.string(), "the run ended before its first picture, after " + where_time_went(last),
                 "a checkpoint is saved", "go on with --resume and a longer time: --seconds 60");
  if (!console.is_finished())
    throw Error(ErrorKind::interrupted, target.folder.string(),
                fmt::format("interrupted in {} {}", progress.units.step, progress.step + 1),
                last.stands_in ? "a checkpoint is saved" : "the image and a checkpoint are saved",
                "go on with --resume");
  if (progress.step == 0)
    fmt::print(stderr, "note: {}: the run ended before its first {} was whole, after {}\n", target.label,
               progress.units.step, where_time_went(last));
}

} // namespace

void report_result(const RunOptions& options, const Target& target, const job::Progress& progress, bool finished) {
  std::vector<std::string> files = run::engine_files(target.folder);
  for (const char* name : result_files)
    if (fs::exists(target.folder / name)) files.emplace_back(name);
  for (const auto& entry : run::pictures_at(target.folder)) {
    const fs::path picture = entry["picture"].get<std::string>();
    files.insert(files.end(), {picture.string(), fs::path(picture).replace_extension(".exr").string()});
  }
  if (options.json) {
    nlohmann::ordered_json all{{"type", "result"},
                               {"name", target.preset.name},
                               {"folder", target.folder.string()},
                               {"files", files},
                               {"finished", finished},
                               {std::string(progress.units.steps), progress.step},
                               {std::string(progress.units.works), progress.work},
                               {"work_seconds", progress.work_seconds}};
    if (target.preset.provenance.frame) all["frame"] = *target.preset.provenance.frame;
    fmt::print("{}\n", json_text(all));
  } else {
    const job::Units& units = progress.units;
    const std::string work = progress.work < 100'000
                                 ? fmt::format("{}", progress.work)
                                 : fmt::format("{:.1f} million", static_cast<double>(progress.work) * 1e-6);
    fmt::print("{}: {}, {} {} in {:.1f} s of work\n", shown_of(target).string(),
               counted(progress.step, std::string(units.step), std::string(units.steps)), work, units.works,
               progress.work_seconds);
  }
  std::fflush(stdout);
  if (!finished || options.pictures_at.empty() || options.pictures_at.back() <= progress.work_seconds) return;
  const auto beyond = std::upper_bound(options.pictures_at.begin(), options.pictures_at.end(), progress.work_seconds);
  fmt::print(stderr, "note: {}: the run ended after {:.1f} s of work: no picture at {} s\n", target.label,
             progress.work_seconds, fmt::join(beyond, options.pictures_at.end(), ", "));
}

std::function<compute::Context()> device_opener(compute::DeviceOptions device) {
  return [device = std::move(device)] {
    if (const std::string note = compute::prepare_kernel_cache(); !note.empty()) fmt::print(stderr, "note: {}\n", note);
    return compute::Context::open(device);
  };
}

void render(const RunOptions& options, const Target& target, const std::stop_token& interrupted, RunSeries& series) {
  run::ReadyRun& run = series.run;
  make_ready(options, target, interrupted, series);
  Console console(options, target, run);
  if (!Communicator(series.ranks).is_root()) return run::drive(run, console, {});
  if (is_frame(target)) run::hide_frame(target.animation, target.preset.provenance.frame.value());
  say_beginning(options, target, run);
  if (interrupted.stop_requested())
    throw Error(ErrorKind::interrupted, target.folder.string(), "interrupted before rendering began");
  run::drive(run, console, interrupted);
  if (is_frame(target) && console.is_finished())
    run::show_frame(target.animation, target.preset.provenance.frame.value());
  say_end(options, target, *run.job, console);
  if (!is_frame(target) || series.ranks) run.job.reset(); // frees its memory for the next run, and the other ranks
  run.claimed.reset();
}

} // namespace nephroid::cli
