// SPDX-License-Identifier: Apache-2.0
#include "inverse/thesis/annealer.h"

#include "inverse/uniform.h"

#include <algorithm>
#include <cmath>
#include <span>
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

void Annealer::save(ByteSink& to) const
{
  to.write(std::as_bytes(std::span(values_)));
  to.write(std::as_bytes(std::span(lowest_)));
  to.value(cost_);
  to.value(lowest_cost_);
  to.value(done_);
  to.value(accepted_);
}

void Annealer::load(ByteSource& from)
{
  from.read(std::as_writable_bytes(std::span(values_)));
  from.read(std::as_writable_bytes(std::span(lowest_)));
  from.value(cost_);
  from.value(lowest_cost_);
  from.value(done_);
  from.value(accepted_);
}

} // namespace nephroid::inverse
