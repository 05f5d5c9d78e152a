// SPDX-License-Identifier: Apache-2.0
#include "ui/state/sweep_queue.h"

#include "base/error.h"
#include "ui/state/run_record.h"

#include <fmt/format.h>

#include <algorithm>

namespace nephroid::ui {

void SweepQueue::carry_out(const command::StartSweep&) {
  if (!document_.preset() || active_) return;
  const preset::Preset& preset = *document_.preset();
  const preset::Sweep& sweep = document_.edits()->sweep();
  const std::string place = preset.source + "#/sweep";
  if (sweep.empty())
    throw bad_input(place, "no field is swept", "expected one with its values", "add one in the panel Runs");
  if (const double count = preset::count_runs(sweep); count > static_cast<double>(most_runs))
    throw bad_input(place, fmt::format("gives {:.0f} runs, whose pictures the window would keep", count),
                    fmt::format("expected at most {}", most_runs), "save the preset and use `nephroid run`");
  std::vector<QueuedRun> runs;
  for (preset::SweptRun& swept : preset::swept_runs(preset, sweep)) {
    QueuedRun& run = runs.emplace_back();
    run.name = std::move(swept.name);
    if (swept.preset)
      run.preset = std::make_shared<const preset::Preset>(*std::move(swept.preset));
    else {
      run.state = State::failed;
      run.why = std::move(swept.why_not);
    }
  }
  runs_ = std::move(runs);
  active_ = true;
}

void SweepQueue::begin_next() {
  const auto next = std::ranges::find(runs_, State::waiting, &QueuedRun::state);
  if (next == runs_.end()) {
    active_ = false;
    if (std::exchange(lent_, false)) run_.take_back(document_.edits());
    return;
  }
  next->state = State::running;
  at_ = static_cast<std::size_t>(next - runs_.begin());
  lent_ = true;
  run_.lend(next->preset, next->name);
}

void SweepQueue::stop() {
  if (!std::exchange(active_, false)) return;
  for (QueuedRun& swept : runs_)
    if (swept.state == State::running || swept.state == State::waiting) swept.state = State::stopped;
  if (std::exchange(lent_, false)) run_.take_back(document_.edits());
}

void SweepQueue::update() {
  if (!active_) return;
  if (!lent_) return begin_next();
  QueuedRun& now = runs_[at_];
  const job::Status& status = run_.status();
  switch (status.state) {
  case job::State::finished:
    now.state = State::done;
    now.part = 1;
    if (run_.snapshot()) comparing_.pin(run_now(run_));
    return begin_next();
  case job::State::failed:
    now.state = State::failed;
    now.why = status.error ? status.error->line() : "the run failed";
    return begin_next();
  case job::State::cancelled: return stop();
  default: now.part = status.progress.fraction;
  }
}

std::string SweepQueue::summary() const {
  const auto count = [&](State state) { return std::ranges::count(runs_, state, &QueuedRun::state); };
  std::string text = fmt::format("{} of {} done", count(State::done), runs_.size());
  if (count(State::failed) > 0) text += fmt::format(", {} failed", count(State::failed));
  if (count(State::stopped) > 0) text += fmt::format(", {} stopped", count(State::stopped));
  return text;
}

} // namespace nephroid::ui
