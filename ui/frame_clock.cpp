// SPDX-License-Identifier: Apache-2.0
#include "ui/frame_clock.h"

#include "base/files.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace nephroid::ui {
namespace {

double milliseconds(FrameClock::Clock::duration time) { return std::chrono::duration<double, std::milli>(time).count(); }

} // namespace

void FrameClock::begin() { previous_ = std::exchange(began_, Clock::now()); }

void FrameClock::end(const std::string& state, double fraction)
{
  ++frames_;
  last_draw_s_ = milliseconds(Clock::now() - began_) / 1000;
  if (!keep_) return;
  const double period = previous_ == Clock::time_point{} ? 0 : milliseconds(began_ - previous_);
  times_.push_back({1000 * last_draw_s_, period, state, fraction});
}

double FrameClock::rest(Pace pace) const
{
  double period_s = 1.0 / 60;
  if (pace == Pace::running) period_s = std::max(1.0 / 30, 4 * last_draw_s_);
  if (pace == Pace::idle) period_s = 1.0 / 4;
  return std::max(0.0, period_s - milliseconds(Clock::now() - began_) / 1000);
}

std::string FrameClock::summary() const
{
  if (times_.empty()) return "no frames";
  std::vector<double> sorted;
  for (const FrameTime& time : times_) sorted.push_back(time.draw_ms);
  std::sort(sorted.begin(), sorted.end());
  const auto at = [&](double part) { return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))]; };
  return fmt::format("{} frames, draw median {:.1f} ms, 99 % {:.1f} ms, most {:.1f} ms", sorted.size(), at(0.5), at(0.99), sorted.back());
}

void FrameClock::write(const std::filesystem::path& file) const
{
  std::string text = "frame,draw_ms,period_ms,state,fraction\n";
  for (std::size_t i = 0; i < times_.size(); ++i)
    fmt::format_to(std::back_inserter(text), "{},{:.3f},{:.3f},{},{:.4f}\n", i, times_[i].draw_ms, times_[i].period_ms, times_[i].state,
                   times_[i].fraction);
  write_file_whole(file, text);
}

} // namespace nephroid::ui
