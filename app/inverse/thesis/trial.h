// SPDX-License-Identifier: Apache-2.0
// What light aimed at some pictures makes of them: many draws of every facet (thesis 5.2, "cost computation").
#pragma once
#include "base/state.h"
#include "inverse/thesis/sampler.h"

#include <cstdint>
#include <vector>

namespace nephroid::inverse {

/// What came of a trial.
struct Drawn {
  std::vector<std::vector<double>> light; ///< [receiver][cell]: mean of the draws, in facets
  std::vector<glm::dvec2> slopes;         ///< of each facet: its first draw; as if it were flat where it has none
  std::uint64_t dark = 0;                 ///< facets whose joint probability is 0 everywhere: they send light nowhere
};

/// The slopes behind facets that are all flat.
std::vector<glm::dvec2> flat_slopes(const Layout& layout);

class Trial {
public:
  /// layout and settings outlive it. The same aims and seed give the same draws, on any number of threads.
  Trial(const Layout& layout, const std::vector<Aim>& aims, const Thesis& settings, std::uint64_t seed);

  void advance(); ///< some facets
  bool finished() const { return next_ == layout_.facet_count(); }
  double part() const { return static_cast<double>(next_) / static_cast<double>(layout_.facet_count()); }
  std::size_t tried() const { return next_; } ///< facets
  Drawn drawn() const;

  void state(State& state); ///< loaded into a trial of the same aims

private:
  const Layout& layout_;
  const Thesis& settings_;
  std::uint64_t seed_;
  Sampler sampler_;
  // The state.
  std::size_t next_ = 0;
  std::vector<std::vector<std::uint32_t>> counts_; ///< [receiver][cell]
  std::vector<glm::dvec2> slopes_;
  std::uint64_t dark_ = 0;
};

} // namespace nephroid::inverse
