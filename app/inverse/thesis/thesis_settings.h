// SPDX-License-Identifier: Apache-2.0
// The constants of the thesis' pipeline: the section "inverse.thesis". The thesis prints draws, cycles, moves, cooling, corrections,
// patience and worth; temperature, steps, limits and directions are ours.
#pragma once

namespace nephroid::inverse {

struct Thesis {
  enum class Sampling { exact, rejection };
  enum class Adjust { convergence, each };
  Sampling sampling = Sampling::exact;
  int directions = 128; ///< across and down, that a facet's light is tried in
  int draws = 32;       ///< of every facet, that a cost is the mean of
  Adjust adjust = Adjust::convergence;
  int cycles = 10, moves = 10;  ///< of an annealing, and of a cycle
  double temperature = 0.005;   ///< of the first cycle, in cost
  double cooling = 0.5;         ///< from cycle to cycle
  double size_step = 0.02;      ///< largest change in a move; this and the limit below: of the convergence, or of each picture's size
  double size_limit = 0.1;      ///< largest change in all
  double shift_step = 0.01;     ///< in parts of the receiver
  double shift_limit = 0.05;    ///< the same
  double distance_step = 0.01;  ///< in parts of the distance
  double distance_limit = 0.05; ///< the same
  double extension_step = 0.1;  ///< of k, which is 0..1
  double overshoot_step = 0.1;  ///< of o, which is 0..1
  int corrections = 50;         ///< at most
  int patience = 5;             ///< corrections without a gain, after which no more follow
  double worth = 1e-5;          ///< a smaller gain of cost is none
  double ratio_limit = 2;       ///< a cell's correction is between this and its inverse
  bool operator==(const Thesis&) const = default;
};

} // namespace nephroid::inverse
