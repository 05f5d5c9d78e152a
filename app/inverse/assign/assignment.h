// SPDX-License-Identifier: Apache-2.0
// Direct assignment: facet after facet is taken away and put back where it serves the pictures most.
#pragma once
#include "inverse/assign/refinement.h"
#include "inverse/method.h"

namespace nephroid::inverse {

/// Lowers weighted_squares(), and what smoothing adds to it (cost.h), on the device. A sweep goes through all facets in
/// a random order, in batches. All facets of a batch look for their slopes at once, in the light before the batch. Each
/// takes what it found if that is better than what it had and if it shares no cell with a facet before it; the others
/// try again. So no batch raises the sum while pictures keep their tones, and the number of threads changes no bit.
/// When a sweep gains less than three hundredths of the sum, a last sweep moves all facets together (Refinement), which
/// knows no smoothing. Free heights, what facets see of their neighbours, and pictures' tones follow after each sweep.
class Assignment final : public Method {
public:
  /// The layout and the targets outlive it. Facets begin at random. Throws failed where the device lacks memory.
  Assignment(const mpi::RankContext& context, const Layout& layout, const std::vector<Target>& targets,
             std::uint64_t seed);

  /// Does one batch, or one step of the refinement.
  void advance() override;
  bool finished() const override { return refinement_ ? refinement_->finished() : converged_; }
  std::int64_t steps() const override { return sweeps_; }
  std::int64_t most() const override { return preset::default_passes; }
  double fraction_done() const override;
  std::uint64_t tried() const override { return tried_; }
  job::Units units() const override { return {.step = "sweep", .steps = "sweeps", .work = "facet", .works = "facets"}; }

  const std::vector<glm::dvec2>& slopes() const override;
  std::vector<double> heights() const override { return heights_; }
  /// In units of facets that send all of their light.
  const std::vector<double>& light(std::size_t receiver) const override { return all_light()[receiver]; }
  double residual() const; ///< the sum that sweeps lower
  std::vector<Cost> costs() const override;
  Solid solid() const override { return make_solid(given_, slopes()); }
  /// Begins the sweep in hand again.
  void relight() override;

  void serialize(Archive& archive) override;

private:
  void begin_sweep();
  void settle();
  void share_neighbours();
  void aim();
  void put(const std::vector<glm::dvec2>& slopes);
  void refine();
  double smoothing_weight() const;
  const std::vector<std::vector<double>>& all_light() const;
  void forget();

  const Layout& given_;
  Layout layout_; ///< given_, but with facets that see their neighbours as they are
  const std::vector<Target>& targets_;
  std::uint64_t seed_;
  std::vector<double> tones_;  ///< part of all light on each picture's receiver, at least a hundredth; in the state
  std::vector<Target> wanted_; ///< the targets in their tones
  std::vector<double> weights_;
  std::vector<double> heights_; ///< z of the facets' middles; in the state
  DeviceFacets facets_;         ///< in the state
  // The state.
  std::int64_t sweeps_ = 0;
  std::size_t next_ = 0; ///< place in the sweep's order
  std::uint64_t tried_ = 0;
  double residual_ = 0;                  ///< the sum before the sweep in hand
  bool converged_ = false;               ///< whether the search ended without refinement
  std::optional<Refinement> refinement_; ///< there once a sweep has gained too little

  mutable std::vector<glm::dvec2> slopes_;         ///< a copy of the device's; empty: not read yet
  mutable std::vector<std::vector<double>> light_; ///< a copy of the device's; empty: not read yet
};

} // namespace nephroid::inverse
