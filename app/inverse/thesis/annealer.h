// SPDX-License-Identifier: Apache-2.0
// Simulated annealing of a few numbers, as the thesis has it: cycles of moves at one temperature, each cycle colder.
#pragma once
#include "base/state.h"

#include <cstdint>
#include <random>
#include <vector>

namespace nephroid::inverse {

struct Knob {
  double start = 0, step = 0.1; ///< a move changes it by up to `step` either way
  double low = 0, high = 1;     ///< it stays between
};

struct Cooling {
  double temperature = 0.005; ///< of the first cycle, in cost: Boltzmann's constant is 1
  double factor = 0.5;
  int cycles = 10, moves = 10; ///< moves of a cycle
};

class Annealer {
public:
  /// cost: at the knobs' starts.
  Annealer(std::vector<Knob> knobs, const Cooling& cooling, double cost);

  bool finished() const { return done_ >= std::int64_t{cooling_.cycles} * cooling_.moves; }
  double temperature() const; ///< of the move in hand
  /// All knobs moved at once. The same random numbers propose the same.
  const std::vector<double>& propose(std::mt19937_64 random);
  /// Takes the proposal where its cost is no higher than that of the values in hand, else with probability exp(-rise / temperature).
  /// True where it is the lowest so far.
  bool decide(double cost);

  const std::vector<double>& lowest() const { return lowest_; } ///< values of the lowest cost
  double lowest_cost() const { return lowest_cost_; }
  std::int64_t accepted() const { return accepted_; }
  std::int64_t refused() const { return done_ - accepted_; }

  void state(State& state);

private:
  std::vector<Knob> knobs_;
  Cooling cooling_;
  std::vector<double> proposed_;
  double chance_ = 0; ///< 0..1, of the proposal
  // The state.
  std::vector<double> values_, lowest_;
  double cost_ = 0, lowest_cost_ = 0;
  std::int64_t done_ = 0, accepted_ = 0;
};

} // namespace nephroid::inverse
