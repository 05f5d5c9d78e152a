// SPDX-License-Identifier: Apache-2.0
#include "run/ready.h"

#include "engine/engine.h"
#include "job/distributed_job.h"
#include "run/afterimage.h"
#include "run/checkpoint.h"
#include "run/content.h"
#include "run/exposure.h"
#include "run/memory.h"
#include "run/metered_job.h"
#include "run/reference.h"
#include "run/write_run.h"

#include <fmt/format.h>

namespace nephroid::run {
namespace {

/// The job of the run before, where it can be the next one's; else it is gone, with its memory.
std::unique_ptr<job::Job> taken_over(ReadyRun& run, const Prepared& next, const ReadyOptions& options) {
  std::unique_ptr<job::Job> job = std::move(run.job);
  if (!job || next.preset.reference) return nullptr; // a reference is of one preset
  if (!changed_input(run.prepared->plan->inputs, next.plan->inputs).empty()) return nullptr;
  preset::Preset before = run.prepared->preset, now = next.preset;
  before.name = now.name = run.name_in_job; // names change nothing
  // What a job moves is where a scene that is loaded has it but for rounding, and a film has the same bits resumed.
  if (options.is_frame && before.scene.objects != now.scene.objects) return nullptr;
  if (!engine::adoptable(before, now) || !job->adopt(now)) return nullptr;
  const job::Progress progress = job->progress();
  if (progress.step != 0 || progress.work != 0 || progress.work_seconds != 0) return nullptr;
  return job;
}

std::shared_ptr<const measure::Reference> reference_of(const Prepared& prepared, const compute::Context& context,
                                                       const ReadyOptions& options) {
  if (options.reference) return options.reference(prepared, context);
  if (auto reference = find_reference(prepared, context); reference || !prepared.preset.reference) return reference;
  options.watch.begin("rendering the reference");
  return make_reference(prepared, context, options.watch.stop, [](double, double) {});
}

void begin_frame(ReadyRun& run, const ReadyOptions& options) {
  const Prepared& prepared = *run.prepared;
  if (!options.is_frame || !prepared.plan->mixes_frames) return;
  options.watch.begin("finding what the pixels show");
  run.seen =
      std::make_shared<const photons::SeenPlaces>(photons::seen_places(prepared.loaded->scene, *prepared.loaded->bvh));
  run.job->begin_with(beginning_of(prepared, *run.seen));
}

/// False where there is no checkpoint to go on from.
bool load(ReadyRun& run, const compute::Context& context, const ReadyOptions& options) {
  try {
    return options.resume && load_checkpoint(options.folder, *run.prepared, context, *run.job);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::bad_input || !options.bad_checkpoint) throw;
    options.bad_checkpoint(error);
    return false;
  }
}

void begin_or_resume(ReadyRun& run, const compute::Context& context, const ReadyOptions& options) {
  if (options.watch.stop.stop_requested())
    throw Error(ErrorKind::interrupted, options.folder.string(), "interrupted before rendering began");
  run.resumed = load(run, context, options);
  if (!run.resumed) return begin_run(options.folder, *run.prepared);
  write_settings(options.folder, *run.prepared);
  remove_pictures_after(options.folder, run.job->progress().work_seconds);
}

} // namespace

void make_ready(ReadyRun& run, preset::Preset preset, const ReadyOptions& options) {
  run.claimed.reset();
  run.ranks = options.ranks;
  if (!preset.white && options.resume) preset.white = white_of_run(options.folder);
  if (!preset.white) {
    run.job.reset();
    preset.white = fitted_white(preset, run.prepared, run.device, options.watch);
  }
  Prepared next = prepare(preset, run.prepared ? &*run.prepared : nullptr, options.watch,
                          options.frame_before.empty() ? nullptr : read_afterimage(options.frame_before));
  run.job = taken_over(run, next, options);
  const Prepared& prepared = run.prepared.emplace(std::move(next));
  run.seen.reset();
  if (options.planned) options.planned(prepared);
  const compute::Context& context = run.device.context(options.watch);
  if (options.ranks) require_same(*options.ranks, prepared, context);
  if (!run.job) require_memory(prepared, context, options.ranks);
  const Communicator communicator(options.ranks);
  if (!communicator.is_root()) {
    run.job = metered(make_job(prepared, {context, communicator}), prepared, {context, communicator}, nullptr);
    begin_frame(run, options);
    return;
  }
  const compute::TellOfCompiling telling(context, [&] { options.watch.begin("compiling kernels"); });
  if (!options.folder.empty()) run.claimed = std::make_unique<ClaimedFolder>(options.folder);
  run.reference = reference_of(prepared, context, options);
  if (!run.job) {
    options.watch.begin("setting up the run");
    const mpi::RankContext ranks(context, communicator);
    run.job = metered(make_job(prepared, ranks), prepared, ranks, options.meter_share);
    if (!communicator.is_alone()) run.job = job::distributed(std::move(run.job), communicator);
    run.job = measure::measured(std::move(run.job), preset, run.reference, options.began, options.measure_at);
    run.name_in_job = preset.name;
  }
  begin_frame(run, options);
  if (!options.folder.empty()) begin_or_resume(run, context, options);
}

void drive(const ReadyRun& run, job::Observer& observer, const std::stop_token& stop) {
  job::Job& job = *run.job;
  if (const Communicator communicator(run.ranks); !communicator.is_root()) return job::follow_root(job, communicator);
  observer.begun(job);
  while (!job.finished() && !stop.stop_requested()) {
    try {
      job.advance();
    } catch (const Error& error) {
      if (error.kind() == ErrorKind::bad_input && !run.ranks) observer.ended(job);
      throw;
    }
    observer.advanced(job);
  }
  observer.ended(job);
}

const Prepared& prepare_next(ReadyRun& run, const preset::Preset& preset, const Watch& watch) {
  return run.prepared.emplace(prepare(preset, run.prepared ? &*run.prepared : nullptr, watch));
}

void require_memory(const Prepared& prepared, const compute::Context& context,
                    const std::shared_ptr<mpi::Ranks>& ranks) {
  if (!ranks) return require_memory(prepared, context);
  std::optional<Error> lack;
  try {
    require_memory(prepared, context);
  } catch (const Error& error) {
    lack = error;
  }
  mpi::require_all(*ranks, lack);
}

void require_shared(mpi::Ranks& ranks, const std::filesystem::path& file) {
  ranks.wait_for_root();
  std::optional<Error> error;
  if (!is_there(file))
    error = bad_input(ranks.name(), fmt::format("does not see {}, which rank 0 has written", file.string()),
                      "expected an output folder that all nodes share", "choose another one with -o");
  mpi::require_all(ranks, error);
}

void require_same(mpi::Ranks& ranks, const Prepared& prepared, const compute::Context& context) {
  for (const auto& [what, own] : bit_dependencies(prepared, context)) mpi::require_same(ranks, what, own);
}

} // namespace nephroid::run
