// SPDX-License-Identifier: Apache-2.0
#include "inverse/thesis/annealer.h"

#include "inverse/uniform.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace nephroid::inverse {

Annealer::Annealer(std::vector<Knob> knobs, const Cooling& cooling, double cost)
    : knobs_(std::move(knobs)), cooling_(cooling), cost_(cost), lowest_cost_(cost)
{
  for (const Knob& knob : knobs_) values_.push_back(knob.start);
  lowest_ = values_;
}

double Annealer::temperature() const { return cooling_.temperature * std::pow(cooling_.factor, done_ / cooling_.moves); }

const std::vector<double>& Annealer::propose(std::mt19937_64 random)
{
  proposed_ = values_;
  for (std::size_t i = 0; i < knobs_.size(); ++i) {
    const Knob& knob = knobs_[i];
    proposed_[i] = std::clamp(proposed_[i] + knob.step * (2 * uniform(random) - 1), knob.low, knob.high);
  }
  chance_ = uniform(random);
  return proposed_;
}

bool Annealer::decide(double cost)
{
  const double rise = cost - cost_;
  const bool taken = rise <= 0 || chance_ < std::exp(-rise / temperature()); // at 0: exp(-inf), never
  ++done_;
  if (!taken) return false;
  ++accepted_;
  values_ = proposed_;
  cost_ = cost;
  if (cost >= lowest_cost_) return false;
  lowest_ = values_;
  lowest_cost_ = cost;
  return true;
}

void Annealer::state(State& state)
{
  state.items(values_);
  state.items(lowest_);
  state.value(cost_);
  state.value(lowest_cost_);
  state.value(done_);
  state.value(accepted_);
}

} // namespace nephroid::inverse
