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
  std::vector<double> pictures_at; ///< seconds of work, rising, each once
  std::string frames;              ///< frames to render, "12" or "3-40"; empty: all
  bool resume = false, json = false;
};

struct Target {
  preset::Preset preset;
  std::filesystem::path folder;
  std::string label;                       ///< the name in progress and notes
  std::filesystem::path animation;         ///< a frame's folder of all frames; else empty
  std::filesystem::path frame_before = {}; ///< as run::ReadyOptions has it
};

/// What a command keeps from one run to the next.
struct RunSeries {
  std::shared_ptr<mpi::Ranks> ranks; ///< the ranks that compute each run together; null: this process alone
  run::ReadyRun run;                ///< the newest run, whose device and scene, and for a frame its job, are used again
  preset::Preset first = {};        ///< whose picture gives white its number
  std::optional<double> white = {}; ///< replaces "auto"
  std::set<std::string> notes = {}; ///< notes already printed: frames give much the same ones
};

/// Opens the device, and prints a note if compiled kernels cannot be kept.
std::function<compute::Context()> device_opener(compute::DeviceOptions device);

/// Renders the target into its folder. Throws interrupted after its picture and a checkpoint are saved.
void render(const RunOptions& options, const Target& target, const std::stop_token& interrupted, RunSeries& series);

/// Renders the frames that options.frames names (run/animation.h), each as its own run, then the video. With
/// options.resume, finished frames stay. Throws bad_input before the first frame if one cannot be rendered.
void render_animation(const RunOptions& options, const Target& target, const std::stop_token& interrupted,
                      RunSeries& series);

/// Prints a run's result on standard output: its picture, or with --json its files and figures.
void report_result(const RunOptions& options, const Target& target, const job::Progress& progress, bool finished);

} // namespace nephroid::cli
