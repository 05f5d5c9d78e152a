// SPDX-License-Identifier: Apache-2.0
#include "ui/state/film_recording.h"

#include "base/counted.h"
#include "base/error.h"
#include "run/animation.h"
#include "run/film.h"
#include "run/recorder.h"

#include <fmt/format.h>

#include <set>

namespace nephroid::ui {
namespace {

/// Writes a frame's files and asks between slices whether it shall go on.
class FrameRecorder final : public run::Recorder {
public:
  /// notes: what it finds to say, each sentence once.
  FrameRecorder(const run::ReadyRun& run, const std::filesystem::path& folder, std::function<void(double)> advanced,
                std::set<std::string>& notes)
      : Recorder(run, {.folder = folder, .is_frame = true}), advanced_(std::move(advanced)), notes_(notes) {}

  void advanced(job::Job& job) override {
    Recorder::advanced(job);
    advanced_(job.progress().fraction);
  }

  void note(const std::string& text) override { notes_.insert(text); }
  void warn(const std::string& text) override { notes_.insert(text); }

private:
  std::function<void(double)> advanced_;
  std::set<std::string>& notes_;
};

} // namespace

std::string FilmRecording::record(const preset::Preset& animation, const std::filesystem::path& folder,
                                  const std::function<compute::Context()>& open_device, State& state,
                                  TaskControl& control) {
  run::ReadyRun run(open_device);
  std::set<std::string> notes;
  const auto stop_if_cancelled = [&] {
    if (control.cancelled()) state.stop.request_stop();
  };
  const Watch watch{state.stop.get_token(), [&](const std::string&) { stop_if_cancelled(); }};
  const auto render = [&](const run::FilmFrame& of) {
    state.frame = of.frame;
    run::make_ready(
        run, of.preset,
        {.watch = watch,
         .folder = of.folder,
         .is_frame = true,
         .frame_before = of.frame_before,
         .resume = true,
         .bad_checkpoint = [&](const Error& error) { notes.insert(error.line() + "; the frame began anew"); }});
    FrameRecorder recorder(
        run, of.folder,
        [&](double part) {
          control.progress((of.frame + part) / state.frames);
          stop_if_cancelled();
        },
        notes);
    run::hide_frame(folder, of.frame);
    run::drive(run, recorder, watch.stop);
    run.claimed.reset();
    if (recorder.is_finished()) return run::show_frame(folder, of.frame);
    if (watch.stop.stop_requested())
      throw Error(ErrorKind::interrupted, of.folder.string(), "the recording is stopped");
    throw failed(of.folder.string(), "the run ended before its first picture", "",
                 "let `stop` of the preset give a frame more time");
  };
  const auto starts_anew = [&](const std::string& changed) {
    notes.insert(changed + ": finished frames were rendered anew");
  };
  const run::FilmResult film = run::make_film(run, animation,
                                              {.folder = folder,
                                               .last = state.frames - 1,
                                               .resume = true,
                                               .watch = watch,
                                               .render = render,
                                               .starts_anew = starts_anew});
  std::string said = film.why_no_video
                         ? fmt::format("recorded {} in {}; there is no video: {}",
                                       counted(film.finished.size(), "frame"), folder.string(), *film.why_no_video)
                         : "recorded " + (folder / "animation.mp4").string();
  for (const std::string& note : notes) said += "\n" + note;
  return said;
}

std::string FilmRecording::summary() const {
  if (state_ && state_->stop.stop_requested()) return "stopping";
  return state_ ? fmt::format("frame {} of {}", state_->frame + 1, state_->frames) : std::string();
}

void FilmRecording::carry_out(const command::RecordFilm& c) {
  if (!document_.edits() || active()) return;
  const preset::Preset& preset = *document_.edits()->in_file();
  if (!preset.animation)
    throw bad_input(preset.source + "#/animation", "is not there", "expected the frames of a film");
  if (!preset.white)
    throw bad_input(preset.source + "#/white", "is \"auto\" until the first picture is there", "", "wait for that");
  const std::filesystem::path folder = std::filesystem::absolute(c.folder);
  const job::State state = run_.status().state;
  paused_run_ = state == job::State::running || state == job::State::preparing;
  if (paused_run_) run_.carry_out(command::Pause{true});
  state_ = std::make_shared<State>();
  state_->frames = preset.animation->frames;
  services_.tasks.start(
      key_, {"recording " + folder.string(), TaskKind::request},
      [animation = preset, folder, device = source_.device_opener(), state = state_](TaskControl& control) {
        const struct AtEnd {
          State& state;
          ~AtEnd() { state.ended = true; }
        } at_end{*state};
        try {
          return record(animation, folder, device, *state, control);
        } catch (const Error& error) {
          if (error.kind() != ErrorKind::interrupted) throw;
          return fmt::format("the recording is stopped at frame {} of {}; recording into {} again goes on there",
                             state->frame + 1, state->frames, folder.string());
        }
      },
      [this](const std::string& note) { services_.messages.note(note); });
  services_.follow_ups.push_back(command::Ask{});
}

void FilmRecording::carry_out(const command::StopFilm&) {
  if (state_) state_->stop.request_stop();
}

void FilmRecording::update() {
  if (!state_ || !state_->ended || services_.tasks.busy(key_)) return;
  state_.reset();
  if (std::exchange(paused_run_, false) && run_.status().state == job::State::paused)
    run_.carry_out(command::Pause{false});
}

} // namespace nephroid::ui
