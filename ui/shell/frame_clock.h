// SPDX-License-Identifier: Apache-2.0
// When the next frame is drawn, and how long frames took.
#pragma once
#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace nephroid::ui {

class FrameClock {
public:
  using Clock = std::chrono::steady_clock;
  /// Somebody moves the mouse: the display's rate. A run goes on: often enough for its snapshots. Else: seldom.
  enum class Pace { hands_on, running, idle };

  /// keep: every frame's time, for summary(); else frames are only counted. file: CSV with the line
  /// frame,draw_ms,period_ms,state,fraction of a frame as soon as it has been drawn, so that who reads along knows what the window is
  /// at; empty: none. Throws failed where it cannot be written.
  FrameClock(bool keep, const std::filesystem::path& file);
  bool keeps() const { return keep_; }

  void begin();
  /// state, fraction: of the run. Throws failed where the file cannot be written any more.
  void end(const std::string& state, double fraction);
  /// Seconds to sleep before the next frame. The device may be the processor that draws, too: while nobody touches the window it
  /// takes at most a quarter of the time, so that drawing without need does not slow the run.
  double rest(Pace pace) const;
  std::size_t frames() const { return frames_; }
  /// "N frames, draw median A ms, 99 % B ms, most C ms" over what was drawn so far.
  std::string summary() const;

private:
  void write(const std::string& line);

  bool keep_ = false;
  std::size_t frames_ = 0;
  double last_draw_s_ = 0;
  Clock::time_point began_{}, previous_{};
  std::vector<double> draw_ms_; ///< of each frame, from the first event taken to the buffers swapped: what the window itself costs
  std::filesystem::path file_;
  std::ofstream lines_;
};

} // namespace nephroid::ui
