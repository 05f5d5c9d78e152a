// SPDX-License-Identifier: Apache-2.0
// The section "inverse.thesis" as preset/describe.h says.
#pragma once
#include "inverse/thesis/thesis_settings.h"
#include "preset/value.h"

namespace nephroid::preset {

template <>
struct Choices<inverse::Thesis::Sampling> {
  using Sampling = inverse::Thesis::Sampling;
  static constexpr Choice<Sampling> all[] = {
      {Sampling::exact, "exact", "From the cumulative sum."},
      {Sampling::rejection, "rejection", "By acceptance and rejection, as printed: the same distribution, with more tries."}};
};

template <>
struct Choices<inverse::Thesis::Adjust> {
  using Adjust = inverse::Thesis::Adjust;
  static constexpr Choice<Adjust> all[] = {
      {Adjust::convergence, "convergence", "One number: how wide the light is at the last receiver, over the object."},
      {Adjust::each, "each", "Four numbers a picture: its size, its place across and down, its distance."}};
};

} // namespace nephroid::preset

namespace nephroid::inverse {

inline void describe(preset::Fields& v, Thesis& t)
{
  v.about("InverseThesis", "Constants of the method \"thesis\".");
  using preset::within;
  const auto share = [&](std::string_view name, std::string_view sentence, auto& value, std::string_view unit = {}) {
    v.field(name, sentence, value, {.unit = unit, .bounds = within(0, 1)});
  };
  v.field("sampling", "How directions are drawn from the joint probability (5.1).", t.sampling);
  v.field("directions", "Directions across and down that a facet's light is tried in; they cover the receivers as the facet sees them.",
          t.directions, {.bounds = within(1, 1024)});
  v.field("draws", "Draws of every facet that a cost is the mean of.", t.draws, {.bounds = within(1, 1024)});
  v.field("adjust", "What the first annealing changes.", t.adjust);
  v.field("cycles", "Cycles of each annealing; 0 leaves both out.", t.cycles, {.bounds = within(0, 1000)});
  v.field("moves", "Moves of a cycle, at one temperature.", t.moves, {.bounds = within(1, 1000)});
  v.field("temperature", "Temperature of the first cycle: a move that raises the cost by so much is taken with probability 1 / e.",
          t.temperature, {.unit = "of cost", .bounds = within(0, 1)});
  share("cooling", "The temperature of a cycle over that of the cycle before.", t.cooling);
  share("size_step", "Largest change in a move of the convergence, or of a picture's size.", t.size_step);
  v.field("size_limit", "Largest change of that in all.", t.size_limit, {.bounds = within(0, 0.9)});
  share("shift_step", "Largest change in a move of a picture's place.", t.shift_step, "parts of the receiver");
  share("shift_limit", "Largest change of that in all.", t.shift_limit, "parts of the receiver");
  share("distance_step", "Largest change in a move of a picture's distance.", t.distance_step, "parts of the distance");
  v.field("distance_limit", "Largest change of that in all.", t.distance_limit,
          {.unit = "parts of the distance", .bounds = within(0, 0.9)});
  share("extension_step", "Largest change in a move of k, the part of a picture's largest extension.", t.extension_step);
  share("overshoot_step", "Largest change in a move of o, the part of a picture's largest overshoot.", t.overshoot_step);
  v.field("corrections", "Rounds of the intensity correction at most; 0 leaves it out.", t.corrections, {.bounds = within(0, 1000)});
  v.field("patience", "Rounds without a gain after which no more follow.", t.patience, {.bounds = within(1, 1000)});
  v.field("worth", "A gain below this is none.", t.worth, {.unit = "of cost", .bounds = within(0, 1)});
  v.field("ratio_limit", "A round makes a cell brighter, or darker, by this factor at most, also where no light reached it.", t.ratio_limit,
          {.bounds = within(1, 1000)});
}

} // namespace nephroid::inverse
