// SPDX-License-Identifier: Apache-2.0
#include "cli/run_target.h"

#include "base/counted.h"
#include "base/error.h"
#include "base/files.h"
#include "base/json_output.h"
#include "cli/progress.h"
#include "engine/engine.h"
#include "job/distributed_job.h"
#include "run/run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace nephroid::cli {
namespace fs = std::filesystem;
namespace {

/// Beside the engine's own.
constexpr const char* result_files[] = {"preset.json", "plan.json",     "run.json",      "history.csv",
                                        "report.html", "pictures.json", "checkpoint.bin"};

/// What is shown to people: the picture, or the folder where there is none yet.
fs::path shown_of(const Target& target)
{
  const fs::path picture =
      target.animation.empty() ? target.folder / "image.png" : run::frame_picture(target.animation, target.preset.provenance.frame.value());
  return fs::exists(picture) ? picture : target.folder;
}

/// "10.1 s of work: bake 9.8 s, render 0.3 s".
std::string where_time_went(const job::Snapshot& snapshot)
{
  std::string phases;
  for (const auto& [name, seconds] : snapshot.phases)
    if (seconds >= 0.05) phases += fmt::format("{} {} {:.1f} s", phases.empty() ? ":" : ",", name, seconds);
  return fmt::format("{:.1f} s of work{}", snapshot.progress.work_seconds, phases);
}

void require_same(mpi::Ranks& ranks, const run::Prepared& prepared, const compute::Context& context)
{
  for (const auto& [what, mine] : run::bit_dependencies(prepared, context)) mpi::require_same(ranks, what, mine);
}

/// Renders one target on a device that is open for all of them.
class Run {
public:
  Run(const RunOptions& options, const Target& target, const std::stop_token& interrupted)
      : options_(options), target_(target), interrupted_(interrupted)
  {
  }

  void operator()(Shared& shared)
  {
    const Watch watch{interrupted_, [this](const std::string& doing) {
                        if (progress_style(options_.json) == ProgressStyle::live) activity_.show(target_.label + "  " + doing);
                      }};
    const Communicator communicator(shared.ranks);
    const bool is_root = communicator.is_root();
    shared.prepared = run::prepare(target_.preset, shared.prepared ? &*shared.prepared : nullptr, watch);
    activity_.clear();
    const run::Prepared& prepared = *shared.prepared;
    for (const std::string& note : prepared.plan->notes)
      if (is_root && (!is_frame() || shared.notes.insert(note).second)) fmt::print(stderr, "note: {}\n", note);
    const compute::Context& context = device_of(options_, shared);
    if (shared.ranks) require_same(*shared.ranks, prepared, context);
    std::unique_ptr<job::Job> job = taken_on(shared);
    if (!job) require_memory(prepared, context, shared.ranks); // a run that cannot be leaves no folder
    if (!is_root) return follow(prepared, context, communicator);
    std::optional<compute::TellOfCompiling> telling(std::in_place, context, [watch] { watch.begin("compiling kernels"); });
    const run::ClaimedFolder claimed(target_.folder);
    if (is_frame()) run::hide_frame(target_.animation, target_.preset.provenance.frame.value());
    reference_ = reference(prepared, context);
    if (!job) {
      job = run::make_job(prepared, {context, communicator});
      if (!communicator.is_alone()) job = job::distributed(std::move(job), communicator);
      job = measure::measured(std::move(job), prepared.preset, reference_, began_, options_.pictures_at);
      shared.of_job = target_.preset;
      shared.inputs_of_job = prepared.plan->inputs;
    }
    activity_.clear();
    telling.reset();
    stop_if_interrupted_early();
    begin_or_resume(prepared, context, *job);
    stop_if_interrupted_early();
    work(prepared, context, *job);
    save(prepared, context, *job);
    if (is_frame()) shared.job = std::move(job);
  }

private:
  /// All that the other ranks do of a run.
  static void follow(const run::Prepared& prepared, const compute::Context& context, const Communicator& communicator)
  {
    const std::unique_ptr<job::Job> job = run::make_job(prepared, {context, communicator});
    job::follow_root(*job, communicator);
  }

  bool is_frame() const { return !target_.animation.empty(); }

  /// The job of the frame before, where it can be this one's; else it is gone, with its memory.
  std::unique_ptr<job::Job> taken_on(Shared& shared) const
  {
    std::unique_ptr<job::Job> before = std::move(shared.job);
    if (!before || target_.preset.reference) return nullptr; // a reference is of one frame
    if (!run::changed_input(shared.inputs_of_job, shared.prepared->plan->inputs).empty()) return nullptr;
    preset::Preset now = target_.preset;
    now.name = shared.of_job.name; // the name is a frame's, and changes nothing
    if (!engine::adoptable(shared.of_job, now) || !before->adopt(now)) return nullptr;
    shared.of_job = std::move(now);
    const job::Progress progress = before->progress();
    if (progress.step != 0 || progress.work != 0 || progress.work_seconds != 0) return nullptr;
    return before;
  }

  void stop_if_interrupted_early() const
  {
    if (interrupted_.stop_requested()) throw Error(ErrorKind::interrupted, target_.folder.string(), "interrupted before rendering began");
  }

  /// A frame whose preset has changed starts anew: the other frames may be as they were.
  bool load_checkpoint(const run::Prepared& prepared, const compute::Context& context, job::Job& job) const
  {
    try {
      return run::load_checkpoint(target_.folder, prepared, context, job);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::bad_input) throw;
      if (!is_frame()) throw error.noting("run without --resume to start over");
      fmt::print(stderr, "note: {}; the frame starts anew\n", error.line());
      return false;
    }
  }

  void begin_or_resume(const run::Prepared& prepared, const compute::Context& context, job::Job& job) const
  {
    if (options_.resume && load_checkpoint(prepared, context, job)) {
      const job::Progress progress = job.progress();
      fmt::print(stderr, "{}: going on in {} {} ({:.1f} s of work so far)\n", target_.label, progress.units.step, progress.step + 1,
                 progress.work_seconds);
      run::write_settings(target_.folder, prepared);
      run::remove_pictures_after(target_.folder, progress.work_seconds);
      return;
    }
    if (options_.resume && !is_frame())
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
      job.advance();
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
        const job::Snapshot snapshot = job.snapshot();
        display.clear();
        if (snapshot.stands_in)
          fmt::print(stderr, "note: {}: no picture at {} s: the first one is not there yet\n", target_.label, times[next_picture_]);
        else
          say_picture(run::write_picture_at(target_.folder, times[next_picture_], prepared, device, snapshot),
                      history ? history->error_column : "");
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
    job::Snapshot snapshot = job.snapshot();
    const bool finished = job.finished() && !snapshot.stands_in;
    run::write_run(target_.folder, prepared, context.device(), snapshot, reference_.get(), finished);
    snapshot.picture.reset(); // the report reads the files
    if (!is_frame() || !finished)
      run::write_checkpoint(target_.folder, prepared, context, job);
    else { // a film for each frame would fill the disk, and so would a page
      fs::remove(target_.folder / "checkpoint.bin");
      run::show_frame(target_.animation, target_.preset.provenance.frame.value());
    }
    if (finished && snapshot.history && !is_frame()) write_report();
    report_result(options_, target_, snapshot.progress, finished);
    for (const std::string& warning : snapshot.warnings) fmt::print(stderr, "note: {}: {}\n", target_.label, warning);
    if (job.finished() && snapshot.stands_in)
      throw failed(target_.folder.string(), "the run ended before its first picture, after " + where_time_went(snapshot),
                   "a checkpoint is saved", "go on with --resume and a longer time: --seconds 60");
    if (!finished)
      throw Error(ErrorKind::interrupted, target_.folder.string(),
                  fmt::format("interrupted in {} {}", snapshot.progress.units.step, snapshot.progress.step + 1),
                  snapshot.stands_in ? "a checkpoint is saved" : "the image and a checkpoint are saved", "go on with --resume");
    if (snapshot.progress.step == 0)
      fmt::print(stderr, "note: {}: the run ended before its first {} was whole, after {}\n", target_.label, snapshot.progress.units.step,
                 where_time_went(snapshot));
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
  LiveLine activity_; ///< while there are no figures yet
  std::shared_ptr<const measure::Reference> reference_;
  std::size_t rows_written_ = 0; ///< of the history
  std::size_t next_picture_ = 0; ///< of RunOptions::pictures_at
  bool warned_ = false;
};

} // namespace

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
    const std::string work = progress.work < 100'000 ? fmt::format("{}", progress.work)
                                                     : fmt::format("{:.1f} million", static_cast<double>(progress.work) * 1e-6);
    fmt::print("{}: {}, {} {} in {:.1f} s of work\n", shown_of(target).string(),
               counted(progress.step, std::string(units.step), std::string(units.steps)), work, units.works, progress.work_seconds);
  }
  std::fflush(stdout);
  if (!finished || options.pictures_at.empty() || options.pictures_at.back() <= progress.work_seconds) return;
  const auto beyond = std::upper_bound(options.pictures_at.begin(), options.pictures_at.end(), progress.work_seconds);
  fmt::print(stderr, "note: {}: the run ended after {:.1f} s of work: no picture at {} s\n", target.label, progress.work_seconds,
             fmt::join(beyond, options.pictures_at.end(), ", "));
}

void require_memory(const run::Prepared& prepared, const compute::Context& context, const std::shared_ptr<mpi::Ranks>& ranks)
{
  if (!ranks) return run::require_memory(prepared, context);
  std::optional<Error> lack;
  try {
    run::require_memory(prepared, context);
  } catch (const Error& error) {
    lack = error;
  }
  mpi::require_all(*ranks, lack);
}

const compute::Context& device_of(const RunOptions& options, Shared& shared)
{
  if (!shared.context) {
    if (const std::string note = compute::prepare_kernel_cache(); !note.empty()) fmt::print(stderr, "note: {}\n", note);
    compute::DeviceOptions device = options.device;
    device.turn = shared.device_of_several;
    shared.context = compute::Context::open(device);
  }
  return *shared.context;
}

void require_same(const RunOptions& options, const preset::Preset& preset, const std::stop_token& interrupted, Shared& shared,
                  mpi::Ranks& ranks)
{
  shared.prepared = run::prepare(preset, shared.prepared ? &*shared.prepared : nullptr, {interrupted, {}});
  require_same(ranks, *shared.prepared, device_of(options, shared));
}

void require_shared(mpi::Ranks& ranks, const fs::path& file)
{
  ranks.wait_for_root();
  std::optional<Error> error;
  if (!is_there(file))
    error = bad_input(ranks.name(), fmt::format("does not see {}, which rank 0 has written", file.string()),
                      "expected an output folder that all nodes share", "choose another one with -o");
  mpi::require_all(ranks, error);
}

void render(const RunOptions& options, const Target& target, const std::stop_token& interrupted, Shared& shared)
{
  Run(options, target, interrupted)(shared);
}

} // namespace nephroid::cli
