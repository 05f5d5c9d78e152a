// SPDX-License-Identifier: Apache-2.0
// Direct assignment: facet after facet is taken away and put back where it serves the pictures most.
#pragma once
#include "inverse/assign/refinement.h"
#include "inverse/method.h"
#include "mpi/rank_context.h"

#include <optional>

namespace nephroid::inverse {

/// Lowers weighted_squares(), and what smoothing adds to it (cost.h), on the device. A sweep goes through all facets in
/// a random order, in batches: every facet of a batch looks for its slope at once, among the light as it is before the
/// batch. Then those take what they found that share no cell with a facet before them, if it is better than what they
/// had, and the others try again. So no batch makes the sum larger while pictures have their tones, and the number of
/// threads changes no bit. When a sweep gains less than three hundredths of the sum, the last one moves all facets
/// together: see Refinement, which knows no smoothing and is left out where there is some. Free heights, what facets
/// see of their neighbours, and the pictures' tones follow the slopes after each sweep.
class Assignment final : public Method {
public:
  /// The layout and the targets outlive it. Facets begin with random slopes. Throws failed where the device has not
  /// enough memory.
  Assignment(const mpi::RankContext& context, const Layout& layout, const std::vector<Target>& targets,
             std::uint64_t seed);

  /// One batch, or one step of the refinement.
  void advance() override;
  bool finished() const override { return refinement_ ? refinement_->finished() : converged_; }
  std::int64_t steps() const override { return sweeps_; }
  std::int64_t most() const override { return preset::default_passes; }
  double fraction_done() const override;
  std::uint64_t tried() const override { return tried_; }
  job::Units units() const override { return {.step = "sweep", .steps = "sweeps", .work = "facet", .works = "facets"}; }

  const std::vector<glm::dvec2>& slopes() const override;
  std::vector<double> heights() const override { return heights_; }
  /// In facets that send all of their light.
  const std::vector<double>& light(std::size_t receiver) const override { return all_light()[receiver]; }
  double residual() const; ///< the sum
  std::vector<Cost> costs() const override;
  Solid solid() const override { return make_solid(layout_, slopes()); }
  /// The sweep in hand begins again.
  void relight() override;

  void state(State& state) override;

private:
  void begin_sweep();
  void settle();
  void aim();
  void put(const std::vector<glm::dvec2>& slopes);
  void refine();
  double smoothing_weight() const;
  const std::vector<std::vector<double>>& all_light() const;
  void forget();

  const Layout& given_;
  Layout layout_; ///< the same, but that facets see their neighbours as they are
  const std::vector<Target>& targets_;
  std::uint64_t seed_;
  std::vector<double>
      tones_; ///< of each picture: the part of all light that reaches its receiver, at least a hundredth; a state, too
  std::vector<Target> wanted_; ///< targets in their tones
  std::vector<double> weights_;
  std::vector<double> heights_; ///< of the facets' middles; a state, too
  DeviceFacets facets_;         ///< a state, too
  // The state.
  std::int64_t sweeps_ = 0;
  std::size_t next_ = 0; ///< in the sweep's order
  std::uint64_t tried_ = 0;
  double residual_ = 0;                  ///< before the sweep in hand
  bool converged_ = false;               ///< without refinement
  std::optional<Refinement> refinement_; ///< from when a sweep gained too little

  mutable std::vector<glm::dvec2> slopes_;         ///< as on the device; empty: not read yet
  mutable std::vector<std::vector<double>> light_; ///< the same
};

} // namespace nephroid::inverse
