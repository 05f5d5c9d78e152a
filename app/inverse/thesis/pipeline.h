// SPDX-License-Identifier: Apache-2.0
// The thesis' pipeline (chapter 5): draws from the pictures' joint probability, two annealings, intensity correction.
#pragma once
#include "inverse/method.h"
#include "inverse/thesis/adjust.h"

namespace nephroid::inverse {

// Simulated annealing of a few numbers, as the thesis has it: cycles of moves at one temperature, each cycle colder.

struct AnnealedParameter {
  double start = 0, step = 0.1; ///< a move changes it by up to `step` either way
  double low = 0, high = 1;     ///< the value stays between these
};

struct Cooling {
  double temperature = 0.005; ///< that of the first cycle, in cost: Boltzmann's constant is 1
  double factor = 0.5;
  int cycles = 10, moves = 10; ///< cycles, and moves of each
};

class Annealer {
public:
  /// `cost` is that at the knobs' starts.
  Annealer(std::vector<AnnealedParameter> knobs, const Cooling& cooling, double cost);

  bool finished() const { return done_ >= std::int64_t{cooling_.cycles} * cooling_.moves; }
  double temperature() const; ///< that of the move in hand
  /// Moves all knobs at once. The same random numbers propose the same values.
  const std::vector<double>& propose(std::mt19937_64 random);
  /// Takes a cost that is no higher, else with probability exp(-rise / temperature). Returns whether it is the lowest.
  bool decide(double cost);

  const std::vector<double>& lowest() const { return lowest_; } ///< the values with the lowest cost
  double lowest_cost() const { return lowest_cost_; }
  std::int64_t accepted() const { return accepted_; }
  std::int64_t refused() const { return done_ - accepted_; }

  void serialize(Archive& archive);

private:
  std::vector<AnnealedParameter> knobs_;
  Cooling cooling_;
  std::vector<double> proposed_;
  double chance_ = 0; ///< the proposal's random number, 0..1
  // The state.
  std::vector<double> values_, lowest_;
  double cost_ = 0, lowest_cost_ = 0;
  std::int64_t done_ = 0, accepted_ = 0;
};

/// A step is a trial: it draws all facets and takes their cost (5.2) against the adjusted pictures, at first the
/// pictures themselves. A stage ends with the values of its lowest cost, whose first draw the object gets. Trials share
/// random numbers, so that a cost depends only on what is tried. Facets send light from their middles and all alike.
class Pipeline final : public Method {
public:
  /// The layout and the targets outlive it. Facets begin flat.
  Pipeline(const Layout& layout, const std::vector<Target>& targets, const Thesis& settings, std::uint64_t seed);

  void advance() override;
  bool finished() const override { return stage_ == Stage::done; }
  std::int64_t steps() const override { return trials_; }
  std::int64_t most() const override { return trials_of(settings_); }
  double fraction_done() const override { return trial_ ? trial_->fraction_done() : 0; }
  std::uint64_t tried() const override;
  job::Units units() const override { return {.step = "trial", .steps = "trials", .work = "facet", .works = "facets"}; }

  const std::vector<glm::dvec2>& slopes() const override { return best_.slopes; }
  std::vector<double> heights() const override { return std::vector<double>(layout_.facet_count()); }
  const std::vector<double>& light(std::size_t receiver) const override { return light_[receiver]; }
  std::vector<Cost> costs() const override;
  Solid solid() const override { return make_solid(layout_, slopes()); }
  void show(job::Snapshot& snapshot) const override;

  void serialize(Archive& archive) override;

  /// The trials of all stages, at most.
  static std::int64_t trials_of(const Thesis& settings);

private:
  enum class Stage : std::int32_t { sampling, annealing_1, annealing_2, correction, done };
  static constexpr std::size_t stages = 4;
  struct Row {
    double stage = 0, temperature = 0, cost = 0, lowest = 0, accepted = 0, refused = 0;
  };

  void begin_trial();
  void end_trial();
  void begin_next_stage();
  bool stage_ended() const;
  std::optional<Annealer> annealer() const;
  void adjust(const std::vector<double>& values);
  void find_needs();
  void correct(const std::vector<std::vector<double>>& received);
  std::vector<SamplingTarget> aims() const;
  double cost_of_drawn(const TrialResult& drawn) const;
  void keep(TrialResult drawn, double cost);

  const Layout& layout_;
  const std::vector<Target>& targets_;
  Thesis settings_;
  std::uint64_t seed_;
  // What is tried.
  std::vector<SamplingTarget> wanted_; ///< D: in the first annealing the proposal, later what that found
  std::vector<Margin> margins_;        ///< margins of wanted_, from the second annealing on
  std::vector<MissingLight> needs_;    ///< needs of wanted_, from the second annealing on
  std::optional<Trial> trial_;
  // The state.
  Stage stage_ = Stage::sampling;
  std::int64_t trials_ = 0;
  std::optional<Annealer> annealer_;
  std::vector<double> sizes_; ///< what the first annealing found
  std::vector<double> reach_; ///< k and o of all pictures: the proposal, later what the second annealing found
  std::vector<std::vector<double>> pictures_; ///< light's aims before they are extended: wanted_, later corrected
  std::int64_t rounds_ = 0, idle_ = 0;        ///< rounds of the correction: done, and without a gain
  TrialResult best_;
  double lowest_ = 1;                  ///< the cost of best_
  std::array<double, stages> costs_{}; ///< the lowest cost of each stage
  std::vector<Row> history_;
  std::vector<std::vector<double>> light_; ///< the light of best_'s slopes, by their footprints
};

} // namespace nephroid::inverse
