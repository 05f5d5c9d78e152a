// SPDX-License-Identifier: Apache-2.0
// Direct assignment: facet after facet is taken away and put back where it serves the pictures most.
#pragma once
#include "inverse/assign/slope_search.h"
#include "inverse/method.h"

namespace nephroid::inverse {

/// The slopes of all facets at once, downhill: conjugate gradients (Polak and Ribiere) on weighted_squares(). Sweeps leave each facet at
/// the best place among the others; moving together, facets still gain. The number of threads changes no bit.
class Refinement {
public:
  /// weights: of a receiver's squares; heights: of the facets' middles. All but the weights outlive it.
  Refinement(const Layout& layout, const std::vector<Target>& targets, std::vector<double> weights, const std::vector<double>& heights);

  /// One step along a line; the sum gets smaller, or it is finished. light: [receiver][cell], of the slopes by their footprints.
  void advance(std::vector<glm::dvec2>& slopes, std::vector<std::vector<double>>& light);
  bool finished() const;
  double part() const;

  void state(State& state);

private:
  void find_gradient(const std::vector<glm::dvec2>& slopes, const std::vector<std::vector<double>>& light);
  double turn();

  const Layout& layout_;
  const std::vector<Target>& targets_;
  std::vector<double> weights_;
  const std::vector<double>& heights_;
  // The state.
  std::vector<glm::dvec2> gradient_, before_, direction_; ///< of each facet; before_: the gradient of the last step
  double step_ = 0;                                       ///< along the direction
  std::size_t done_ = 0;
  bool stuck_ = false;
};

/// Lowers weighted_squares(), and what smoothing adds to it (cost.h). A sweep goes through all facets in a random order, in batches of
/// a few: every facet of a batch looks for its slope at once, on as many threads as there are, among the light as it is before the batch;
/// then one after the other takes what it found if that is better than what it had. So no sweep makes the sum larger, and the number of
/// threads changes no bit. When a sweep gains less than a hundredth of the sum, the last one moves all facets together: see Refinement,
/// which knows no smoothing and is left out where there is some. Free heights follow the slopes after each sweep.
class Assignment final : public Method {
public:
  /// Facets that look for their slopes at once. More leave each other's choice out; fewer keep threads waiting.
  static constexpr std::size_t batch = 16;

  /// The layout and the targets outlive it. Facets begin with random slopes.
  Assignment(const Layout& layout, const std::vector<Target>& targets, std::uint64_t seed);

  /// One batch, or one step of the refinement.
  void advance() override;
  bool finished() const override { return refinement_ ? refinement_->finished() : converged_; }
  std::int64_t steps() const override { return sweeps_; }
  std::int64_t most() const override { return preset::default_passes; }
  double part() const override;
  std::uint64_t tried() const override { return tried_; }
  job::Units units() const override { return {.step = "sweep", .steps = "sweeps", .work = "facet", .works = "facets"}; }

  const std::vector<glm::dvec2>& slopes() const override { return slopes_; }
  std::vector<double> heights() const override { return heights_; }
  /// In facets that send all of their light.
  const std::vector<double>& light(std::size_t receiver) const override { return light_[receiver]; }
  double residual() const; ///< the sum
  std::vector<Cost> costs() const override;
  Solid solid() const override { return make_solid(layout_, slopes()); }
  /// The sweep in hand begins again.
  void relight() override;

  void state(State& state) override;

private:
  void begin_sweep();
  void settle();
  void put(std::size_t facet, double sign);
  void refine();
  double smoothing_weight() const;
  glm::dvec3 pull_on(std::size_t facet) const;
  double gain(std::size_t facet, const glm::dvec2& slope) const;
  std::vector<Lack> lacks_without(const std::vector<Lack>& lacks, std::size_t facet) const;
  glm::dvec2 look(std::size_t facet, const std::vector<Lack>& lacks) const;

  const Layout& given_;
  Layout layout_; ///< the same, but that facets see their neighbours as they are
  const std::vector<Target>& targets_;
  std::uint64_t seed_;
  std::vector<double> weights_;
  std::vector<double> heights_; ///< of the facets' middles; a state, too
  SlopeSearch search_;
  std::vector<std::uint32_t> order_; ///< of the sweep in hand
  // The state.
  std::vector<glm::dvec2> slopes_;
  std::vector<std::vector<double>> light_; ///< [receiver][cell]
  std::int64_t sweeps_ = 0;
  std::size_t next_ = 0; ///< in order_
  std::uint64_t tried_ = 0;
  double residual_ = 0;                  ///< before the sweep in hand
  bool converged_ = false;               ///< without refinement
  std::optional<Refinement> refinement_; ///< from when a sweep gained too little
};

} // namespace nephroid::inverse
