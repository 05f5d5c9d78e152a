// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/frame_clock.h"

#include "base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace nephroid::ui {
namespace {

double milliseconds(FrameClock::Clock::duration time) { return std::chrono::duration<double, std::milli>(time).count(); }

} // namespace

FrameClock::FrameClock(bool keep, const std::filesystem::path& file) : keep_(keep), file_(file)
{
  if (file.empty()) return;
  lines_.open(file, std::ios::binary);
  write("frame,draw_ms,period_ms,state,fraction\n");
}

void FrameClock::write(const std::string& line)
{
  lines_ << line << std::flush;
  if (!lines_) throw failed(file_.string(), "cannot be written", "", "choose another file for --frame-times");
}

void FrameClock::begin() { previous_ = std::exchange(began_, Clock::now()); }

void FrameClock::end(const std::string& state, double fraction)
{
  const double draw_ms = milliseconds(Clock::now() - began_);
  last_draw_s_ = draw_ms / 1000;
  if (keep_) draw_ms_.push_back(draw_ms);
  if (!file_.empty()) {
    const double period_ms = frames_ == 0 ? 0 : milliseconds(began_ - previous_); // what a person sees
    write(fmt::format("{},{:.3f},{:.3f},{},{:.4f}\n", frames_, draw_ms, period_ms, state, fraction));
  }
  ++frames_;
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
  if (draw_ms_.empty()) return "no frames";
  std::vector<double> sorted = draw_ms_;
  std::sort(sorted.begin(), sorted.end());
  const auto at = [&](double part) { return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))]; };
  return fmt::format("{} frames, draw median {:.1f} ms, 99 % {:.1f} ms, most {:.1f} ms", sorted.size(), at(0.5), at(0.99), sorted.back());
}

} // namespace nephroid::ui
