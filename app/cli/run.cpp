// SPDX-License-Identifier: Apache-2.0
// `nephroid run`: renders a preset, or each run of a sweep, into a folder; can be interrupted, killed and resumed.
#include "base/files.h"
#include "base/hashed_bytes.h"
#include "base/interrupts.h"
#include "cli/run_target.h"
#include "cli/verb.h"
#include "mpi/ranks.h"
#include "preset/origins.h"
#include "preset/read.h"
#include "preset/settings_type.h"
#include "report/report.h"
#include "run/exposure.h"
#include "run/folder.h"
#include "run/night.h"
#include "run/prepare.h"
#include "run/write_run.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

namespace nephroid::cli {
namespace fs = std::filesystem;
namespace {

/// A file's name has at most 255 bytes, and a folder may get a longer name beside it.
std::string run_folder(const std::string& varies, std::size_t number) {
  constexpr std::size_t most = 200;
  return varies.size() <= most ? varies : fmt::format("{}..,{:03}", varies.substr(0, most), number);
}

/// Writes the sweep's order for the report, because by name 10 comes before 2. Does nothing before a run has made the
/// folder.
void write_order(const std::vector<Target>& targets) {
  const fs::path folder = targets.front().folder.parent_path();
  if (targets.size() == 1 || !is_there(folder)) return;
  nlohmann::ordered_json order{{"runs", nlohmann::ordered_json::array()}};
  for (const Target& target : targets) order["runs"].push_back(target.folder.filename().string());
  write_file_whole(folder / report::sweep_file, order.dump(2) + "\n");
}

/// The runs to do: one, or those of a sweep, each in a folder named after what varies.
std::vector<Target> targets_of(const RunOptions& options) {
  std::vector<preset::Preset> presets = preset::read_presets(options.preset, options.overrides);
  const std::string stem = preset::stem_of(options.preset);
  const fs::path folder = options.folder.empty() ? fs::path("out") / stem : options.folder;
  std::vector<Target> targets;
  for (preset::Preset& preset : presets) {
    if (options.seconds || options.passes || options.until_error) {
      preset.stop.seconds = options.seconds;
      preset.stop.passes = options.passes;
      preset.stop.error = options.until_error;
      preset::set_origin(preset, "/stop/error", "--until-error");
      preset::check(preset, [&](const std::string& pointer) { return preset.provenance.origins->where(pointer); });
    }
    if (options.seed) {
      preset.seed = *options.seed;
      preset::check(preset, [](const std::string&) {
        return std::string("--seed");
      }); // the seed may not be one of the reference's
    }
    if (presets.size() == 1)
      targets.push_back({std::move(preset), folder, stem, {}});
    else {
      const std::string name = run_folder(preset.provenance.varies, targets.size() + 1);
      targets.push_back({std::move(preset), folder / name, fmt::format("{}/{}", stem, name), {}});
    }
  }
  return targets;
}

/// Sorts the times and rounds them to milliseconds, as in the files' names.
void put_in_order(std::vector<double>& times) {
  std::set<double> sorted;
  for (const double time : times) sorted.insert(std::round(time * 1000) / 1000);
  times.assign(sorted.begin(), sorted.end());
}

/// Replaces a white of "auto" by the root's number. The runs of a sweep and the frames of an animation use that of the
/// first by day, so that their pictures can be compared; a resumed run keeps its own.
void fit_white(const RunOptions& options, Target& target, const std::stop_token& interrupted, RunSeries& series,
               const Communicator& communicator) {
  if (target.preset.white) return;
  if (communicator.is_root()) {
    if (const auto own = options.resume ? run::white_of_run(target.folder) : std::nullopt) series.white = own;
    if (!series.white) {
      series.white = preset::at_origins(series.first, [&] {
        return run::fitted_white(series.first, series.run.prepared, series.run.device, {interrupted, {}});
      });
      if (preset::has_white(target.preset))
        fmt::print(stderr, "note: {}: white {} fits the first picture\n", target.label, *series.white);
    }
  }
  target.preset.white = communicator.broadcast(series.white);
}

void run_one(const RunOptions& options, Target& target, const std::stop_token& interrupted, RunSeries& series) {
  const Communicator communicator(series.ranks);
  fit_white(options, target, interrupted, series, communicator);
  if (target.preset.animation) return render_animation(options, target, interrupted, series);
  if (!options.frames.empty())
    throw bad_input("--frames", "the preset has no animation", "expected one with the section 'animation'");
  const auto done =
      options.resume && communicator.is_root() ? run::finished_run(target.folder, target.preset) : std::nullopt;
  if (done && !done->changed.empty())
    throw bad_input(target.folder, "this run is finished, but " + done->changed, {},
                    "run without --resume to start over");
  if (communicator.broadcast(done.has_value())) {
    if (!done) return; // the root reports it
    if (done->is_shown_otherwise) run::show_anew(target.folder, target.preset);
    fmt::print(stderr, "{}: this run is finished\n", target.label);
    return report_result(options, target, done->progress, true);
  }
  preset::at_origins(target.preset, [&] { render(options, target, interrupted, series); });
}

/// Says before any work which frames of films, and how many of a sweep's runs, are dark.
void say_nights(const std::vector<Target>& targets) {
  std::vector<std::string> dark;
  for (const Target& target : targets) {
    const std::string note = run::night_note(target.preset);
    if (target.preset.animation && !note.empty()) fmt::print(stderr, "note: {}\n", note);
    if (!target.preset.animation && !note.empty()) dark.push_back(target.label);
  }
  if (targets.size() > 1 && !dark.empty())
    fmt::print(stderr, "note: in {} of {} runs the sun is below the horizon, and the sky is dark: first in {}\n",
               dark.size(), targets.size(), dark.front());
}

void run_all(const RunOptions& options, std::vector<Target>& targets, const std::stop_token& interrupted,
             RunSeries& series) {
  for (Target& target : targets) {
    if (&target != &targets.front()) write_order(targets);
    run_one(options, target, interrupted, series);
  }
}

/// Throws bad_input on ranks whose runs differ from the root's, before any run begins.
void require_same_runs(const RunOptions& options, const std::vector<Target>& targets, mpi::Ranks& ranks) {
  std::string names, presets;
  for (const Target& target : targets) {
    names += (names.empty() ? "" : " ") + target.label;
    presets += preset::to_json(target.preset);
  }
  constexpr std::size_t a_line = 200;
  mpi::require_same(ranks, "list of runs",
                    names.size() <= a_line ? names
                                           : fmt::format("{} of them, {:016x}", targets.size(), hash_of(names)));
  mpi::require_same(ranks, "list of frames", options.frames.empty() ? "all" : options.frames);
  mpi::require_same(ranks, "preset", fmt::format("{:016x}", hash_of(presets)));
}

/// Each rank takes the sweep's next run, alone, when it is free.
void distribute_runs(const RunOptions& options, std::vector<Target>& targets, const std::stop_token& interrupted,
                     RunSeries& series, const std::shared_ptr<mpi::Ranks>& ranks) {
  const Communicator communicator(ranks);
  for (Target& target : targets) fit_white(options, target, interrupted, series, communicator);
  run::ReadyRun& run = series.run;
  run::require_same(*ranks, run::prepare_next(run, targets.front().preset, {interrupted, {}}), run.device.context());
  const fs::path folder = targets.front().folder.parent_path();
  if (communicator.is_root()) {
    fs::create_directories(folder);
    write_order(targets);
  }
  run::require_shared(*ranks, folder / report::sweep_file);
  ranks->distribute(static_cast<std::int64_t>(targets.size()), [&](std::int64_t number) {
    run_one(options, targets[static_cast<std::size_t>(number)], interrupted, series);
  });
}

void run_preset(const RunOptions& options, const std::stop_token& interrupted,
                const std::shared_ptr<mpi::Ranks>& ranks) {
  std::vector<Target> targets = targets_of(options);
  compute::DeviceOptions device = options.device;
  if (ranks)
    device.turn = ranks->number_on_host(); // ranks of one machine take the devices that --device may mean in turn
  RunSeries series{.ranks = nullptr, .run = run::ReadyRun(device_opener(std::move(device)))};
  if (!ranks || ranks->rank() == 0) say_nights(targets);
  const auto by_day = std::ranges::find_if(targets, [](const Target& t) { return !run::is_night(t.preset); });
  series.first = (by_day == targets.end() ? targets.front() : *by_day).preset;
  if (!ranks) return run_all(options, targets, interrupted, series);
  require_same_runs(options, targets, *ranks);
  if (targets.size() > 1) return distribute_runs(options, targets, interrupted, series, ranks);
  series.ranks = ranks;
  run_one(options, targets.front(), interrupted, series);
}

/// If one rank fails, all end. The root reports what is wrong with the command for all of them.
void run_on_ranks(const RunOptions& options, const std::stop_token& interrupted,
                  const std::shared_ptr<mpi::Ranks>& ranks) {
  try {
    run_preset(options, interrupted, ranks);
    ranks->wait_for_root(); // the root may still write files
  } catch (const Error& error) {
    const bool is_root = ranks->rank() == 0;
    if (!is_root) std::this_thread::sleep_for(std::chrono::seconds(1));
    fmt::print(stderr, "nephroid: {}{}\n",
               is_root || error.location() == Location(ranks->name()) ? "" : ranks->name() + ": ", error.line());
    ranks->abort(error.exit_code());
  }
}

} // namespace

void add_run(CLI::App& program, Session&) {
  const auto options = std::make_shared<RunOptions>();
  Verb verb(program, "run", "Render a preset into a folder",
            {{"nephroid run first-light --passes 8 -o out/quick", "a first look, in seconds"},
             {"nephroid run first-light -o out/daylight --set scene.lights.0.spectrum=D65", "the same in daylight"}},
            "Ctrl-C saves the image and a checkpoint; `--resume` goes on from there with the same result as an "
            "uninterrupted run.\n"
            "Files: image.exr (linear, with layers), image.png (as shown), preset.json (complete), plan.json, "
            "run.json, checkpoint.bin, and\n"
            "where the run measures its error history.csv and, once it is finished, report.html.\n"
            "An animation gives frame_0000.png and frame_0000.exr, ..., the other files of each frame in frames/0000, "
            "..., figures of all in\n"
            "frames.csv, and animation.mp4 where ffmpeg is installed.");
  verb.option("PRESET", options->preset, {.says = "A preset file or the name of a shipped preset", .required = true});
  verb.option("-o,--output", options->folder,
              {.type = "DIR",
               .says = "Folder for the run's files (default out/NAME; a sweep's runs each in one of its own inside: "
                       "seed=1, seed=2, ...)"});
  verb.overrides(options->overrides);
  verb.option(
      "--seconds", options->seconds,
      {.type = "S", .says = "Stop after this much work, instead of where the preset says", .from = 0.001, .to = 1e9});
  verb.option("--passes", options->passes,
              {.type = "N",
               .says = "Stop after this many passes, instead of where the preset says",
               .from = 1,
               .to = preset::max_passes});
  verb.option(
      "--until-error", options->until_error,
      {.type = "E",
       .says =
           "Stop at this error (of stop.metric, CIELAB's mean distance unless set), instead of where the preset says",
       .from = 1e-9,
       .to = 1e9});
  verb.option("--seed", options->seed,
              {.type = "N", .says = "Of the random numbers, instead of the preset's", .from = 0});
  verb.device(options->device.selector, options->device.kernels);
  verb.option("--checkpoint-seconds", options->checkpoint_seconds,
              {.type = "S", .says = "Work between checkpoints (default 10)", .from = 0.0, .to = 1e9});
  verb.option("--pictures-at", options->pictures_at,
              {.type = "S,S,...",
               .says = "Also write the picture after this much work, with its error: 2,10,60 gives at-0002s.png and "
                       ".exr, at-0010s.png, ...",
               .separator = ',',
               .from = 0.001,
               .to = 1e9});
  verb.option("--frames", options->frames,
              {.type = "N or N-M", .says = "Of an animation only these frames: 12, or 3-40"});
  verb.flag("--resume", options->resume,
            "Go on from the folder's checkpoint; of an animation, at the first frame that is missing");
  verb.flag("--json", options->json, "Progress and result as JSON lines on standard output");
  verb.work([options] {
    put_in_order(options->pictures_at);
    const Interrupts interrupts; // before OpenCL starts its threads
    if (const std::shared_ptr<mpi::Ranks> ranks = mpi::open_ranks())
      run_on_ranks(*options, interrupts.token(), ranks);
    else
      run_preset(*options, interrupts.token(), nullptr);
  });
}

} // namespace nephroid::cli
