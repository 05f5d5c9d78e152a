// SPDX-License-Identifier: Apache-2.0
#include "inverse/search.h"

#include "inverse/judge_time.h"
#include "inverse/tolerances.h"

#include <algorithm>

namespace nephroid::inverse {

Search::Search(const preset::Preset& preset, const Layout& layout, const std::vector<Target>& targets,
               std::uint64_t triangles, const mpi::RankContext& context)
    : context_(context), preset_(preset), layout_(layout), triangles_(triangles),
      method_(make_method(preset, layout, targets, context)) {
  note_step();
}

bool Search::is_over() {
  if (!has_steps_left()) return true;
  if (!preset_.stop.seconds || method_->steps() == began_.steps)
    return false; // what is judged has had one step at least
  if (!judge_needs_)
    judge_needs_ =
        judge_seconds(context_, layout_, triangles_) * (settings(preset_).tolerances ? 1 + Tolerances::count : 1);
  return context_.communicator().broadcast(
      counted_seconds() + (method_->fraction_done() == 0 ? last_step_seconds() : 0) >= search_seconds());
}

bool Search::advance() {
  const std::int64_t before = method_->steps();
  method_->advance();
  if (method_->steps() == before) return false;
  note_step();
  return true;
}

void Search::go_on() {
  judge_needs_.reset();
  method_->relight();
  began_ = {method_->steps(), seconds_};
  note_step();
}

double Search::fraction_done() const {
  const double steps = static_cast<double>(method_->steps() - began_.steps) + method_->fraction_done();
  return std::max(most_steps() ? steps / static_cast<double>(*most_steps()) : 0,
                  preset_.stop.seconds ? counted_seconds() / std::max(counted_seconds(), search_seconds()) : 0);
}

void Search::show(job::Snapshot& snapshot) const {
  snapshot.curves.push_back(
      {"cost", {std::string(method_->units().step), "seconds", "cost", "cost_all", "rel_l2", "missed"}, {}});
  for (const CostRow& r : history_)
    snapshot.curves.back().rows.push_back(
        {r.step, r.seconds, r.cost.cost, r.cost.cost_all, r.cost.rel_l2, r.cost.missed});
  method_->show(snapshot);
}

void Search::state_of_method(State& state) {
  method_->state(state);
  state.value(seconds_);
}

void Search::state_of_count(State& state) {
  state.value(began_);
  state.list(history_);
}

void Search::note_step() {
  history_.push_back({static_cast<double>(method_->steps()), seconds_, mean(method_->costs())});
}

/// Of the stop's seconds, what the judge leaves; once is_over() has asked how long it takes.
double Search::search_seconds() const { return *preset_.stop.seconds - judge_needs_.value_or(0); }

/// A step is not begun where it would not end in time; 0 before the first.
double Search::last_step_seconds() const {
  if (method_->steps() == began_.steps || history_.size() < 2) return 0;
  return history_.back().seconds - history_[history_.size() - 2].seconds;
}

/// Empty: until the seconds are over.
std::optional<std::int64_t> Search::most_steps() const {
  if (preset_.stop.passes) return *preset_.stop.passes;
  return preset_.stop.seconds ? std::nullopt : std::optional(method_->most());
}

} // namespace nephroid::inverse
