// SPDX-License-Identifier: Apache-2.0
#include "base/counted.h"
#include "base/json_output.h"
#include "base/numbers.h"
#include "cli/run_target.h"
#include "cli/verb.h"
#include "preset/animation.h"
#include "preset/origins.h"
#include "preset/read.h"
#include "run/afterimage.h"
#include "run/animation.h"
#include "run/folder.h"
#include "run/prepare.h"
#include "run/write_run.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

namespace nephroid::cli {
namespace {

/// The first and the last frame to render.
std::pair<int, int> frames_of(const std::string& text, int frames) {
  if (text.empty()) return {0, frames - 1};
  const std::size_t dash = text.find('-');
  const std::string_view all = text;
  const auto first = typed_number<int>(all.substr(0, dash)),
             last = dash == std::string::npos ? first : typed_number<int>(all.substr(dash + 1));
  if (!first || !last || *first < 0 || *last < *first)
    throw bad_input("--frames " + text, "names no frames",
                    "expected one, such as 12, or the first and the last, such as 3-40");
  if (*last >= frames)
    throw bad_input("--frames " + text, fmt::format("the animation has no frame {}", *last),
                    fmt::format("its frames are 0 to {}", frames - 1));
  return {*first, *last};
}

class Frames {
public:
  Frames(const RunOptions& options, const Target& target, const std::stop_token& interrupted, RunSeries& series)
      : options_(options), target_(target), interrupted_(interrupted), series_(series),
        animation_(target.preset.animation.value()), ranks_(std::exchange(series.ranks, nullptr)),
        range_(frames_of(options.frames, animation_.frames)) {}

  void operator()() {
    for (int frame = range_.first; frame <= range_.second; ++frame)
      preset::at_frame(target_.preset, frame); // throws at once for a frame that cannot be
    begin();
    if (ranks_) require_shared(*ranks_, target_.folder / "preset.json");
    if (ranks_ && !mixes_frames_)
      distribute_frames();
    else
      render_in_order();
    if (is_root()) end();
  }

private:
  bool is_root() const { return !ranks_ || ranks_->rank() == 0; }

  /// Each rank renders the next frame, alone, when it is free.
  void distribute_frames() {
    ranks_->distribute(range_.second - range_.first + 1,
                       [&](std::int64_t number) { render_one(range_.first + static_cast<int>(number)); });
    std::int64_t rendered = rendered_;
    ranks_->all_reduce_sum({&rendered, 1});
    rendered_ = static_cast<int>(rendered);
  }

  /// Each frame begins with the one before: so all ranks render it together.
  void render_in_order() {
    series_.ranks = ranks_;
    for (int frame = range_.first; frame <= range_.second; ++frame) render_one(frame);
  }

  /// The folder holds the animation's preset and the plan of frame 0.
  void begin() {
    preset::at_origins(target_.preset, [&] {
      run::ReadyRun& run = series_.run;
      const run::Prepared& prepared = run::prepare_next(run, target_.preset, {interrupted_, {}});
      mixes_frames_ = prepared.plan->mixes_frames;
      if (ranks_) run::require_same(*ranks_, prepared, run.device.context());
      run::require_memory(prepared, run.device.context(), ranks_); // throws before a folder is made
    });
    if (!is_root()) return;
    claimed_.emplace(target_.folder, options_.frames.empty()); // others may render the other frames
    if (options_.resume || !options_.frames.empty()) {
      run::remove_frames(target_.folder, animation_.frames);
      run::write_settings(target_.folder, *series_.run.prepared);
    } else
      run::begin_run(target_.folder, *series_.run.prepared);
  }

  void render_one(int frame) {
    const std::filesystem::path own = run::frame_folder(target_.folder, frame);
    const Communicator communicator(series_.ranks); // rank 0 alone looks at what is there
    const bool begins_with_another = communicator.broadcast(
        communicator.is_root() && mixes_frames_ && !run::frame_before(target_.folder, frame, target_.preset).empty());
    const Target target{preset::at_frame(target_.preset, frame), own, fmt::format("{}/{:04}", target_.label, frame),
                        target_.folder, begins_with_another ? run::frame_folder(target_.folder, frame - 1) : ""};
    if (communicator.broadcast(communicator.is_root() && keeps(frame, target))) return;
    preset::at_origins(target.preset, [&] { render(options_, target, interrupted_, series_); });
    ++rendered_;
    std::error_code ignored; // the next frame begins with this one
    if (is_root() && frame > 0)
      std::filesystem::remove(run::frame_folder(target_.folder, frame - 1) / run::afterimage_file, ignored);
  }

  /// Whether the frame is finished and stays. It is not where the frame before is now another one.
  bool keeps(int frame, const Target& target) {
    if (!options_.resume) return false;
    const auto before = target.frame_before.empty() ? nullptr : run::read_afterimage(target.frame_before);
    const auto done = run::finished_frame(target_.folder, frame, target.preset, before.get());
    if (!done) return false;
    if (!done->changed.empty()) {
      if (series_.notes.insert(done->changed).second)
        fmt::print(stderr, "note: {}: {}: finished frames start anew\n", target_.label, done->changed);
      return false;
    }
    if (done->is_shown_otherwise) run::show_anew(target.folder, target.preset);
    run::show_frame(target_.folder, frame);
    if (options_.json) report_result(options_, target, done->progress, true);
    return true;
  }

  void end() const {
    const std::vector<int> finished = run::finished_frames(target_.folder, target_.preset);
    run::write_frame_figures(target_.folder, finished);
    const auto missing = static_cast<std::size_t>(animation_.frames) - finished.size();
    const std::optional<std::string> why_none =
        missing > 0 ? counted(missing, "frame") + (missing == 1 ? " is" : " are") + " missing; go on with --resume"
                    : run::make_video(target_.folder, animation_.frames, animation_.fps);
    if (options_.json) {
      nlohmann::ordered_json all{{"type", "animation"},
                                 {"name", target_.preset.name},
                                 {"folder", target_.folder.string()},
                                 {"frames", animation_.frames},
                                 {"rendered", rendered_},
                                 {"finished", missing == 0},
                                 {"files", {"preset.json", "plan.json", "frames.csv"}}};
      if (!why_none) all["files"].push_back("animation.mp4");
      fmt::print("{}\n", json_text(all));
    } else {
      if (rendered_ == 0) fmt::print(stderr, "{}: these frames are finished\n", target_.label);
      if (!why_none)
        fmt::print("{}: {}, {} a second\n", (target_.folder / "animation.mp4").string(),
                   counted(finished.size(), "frame"), animation_.fps);
    }
    std::fflush(stdout);
    if (why_none) fmt::print(stderr, "note: {}: there is no video: {}\n", target_.label, *why_none);
  }

  const RunOptions& options_;
  const Target& target_;
  std::stop_token interrupted_;
  RunSeries& series_;
  const preset::Animation& animation_;
  std::shared_ptr<mpi::Ranks> ranks_; ///< null: this process renders all frames alone
  std::pair<int, int> range_;
  bool mixes_frames_ = false; ///< Plan::mixes_frames
  int rendered_ = 0;
  std::optional<run::ClaimedFolder> claimed_;
};

} // namespace

void render_animation(const RunOptions& options, const Target& target, const std::stop_token& interrupted,
                      RunSeries& series) {
  Frames(options, target, interrupted, series)();
}

} // namespace nephroid::cli
