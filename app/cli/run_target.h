// SPDX-License-Identifier: Apache-2.0
// One run of `nephroid run`: a preset of its own, one of a sweep, or a frame of an animation.
#pragma once
#include "compute/compute.h"
#include "job/job.h"
#include "mpi/ranks.h"
#include "preset/preset.h"
#include "run/ready.h"

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

/// What goes from one run of a command to the next.
struct RunSeries {
  std::shared_ptr<mpi::Ranks> ranks; ///< that compute each run together; null: this process alone does
  run::ReadyRun run;                 ///< the newest one: lends its device, its scene and, of a frame, its job
  std::optional<double> white = {};  ///< in place of "auto"
  std::set<std::string> notes = {};  ///< that were printed: frames are much alike
};

/// Opens the device, and says so where compiled kernels cannot be kept.
std::function<compute::Context()> device_opener(compute::DeviceOptions device);

/// Throws bad_input on a rank that does not see a file that rank 0 has written before.
void require_shared(mpi::Ranks& ranks, const std::filesystem::path& file);

/// Renders the target into its folder. Throws interrupted once its picture and a checkpoint are saved.
void render(const RunOptions& options, const Target& target, const std::stop_token& interrupted, RunSeries& series);

/// Renders the frames that options.frames names into target.folder (run/animation.h), each as a run of its own, then
/// the video. With options.resume those that are finished are left as they are. Throws bad_input for a frame that there
/// is not or that cannot be, before any is rendered.
void render_animation(const RunOptions& options, const Target& target, const std::stop_token& interrupted,
                      RunSeries& series);

/// The last words about a run, on standard output: its picture, or with --json its files and figures.
void report_result(const RunOptions& options, const Target& target, const job::Progress& progress, bool finished);

} // namespace nephroid::cli
