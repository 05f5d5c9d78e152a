// SPDX-License-Identifier: Apache-2.0
#include "cli/progress.h"

#include "base/json_output.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <sys/ioctl.h>
#include <unistd.h>
#include <utility>

namespace nephroid::cli {
namespace {

std::chrono::milliseconds rhythm(ProgressStyle style) {
  return std::chrono::milliseconds(style == ProgressStyle::live ? 100 : style == ProgressStyle::json ? 500 : 3000);
}

int terminal_columns() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

/// "0:07", "12:30", "3:00:00"
std::string clock_time(double seconds) {
  const auto whole = static_cast<long long>(std::min(std::round(seconds), 1e9));
  if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
  return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

/// "pass 3 of 28": the pass in hand, or the last one once all are done.
std::string pass_text(const job::Progress& now) {
  if (now.steps < 0) return fmt::format("{} {}", now.units.step, now.step + 1);
  return fmt::format("{} {} of {}", now.units.step, std::min(now.step + 1, now.steps), now.steps);
}

std::string bar(double fraction, int width) {
  const int done = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * width);
  return std::string(static_cast<std::size_t>(done), '#') + std::string(static_cast<std::size_t>(width - done), '-');
}

} // namespace

ProgressStyle progress_style(bool json) {
  if (json) return ProgressStyle::json;
  const char* terminal = std::getenv("TERM");
  const bool moves = terminal && std::string_view(terminal) != "dumb";
  return ::isatty(STDERR_FILENO) && moves ? ProgressStyle::live : ProgressStyle::lines;
}

std::string progress_line(const std::string& label, const job::Progress& now, const job::Pace& pace, int columns) {
  std::string figures = fmt::format("{:3.0f} %  {}", std::floor(now.fraction * 100), pass_text(now));
  if (pace.work_per_second > 0) figures += "  " + job::rate_text(pace, now.units);
  if (pace.seconds_left >= 0) figures += fmt::format("  {} left", clock_time(pace.seconds_left));
  const int room = columns - static_cast<int>(label.size() + figures.size()) - 6;
  std::string line =
      room >= 5 ? fmt::format("{}  [{}]  {}", label, bar(now.fraction, std::min(room, 30)), figures) : figures;
  line.resize(std::min(line.size(), static_cast<std::size_t>(std::max(columns, 1))));
  return line;
}

std::string progress_json(const ProgressSubject& subject, const job::Progress& now, const job::Pace& pace) {
  const nlohmann::ordered_json all{
      {"type", "progress"},
      {"name", subject.run},
      {"stage", subject.stage},
      {"fraction", now.fraction},
      {"step", now.step},
      {"steps", now.steps >= 0 ? nlohmann::ordered_json(now.steps) : nlohmann::ordered_json()},
      {std::string(now.units.works), now.work},
      {"work_seconds", now.work_seconds},
      {fmt::format("{}_per_second", now.units.works), pace.work_per_second},
      {"seconds_left", pace.seconds_left >= 0 ? nlohmann::ordered_json(pace.seconds_left) : nlohmann::ordered_json()}};
  return json_text(all);
}

void LiveLine::show(const std::string& text) {
  fmt::print(stderr, "\r{}\033[K", text);
  std::fflush(stderr);
  is_shown_ = true;
}

void LiveLine::clear() {
  if (!std::exchange(is_shown_, false)) return;
  fmt::print(stderr, "\r\033[K");
  std::fflush(stderr);
}

ProgressDisplay::ProgressDisplay(ProgressStyle style, ProgressSubject subject, const job::Progress& start,
                                 Clock::time_point time)
    : style_(style), subject_(std::move(subject)), start_(start), next_(time + rhythm(style)) {}

void ProgressDisplay::update(const job::Progress& now, Clock::time_point time) {
  if (time < next_) return;
  show(now);
  next_ = time + rhythm(style_);
}

void ProgressDisplay::finish(const job::Progress& now) {
  clear();
  if (style_ == ProgressStyle::json) show(now);
}

void ProgressDisplay::show(const job::Progress& now) {
  const job::Pace pace = job::pace_between(start_, now);
  if (style_ == ProgressStyle::json) {
    fmt::print("{}\n", progress_json(subject_, now, pace));
    std::fflush(stdout);
  } else if (style_ == ProgressStyle::lines) {
    fmt::print(stderr, "{}\n", progress_line(subject_.label, now, pace, 200));
  } else {
    line_.show(progress_line(subject_.label, now, pace, terminal_columns() - 1));
  }
}

} // namespace nephroid::cli
