// SPDX-License-Identifier: Apache-2.0
// `nephroid run`: renders a preset, or each run of a sweep, into a folder; can be interrupted, killed and resumed.
#include "run/run.h"
#include "base/counted.h"
#include "base/interrupts.h"
#include "base/json_output.h"
#include "cli/numbers.h"
#include "cli/progress.h"
#include "cli/verbs.h"
#include "compute/compute.h"
#include "measure/measured_job.h"
#include "preset/origins.h"
#include "preset/read.h"
#include "run/picture.h"
#include "run/reference.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <set>
#include <utility>

namespace nephroid::cli {
namespace fs = std::filesystem;
namespace {

/// Beside the engine's own.
constexpr const char* result_files[] = {"preset.json", "plan.json",     "run.json",      "history.csv",
                                        "report.html", "pictures.json", "checkpoint.bin"};

struct RunOptions {
  std::string preset;
  fs::path folder;
  std::vector<std::string> overrides;
  std::optional<double> seconds;
  std::optional<int> passes;
  std::optional<double> until_error;
  std::optional<std::uint64_t> seed;
  compute::DeviceOptions device;
  double checkpoint_seconds = 10;
  std::vector<double> pictures_at; ///< seconds of work, in order, each once
  bool resume = false, json = false;
};

struct Target {
  preset::Preset preset;
  fs::path folder;
  std::string label; ///< what progress and notes call it
};

/// The runs to do: one, or those of a sweep in numbered folders.
std::vector<Target> targets_of(const RunOptions& options)
{
  std::vector<preset::Preset> presets = preset::read_presets(options.preset, options.overrides);
  const std::string stem = fs::path(options.preset).stem().string();
  const fs::path folder = options.folder.empty() ? fs::path("out") / stem : options.folder;
  std::vector<Target> targets;
  for (preset::Preset& preset : presets) {
    if (options.seconds || options.passes || options.until_error) {
      preset.stop.seconds = options.seconds;
      preset.stop.passes = options.passes;
      preset.stop.error = options.until_error;
      preset::set_origin(preset, "/stop/error", "--until-error");
    }
    if (options.seed) {
      preset.seed = *options.seed;
      preset::check(preset, [](const std::string&) { return std::string("--seed"); }); // against the reference's
    }
    const std::string number = fmt::format("{:03}", targets.size() + 1);
    const bool sweep = presets.size() > 1;
    targets.push_back({std::move(preset), sweep ? folder / number : folder, sweep ? fmt::format("{}/{}", stem, number) : stem});
  }
  return targets;
}

/// The last words about one run, on standard output.
void report_result(const RunOptions& options, const Target& target, const job::Progress& progress, bool finished)
{
  std::vector<std::string> files = run::engine_files(target.folder);
  for (const char* name : result_files)
    if (fs::exists(target.folder / name)) files.emplace_back(name);
  for (const auto& made : run::pictures_at(target.folder)) {
    const fs::path picture = made["picture"].get<std::string>();
    files.insert(files.end(), {picture.string(), fs::path(picture).replace_extension(".exr").string()});
  }
  if (options.json) {
    const nlohmann::ordered_json all{{"type", "result"},
                                     {"name", target.preset.name},
                                     {"folder", target.folder.string()},
                                     {"files", files},
                                     {"finished", finished},
                                     {std::string(progress.units.steps), progress.step},
                                     {std::string(progress.units.works), progress.work},
                                     {"work_seconds", progress.work_seconds}};
    fmt::print("{}\n", json_text(all));
  } else {
    const job::Units& units = progress.units;
    fmt::print("{}: {}, {:.1f} million {} in {:.1f} s of work\n", (target.folder / "image.png").string(),
               counted(progress.step, std::string(units.step), std::string(units.steps)), static_cast<double>(progress.work) * 1e-6,
               units.works, progress.work_seconds);
  }
  std::fflush(stdout);
  if (!finished || options.pictures_at.empty() || options.pictures_at.back() <= progress.work_seconds) return;
  const auto beyond = std::upper_bound(options.pictures_at.begin(), options.pictures_at.end(), progress.work_seconds);
  fmt::print(stderr, "note: {}: the run ended after {:.1f} s of work: no picture at {} s\n", target.label, progress.work_seconds,
             fmt::join(beyond, options.pictures_at.end(), ", "));
}

/// Renders one target on a device that is open for all of them.
class Run {
public:
  Run(const RunOptions& options, const Target& target, const std::stop_token& interrupted)
      : options_(options), target_(target), interrupted_(interrupted)
  {
  }

  /// Opens the device at the first run that needs one.
  void operator()(std::optional<compute::Context>& context, std::optional<run::Prepared>& prepared)
  {
    prepared = run::prepare(target_.preset, prepared ? &*prepared : nullptr);
    for (const std::string& note : prepared->plan->notes) fmt::print(stderr, "note: {}\n", note);
    if (!context) {
      if (const std::string note = compute::prepare_kernel_cache(); !note.empty()) fmt::print(stderr, "note: {}\n", note);
      context = compute::Context::open(options_.device);
    }
    compute::tell_of_compiling(*context, [this] { activity_.show("compiling kernels"); });
    run::require_memory(*prepared, *context); // a run that cannot be leaves no folder
    run::claim_folder(target_.folder);
    try {
      reference_ = reference(*prepared, *context);
      const std::unique_ptr<job::Job> job =
          measure::measured(run::make_job(*prepared, *context), prepared->preset, reference_, began_, options_.pictures_at);
      activity_.clear();
      compute::tell_of_compiling(*context, [] {}); // the context outlives this
      stop_if_interrupted_early();
      begin_or_resume(*prepared, *context, *job);
      stop_if_interrupted_early();
      work(*prepared, *context, *job);
      save(*prepared, *context, *job);
    } catch (...) {
      run::release_folder(target_.folder);
      throw;
    }
  }

private:
  void stop_if_interrupted_early() const
  {
    if (interrupted_.stop_requested()) throw Error(ErrorKind::interrupted, target_.folder.string(), "interrupted before rendering began");
  }

  void begin_or_resume(const run::Prepared& prepared, const compute::Context& context, job::Job& job) const
  {
    if (options_.resume && run::load_checkpoint(target_.folder, prepared, context, job)) {
      const job::Progress progress = job.progress();
      fmt::print(stderr, "{}: going on in {} {} ({:.1f} s of work so far)\n", target_.label, progress.units.step, progress.step + 1,
                 progress.work_seconds);
      run::write_settings(target_.folder, prepared);
      run::remove_pictures_after(target_.folder, progress.work_seconds);
      return;
    }
    if (options_.resume)
      fmt::print(stderr, "{}: no checkpoint in {}, starting from the beginning\n", target_.label, target_.folder.string());
    run::begin_run(target_.folder, prepared);
  }

  /// The preset's reference, rendered now where it is a recipe that was not rendered before.
  std::shared_ptr<const measure::Reference> reference(const run::Prepared& prepared, const compute::Context& context) const
  {
    const auto& wanted = prepared.preset.reference;
    std::shared_ptr<const measure::Reference> found = run::find_reference(prepared, context);
    if (found || !wanted) return found;
    fmt::print(stderr, "{}: rendering the reference, 2 x {}; it is kept for later runs\n", target_.label,
               counted(wanted->passes, "pass", "passes"));
    job::Progress progress;
    progress.steps = 2 * static_cast<std::int64_t>(wanted->passes);
    ProgressDisplay display(progress_style(options_.json), {target_.label + " reference", target_.preset.name, "reference"}, progress);
    found = run::make_reference(prepared, context, interrupted_, [&](double fraction, double seconds) {
      progress.fraction = fraction;
      progress.step = static_cast<std::int64_t>(fraction * static_cast<double>(progress.steps));
      progress.work_seconds = seconds;
      display.update(progress);
    });
    display.finish(progress);
    return found;
  }

  void work(const run::Prepared& prepared, const compute::Context& context, job::Job& job)
  {
    skip_pictures(job.progress().work_seconds);
    ProgressDisplay display(progress_style(options_.json), {target_.label, target_.preset.name}, job.progress());
    double saved_at = job.progress().work_seconds;
    while (!job.finished() && !interrupted_.stop_requested()) {
      job.step();
      const job::Progress progress = job.progress();
      display.update(progress);
      note_history(job, display);
      if (!take_pictures(prepared, context.device(), job, display)) continue;
      if (progress.work_seconds - saved_at < options_.checkpoint_seconds) continue;
      saved_at = progress.work_seconds;
      on_disk(display, [&] { run::write_checkpoint(target_.folder, prepared, context, job); });
    }
    display.finish(job.progress());
  }

  /// A resumed run has those of the time before, or cannot have them any more.
  void skip_pictures(double work_seconds)
  {
    const auto& times = options_.pictures_at;
    std::set<double> made;
    for (const auto& picture : run::pictures_at(target_.folder)) made.insert(picture["seconds"].get<double>());
    for (; next_picture_ < times.size() && times[next_picture_] <= work_seconds; ++next_picture_)
      if (work_seconds > 0 && !made.contains(times[next_picture_]))
        fmt::print(stderr, "note: {}: {} s of work are past: no picture of then\n", target_.label, times[next_picture_]);
  }

  /// The pictures whose time has come, once their error is measured. False where that is the next step: a checkpoint in between would be of
  /// a run that never takes them.
  bool take_pictures(const run::Prepared& prepared, const compute::DeviceInfo& device, job::Job& job, ProgressDisplay& display)
  {
    const auto& times = options_.pictures_at;
    const double work_seconds = job.progress().work_seconds;
    for (; next_picture_ < times.size() && times[next_picture_] <= work_seconds; ++next_picture_) {
      const auto history = job.history();
      if (history && !history->rows.empty() && history->rows.back().seconds < times[next_picture_]) return false;
      on_disk(display, [&] {
        const auto made = run::write_picture_at(target_.folder, times[next_picture_], prepared, device, job.snapshot());
        display.clear();
        say_picture(made, history ? history->error_column : "");
      });
    }
    return true;
  }

  void say_picture(nlohmann::ordered_json made, const std::string& error_column) const
  {
    if (options_.json) {
      nlohmann::ordered_json line{{"type", "picture"}, {"name", target_.preset.name}};
      line.update(made);
      fmt::print("{}\n", json_text(line));
      std::fflush(stdout);
      return;
    }
    const auto error = made["errors"].find(error_column);
    const bool is_known = error != made["errors"].end() && error->is_number();
    fmt::print(stderr, "{}: {} after {:.1f} s of work{}\n", target_.label, (target_.folder / made["picture"].get<std::string>()).string(),
               made["work_seconds"].get<double>(), is_known ? fmt::format(", {} {:.3g}", error_column, error->get<double>()) : "");
  }

  void note_history(const job::Job& job, ProgressDisplay& display)
  {
    const auto history = job.history();
    if (!history || history->rows.size() == rows_written_) return;
    rows_written_ = history->rows.size();
    on_disk(display, [&] { run::write_history(target_.folder, *history); });
  }

  /// A disk that is full now may not be when the run ends: the work in hand is worth more than its checkpoint.
  template <class Write>
  void on_disk(ProgressDisplay& display, Write write)
  {
    try {
      write();
    } catch (const Error& error) {
      if (std::exchange(warned_, true)) return;
      display.clear();
      fmt::print(stderr, "warning: {}; going on without checkpoints\n", error.line());
    }
  }

  /// The picture first: where the disk has room for one of the two only, it is what the run was for.
  void save(const run::Prepared& prepared, const compute::Context& context, job::Job& job) const
  {
    const bool finished = job.finished();
    job::Snapshot snapshot = job.snapshot();
    run::write_run(target_.folder, prepared, context.device(), snapshot, reference_.get(), finished);
    snapshot.picture.reset(); // the report reads the files
    run::write_checkpoint(target_.folder, prepared, context, job);
    if (finished && snapshot.history) write_report();
    report_result(options_, target_, snapshot.progress, finished);
    for (const std::string& warning : snapshot.warnings) fmt::print(stderr, "note: {}: {}\n", target_.label, warning);
    if (!finished)
      throw Error(ErrorKind::interrupted, target_.folder.string(),
                  fmt::format("interrupted in {} {}", snapshot.progress.units.step, snapshot.progress.step + 1),
                  "the image and a checkpoint are saved", "go on with --resume");
  }

  /// The picture is what the run was for: where a report cannot be made there is one file less.
  void write_report() const
  {
    try {
      run::write_report(target_.folder);
    } catch (const Error& error) {
      fmt::print(stderr, "warning: there is no report.html: {}\n", error.line());
    }
  }

  const RunOptions& options_;
  const Target& target_;
  std::stop_token interrupted_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  ActivityLine activity_{progress_style(options_.json), target_.label};
  std::shared_ptr<const measure::Reference> reference_;
  std::size_t rows_written_ = 0; ///< of the history
  std::size_t next_picture_ = 0; ///< of RunOptions::pictures_at
  bool warned_ = false;
};

/// Rounded to the milliseconds that their files' names have.
std::vector<double> in_order(const std::vector<double>& times)
{
  std::set<double> sorted;
  for (const double time : times) sorted.insert(std::round(time * 1000) / 1000);
  return {sorted.begin(), sorted.end()};
}

void run_preset(const RunOptions& options)
{
  const Interrupts interrupts; // before OpenCL starts its threads
  const std::vector<Target> targets = targets_of(options);
  std::optional<compute::Context> context;
  std::optional<run::Prepared> prepared;
  for (const Target& target : targets) {
    if (const auto done = options.resume ? run::finished_run(target.folder, target.preset) : std::nullopt) {
      fmt::print(stderr, "{}: this run is finished\n", target.label);
      report_result(options, target, *done, true);
      continue;
    }
    preset::at_origins(target.preset, [&] { Run(options, target, interrupts.token())(context, prepared); });
  }
}

} // namespace

void add_run(CLI::App& program, Session&)
{
  const auto options = std::make_shared<RunOptions>();
  CLI::App* verb = program.add_subcommand("run", "Render a preset into a folder");
  verb->footer(
      "Ctrl-C saves the image and a checkpoint; `--resume` goes on from there with the same result as an uninterrupted run.\n"
      "Files: image.exr (linear, with layers), image.png (as shown), preset.json (complete), plan.json, run.json, checkpoint.bin, and\n"
      "where the run measures its error history.csv and, once it is finished, report.html.");
  verb->add_option("PRESET", options->preset, "A preset file or the name of a shipped preset")->required();
  verb->add_option("-o,--output", options->folder, "Folder for the run's files (default out/NAME; a sweep's runs in 001, 002, ...)")
      ->type_name("DIR");
  verb->add_option("--set", options->overrides, "Change a setting: scene.lights.0.power_w=2; may be repeated")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all();
  verb->add_option("--seconds", options->seconds, "Stop after this much work, instead of where the preset says")
      ->type_name("S")
      ->transform(number_from_to(0.001, 1e9));
  verb->add_option("--passes", options->passes, "Stop after this many passes, instead of where the preset says")
      ->type_name("N")
      ->transform(number_from_to(1, preset::max_passes));
  verb->add_option("--until-error", options->until_error,
                   "Stop at this error (of stop.metric, CIELAB's mean distance unless set), instead of where the preset says")
      ->type_name("E")
      ->transform(number_from_to(1e-9, 1e9));
  verb->add_option("--seed", options->seed, "Of the random numbers, instead of the preset's")->type_name("N")->transform(any_seed());
  verb->add_option("--device", options->device.selector, "An index or part of a name (see nephroid devices)")->type_name("SEL");
  verb->add_option("--kernels", options->device.kernels, "Load kernels from this folder instead of the built-in ones")->type_name("DIR");
  verb->add_option("--checkpoint-seconds", options->checkpoint_seconds, "Work between checkpoints (default 10)")
      ->type_name("S")
      ->transform(number_from_to(0.0, 1e9));
  verb->add_option_function<std::vector<double>>(
          "--pictures-at", [options](const std::vector<double>& times) { options->pictures_at = in_order(times); },
          "Also write the picture after this much work, with its error: 2,10,60 gives at-0002s.png and .exr, at-0010s.png, ...")
      ->type_name("S,S,...")
      ->delimiter(',')
      ->expected(1)
      ->take_all()
      ->transform(number_from_to(0.001, 1e9));
  verb->add_flag("--resume", options->resume, "Go on from the folder's checkpoint");
  verb->add_flag("--json", options->json, "Progress and result as JSON lines on standard output");
  verb->callback([options] { run_preset(*options); });
}

} // namespace nephroid::cli
