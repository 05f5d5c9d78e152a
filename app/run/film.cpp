// SPDX-License-Identifier: Apache-2.0
#include "run/film.h"

#include "base/counted.h"
#include "preset/animation.h"
#include "preset/origins.h"
#include "run/afterimage.h"
#include "run/animation.h"
#include "run/night.h"
#include "run/write_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

namespace nephroid::run {
namespace {

class Film {
public:
  Film(ReadyRun& run, const preset::Preset& animation, const FilmOptions& options)
      : run_(run), animation_(animation), options_(options) {}

  FilmResult make() {
    check_frames();
    begin();
    if (options_.ranks) require_shared(*options_.ranks, options_.folder / "preset.json");
    if (options_.ranks && !mixes_frames_)
      distribute_frames();
    else
      for (int frame = options_.first; frame <= options_.last; ++frame) render_one(frame, options_.ranks);
    if (is_root()) end();
    return result_;
  }

private:
  bool is_root() const { return !options_.ranks || options_.ranks->rank() == 0; }

  /// Throws at once for a frame that cannot be. Whether a shape can be in a frame shows where it is made.
  void check_frames() const {
    const bool deforms = std::ranges::any_of(animation_.animation->tracks, [](const preset::Track& track) {
      return track.path.starts_with("scene.objects.") && track.path.find(".transform.") == std::string::npos;
    });
    std::optional<Prepared> before;
    for (int frame = options_.first; frame <= options_.last; ++frame) {
      const preset::Preset of = preset::at_frame(animation_, frame);
      if (deforms) preset::at_origins(of, [&] { before = prepare(of, before ? &*before : nullptr, options_.watch); });
    }
  }

  /// Each rank renders the next frame, alone, when it is free.
  void distribute_frames() {
    options_.ranks->distribute(options_.last - options_.first + 1, [&](std::int64_t number) {
      render_one(options_.first + static_cast<int>(number), nullptr);
    });
    std::int64_t rendered = result_.rendered;
    options_.ranks->all_reduce_sum({&rendered, 1});
    result_.rendered = static_cast<int>(rendered);
  }

  /// The folder holds the animation's preset and the plan of frame 0.
  void begin() {
    preset::at_origins(animation_, [&] {
      const Prepared& prepared = prepare_next(run_, animation_, options_.watch);
      mixes_frames_ = prepared.plan->mixes_frames;
      if (is_night(animation_))
        mixes_frames_ = prepare(by_day(animation_), &prepared, options_.watch).plan->mixes_frames;
      if (options_.ranks) require_same(*options_.ranks, prepared, run_.device.context());
      require_memory(prepared, run_.device.context(), options_.ranks); // throws before a folder is made
    });
    if (!is_root()) return;
    claimed_.emplace(options_.folder, !options_.is_part);
    if (options_.resume || options_.is_part) {
      remove_frames(options_.folder, animation_.animation->frames);
      write_settings(options_.folder, *run_.prepared);
    } else
      begin_run(options_.folder, *run_.prepared);
  }

  void render_one(int frame, const std::shared_ptr<mpi::Ranks>& ranks) {
    const Communicator communicator(ranks); // rank 0 alone looks at what is there
    const bool begins_with_another = communicator.broadcast(communicator.is_root() && mixes_frames_ &&
                                                            !frame_before(options_.folder, frame, animation_).empty());
    const FilmFrame of{frame, preset::at_frame(animation_, frame), frame_folder(options_.folder, frame),
                       begins_with_another ? frame_folder(options_.folder, frame - 1) : "", ranks};
    if (communicator.broadcast(communicator.is_root() && keeps(of))) return;
    preset::at_origins(of.preset, [&] { options_.render(of); });
    ++result_.rendered;
    std::error_code ignored; // the next frame begins with this one
    if (is_root() && frame > 0)
      std::filesystem::remove(frame_folder(options_.folder, frame - 1) / afterimage_file, ignored);
  }

  /// Whether the frame is finished and stays. It is not where the frame before is now another one.
  bool keeps(const FilmFrame& of) const {
    if (!options_.resume) return false;
    const auto before = of.frame_before.empty() ? nullptr : read_afterimage(of.frame_before);
    const auto done = finished_frame(options_.folder, of.frame, of.preset, before.get());
    if (!done) return false;
    if (!done->changed.empty()) {
      if (options_.starts_anew) options_.starts_anew(done->changed);
      return false;
    }
    if (done->is_shown_otherwise) show_anew(of.folder, of.preset);
    show_frame(options_.folder, of.frame);
    if (options_.kept) options_.kept(of, *done);
    return true;
  }

  void end() {
    result_.finished = finished_frames(options_.folder, animation_);
    write_frame_figures(options_.folder, result_.finished);
    const int frames = animation_.animation->frames;
    const auto missing = static_cast<std::size_t>(frames) - result_.finished.size();
    result_.why_no_video = missing > 0 ? counted(missing, "frame") + (missing == 1 ? " is" : " are") + " missing"
                                       : make_video(options_.folder, frames, animation_.animation->fps);
  }

  ReadyRun& run_;
  const preset::Preset& animation_;
  const FilmOptions& options_;
  bool mixes_frames_ = false; ///< Plan::mixes_frames
  FilmResult result_;
  std::optional<ClaimedFolder> claimed_;
};

} // namespace

FilmResult make_film(ReadyRun& run, const preset::Preset& animation, const FilmOptions& options) {
  return Film(run, animation, options).make();
}

} // namespace nephroid::run
