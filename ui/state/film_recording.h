// SPDX-License-Identifier: Apache-2.0
// Records the preset's animation: a film in a folder, as `nephroid run` makes it, on a thread and a device queue of its
// own. The run in hand rests meanwhile.
#pragma once
#include "ui/state/document.h"

#include <atomic>
#include <stop_token>

namespace nephroid::ui {

class FilmRecording {
public:
  /// All outlive the object.
  FilmRecording(const Document& document, RunInHand& run, RunSource& source, Services& services)
      : document_(document), run_(run), source_(source), services_(services) {}

  /// Whether a film is being made, or comes to its end after StopFilm.
  bool active() const { return state_ != nullptr; }
  /// "frame 12 of 48", "stopping"; empty where none is made.
  std::string summary() const;

  /// Throws bad_input where the preset has no animation. Finished frames of the same film in the folder stay.
  void carry_out(const command::RecordFilm& c);
  void carry_out(const command::StopFilm&);
  /// Called once a frame.
  void update();

private:
  struct State {
    std::stop_source stop;
    std::atomic<int> frame{0};
    std::atomic<bool> ended{false};
    int frames = 0;
  };
  static std::string record(const preset::Preset& animation, const std::filesystem::path& folder,
                            const std::function<compute::Context()>& open_device, State& state, TaskControl& control);

  const Document& document_;
  RunInHand& run_;
  RunSource& source_;
  Services& services_;
  TaskKey key_;
  std::shared_ptr<State> state_; ///< null: no film is made
  bool paused_run_ = false;      ///< the run in hand rests for it
};

} // namespace nephroid::ui
