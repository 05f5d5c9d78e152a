// SPDX-License-Identifier: Apache-2.0
// One run of `nephroid run`: a preset of its own, one of a sweep, or a frame of an animation.
#pragma once
#include "base/communicator.h"
#include "compute/compute.h"
#include "job/job.h"
#include "preset/preset.h"
#include "run/prepare.h"
#include "mpi/ranks.h"

#include <set>
#include <stop_token>

namespace nephroid::cli {

struct RunOptions {
  std::string preset;
  std::filesystem::path folder;
  std::vector<std::string> overrides;
  std::optional<double> seconds;
  std::optional<int> passes;
  std::optional<double> until_error;
  std::optional<std::uint64_t> seed;
  compute::DeviceOptions device;
  double checkpoint_seconds = 10;
  std::vector<double> pictures_at; ///< seconds of work, in order, each once
  std::string frames;              ///< which of an animation to render, "12" or "3-40"; empty: all
  bool resume = false, json = false;
};

struct Target {
  preset::Preset preset;
  std::filesystem::path folder;
  std::string label;               ///< what progress and notes call it
  std::filesystem::path animation; ///< of a frame: the folder of all frames
};

/// What the runs of one command share.
struct Shared {
  std::shared_ptr<mpi::Ranks> ranks; ///< that compute the run together; null: this process alone does
  int device_of_several = 0;          ///< of the devices that --device may mean, the one with this number, counted around
  /// Of the frame before. Where it takes the next frame's preset on (job::Job::adopt) and its progress then is at 0, it is as a new job of
  /// that preset, bit for bit, and keeps what does not change, such as a bake. A job that goes on with what it has would give other bits
  /// after a resume.
  std::unique_ptr<job::Job> job;
  preset::Preset of_job; ///< what it is of
  std::vector<plan::Input> inputs_of_job;

  std::optional<compute::Context> context; ///< the device, opened by the first run that needs it
  std::optional<run::Prepared> prepared;   ///< the run before: its scene may do for the next one
  std::optional<double> white;             ///< in place of "auto"
  std::set<std::string> notes;             ///< that were printed: frames are much alike
};

/// The device of this command: opens it at the first call.
const compute::Context& device_of(const RunOptions& options, Shared& shared);

/// Throws as run::require_memory. No rank goes on where one lacks it.
void require_memory(const run::Prepared& prepared, const compute::Context& context, const std::shared_ptr<mpi::Ranks>& ranks);

/// Throws bad_input on the ranks that would compute other bits of this preset than rank 0. Leaves it prepared.
void require_same(const RunOptions& options, const preset::Preset& preset, const std::stop_token& interrupted, Shared& shared,
                  mpi::Ranks& ranks);
/// The same where a rank does not see a file that rank 0 has written before.
void require_shared(mpi::Ranks& ranks, const std::filesystem::path& file);

/// Renders the target into its folder. Throws interrupted once its picture and a checkpoint are saved.
void render(const RunOptions& options, const Target& target, const std::stop_token& interrupted, Shared& shared);

/// Renders the frames that options.frames names into target.folder (run/animation.h), each as a run of its own, then the video. With
/// options.resume those that are finished are left as they are. Throws bad_input for a frame that there is not or that cannot be, before
/// any is rendered.
void render_animation(const RunOptions& options, const Target& target, const std::stop_token& interrupted, Shared& shared);

/// The last words about a run, on standard output: its picture, or with --json its files and figures.
void report_result(const RunOptions& options, const Target& target, const job::Progress& progress, bool finished);

} // namespace nephroid::cli
