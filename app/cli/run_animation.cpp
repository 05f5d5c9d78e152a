// SPDX-License-Identifier: Apache-2.0
#include "base/counted.h"
#include "base/json_output.h"
#include "base/numbers.h"
#include "cli/run_target.h"
#include "cli/verb.h"
#include "run/film.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <memory>
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

/// The video's line, or as JSON how many frames there are.
void report_film(const RunOptions& options, const Target& target, const run::FilmResult& film) {
  const preset::Animation& animation = *target.preset.animation;
  const auto frames = static_cast<std::size_t>(animation.frames);
  if (options.json) {
    nlohmann::ordered_json all{{"type", "animation"},
                               {"name", target.preset.name},
                               {"folder", target.folder.string()},
                               {"frames", animation.frames},
                               {"rendered", film.rendered},
                               {"finished", film.finished.size() == frames},
                               {"files", {"preset.json", "plan.json", "frames.csv"}}};
    if (!film.why_no_video) all["files"].push_back("animation.mp4");
    fmt::print("{}\n", json_text(all));
  } else {
    if (film.rendered == 0) fmt::print(stderr, "{}: these frames are finished\n", target.label);
    if (!film.why_no_video)
      fmt::print("{}: {}, {} a second\n", (target.folder / "animation.mp4").string(), counted(frames, "frame"),
                 animation.fps);
  }
  std::fflush(stdout);
  if (film.why_no_video)
    fmt::print(stderr, "note: {}: there is no video: {}{}\n", target.label, *film.why_no_video,
               film.finished.size() < frames ? "; go on with --resume" : "");
}

} // namespace

void render_animation(const RunOptions& options, const Target& target, const std::stop_token& interrupted,
                      RunSeries& series) {
  const auto [first, last] = frames_of(options.frames, target.preset.animation->frames);
  const auto frame_target = [&](const run::FilmFrame& of) {
    return Target{of.preset, of.folder, fmt::format("{}/{:04}", target.label, of.frame), target.folder,
                  of.frame_before};
  };
  const std::shared_ptr<mpi::Ranks> ranks = std::exchange(series.ranks, nullptr);
  const run::FilmOptions film{.folder = target.folder,
                              .first = first,
                              .last = last,
                              .is_part = !options.frames.empty(),
                              .resume = options.resume,
                              .ranks = ranks,
                              .watch = {interrupted, {}},
                              .render =
                                  [&](const run::FilmFrame& of) {
                                    series.ranks = of.ranks;
                                    render(options, frame_target(of), interrupted, series);
                                  },
                              .kept =
                                  [&](const run::FilmFrame& of, const run::FinishedRun& done) {
                                    if (options.json) report_result(options, frame_target(of), done.progress, true);
                                  },
                              .starts_anew =
                                  [&](const std::string& changed) {
                                    if (series.notes.insert(changed).second)
                                      fmt::print(stderr, "note: {}: {}: finished frames start anew\n", target.label,
                                                 changed);
                                  }};
  const run::FilmResult made = run::make_film(series.run, target.preset, film);
  if (Communicator(ranks).is_root()) report_film(options, target, made);
}

} // namespace nephroid::cli
