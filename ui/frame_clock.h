// SPDX-License-Identifier: Apache-2.0
// When the next frame is drawn, and how long frames took.
#pragma once
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace nephroid::ui {

struct FrameTime {
  double draw_ms = 0;   ///< from the first event taken to the buffers swapped: what the window itself costs
  double period_ms = 0; ///< from this frame's begin to the last one's: what a person sees
  std::string state;    ///< of the run
  double fraction = 0;
};

class FrameClock {
public:
  using Clock = std::chrono::steady_clock;
  /// Somebody moves the mouse: the display's rate. A run goes on: often enough for its snapshots. Else: seldom.
  enum class Pace { hands_on, running, idle };

  /// keep: every frame's time, for summary() and write(); else frames are only counted.
  explicit FrameClock(bool keep) : keep_(keep) {}
  bool keeps() const { return keep_; }

  void begin();
  void end(const std::string& state, double fraction);
  /// Seconds to sleep before the next frame. The device may be the processor that draws, too: while nobody touches the window it
  /// takes at most a quarter of the time, so that drawing without need does not slow the run.
  double rest(Pace pace) const;
  std::size_t frames() const { return frames_; }
  /// "N frames, draw median A ms, 99 % B ms, most C ms" over what was drawn so far.
  std::string summary() const;
  /// CSV with a line a frame: frame,draw_ms,period_ms,state,fraction. Written whole; throws failed.
  void write(const std::filesystem::path& file) const;

private:
  bool keep_ = false;
  std::size_t frames_ = 0;
  double last_draw_s_ = 0;
  Clock::time_point began_{}, previous_{};
  std::vector<FrameTime> times_;
};

} // namespace nephroid::ui
