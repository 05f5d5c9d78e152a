// SPDX-License-Identifier: Apache-2.0
// How a run shows where it is: one live line on a terminal, a line every few seconds elsewhere, JSON lines with --json.
#pragma once
#include "job/job.h"
#include "job/pace.h"

#include <chrono>

namespace nephroid::cli {

enum class ProgressStyle { live, lines, json };

/// Returns `live` if standard error is a terminal that can move its cursor (TERM is not "dumb").
ProgressStyle progress_style(bool json);

/// The run that the progress is about.
struct ProgressSubject {
  std::string label;         ///< name for people
  std::string run;           ///< name for scripts: the preset's, as in the JSON of plan and importance
  std::string stage = "run"; ///< or "reference", which the run needs first
};

/// "first-light  [#####-----]  51 %  pass 26 of 50  1.21 M photons/s  0:07 left", at most `columns` wide.
std::string progress_line(const std::string& label, const job::Progress& now, const job::Pace& pace, int columns);
/// {"type":"progress","name","stage","fraction","step","steps","photons","work_seconds",
///  "photons_per_second","seconds_left"}
std::string progress_json(const ProgressSubject& subject, const job::Progress& now, const job::Pace& pace);

/// A line on standard error that is rewritten in place.
class LiveLine {
public:
  LiveLine() = default;
  ~LiveLine() { clear(); }
  LiveLine(const LiveLine&) = delete;
  LiveLine& operator=(const LiveLine&) = delete;
  void show(const std::string& text);
  void clear();

private:
  bool is_shown_ = false;
};

/// Shows a run's progress as often as its style asks. update() may be called at any rate.
class ProgressDisplay {
public:
  using Clock = std::chrono::steady_clock;
  ProgressDisplay(ProgressStyle style, ProgressSubject subject, const job::Progress& start,
                  Clock::time_point time = Clock::now());
  void update(const job::Progress& now, Clock::time_point time = Clock::now());
  /// Shows the last state at once.
  void finish(const job::Progress& now);
  /// Removes the live line, so that other output can be printed.
  void clear() { line_.clear(); }

private:
  void show(const job::Progress& now);

  ProgressStyle style_;
  ProgressSubject subject_;
  job::Progress start_;
  Clock::time_point next_;
  LiveLine line_;
};

} // namespace nephroid::cli
