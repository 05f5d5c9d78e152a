// SPDX-License-Identifier: Apache-2.0
// How a run shows where it is: one live line on a terminal, a line every few seconds elsewhere, JSON lines with --json.
#pragma once
#include "job/pace.h"

#include <chrono>
#include <memory>
#include <string>
#include <utility>

namespace nephroid::cli {

enum class ProgressStyle { live, lines, json };

/// live where standard error is a terminal that can move its cursor (TERM is not "dumb").
ProgressStyle progress_style(bool json);

/// Whose progress it is.
struct ProgressSubject {
  std::string label;         ///< for people
  std::string run;           ///< for scripts: the preset's name, as in plan's and importance's JSON
  std::string stage = "run"; ///< or "reference", which the run needs first
};

/// "first-light  [#####-----]  51 %  pass 26 of 50  1.21 M photons/s  0:07 left", at most `columns` wide.
std::string progress_line(const std::string& label, const job::Progress& now, const job::Pace& pace, int columns);
/// {"type":"progress","name","stage","fraction","step","steps","photons","work_seconds","photons_per_second","seconds_left"}
std::string progress_json(const ProgressSubject& subject, const job::Progress& now, const job::Pace& pace);

/// The live line while there are no figures yet; nothing where there is no live line.
class ActivityLine {
public:
  ActivityLine(ProgressStyle style, std::string label) : style_(style), label_(std::move(label)) {}
  ~ActivityLine() { clear(); }
  ActivityLine(const ActivityLine&) = delete;
  ActivityLine& operator=(const ActivityLine&) = delete;
  void show(const char* doing);
  void clear();

private:
  ProgressStyle style_;
  std::string label_;
  bool is_shown_ = false;
};

/// Shows a run's progress at the rhythm of its style. Call update as often as you like.
class ProgressDisplay {
public:
  ProgressDisplay(ProgressStyle style, ProgressSubject subject, const job::Progress& start);
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;
  void update(const job::Progress& now);
  /// The last state at once, whatever the rhythm.
  void finish(const job::Progress& now);
  /// Takes the live line away, so that something else can be printed.
  void clear();

private:
  void show(const job::Progress& now);

  using Clock = std::chrono::steady_clock;
  ProgressStyle style_;
  ProgressSubject subject_;
  job::Progress start_;
  Clock::time_point next_;
  bool line_is_shown_ = false;
};

} // namespace nephroid::cli
