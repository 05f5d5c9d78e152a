// SPDX-License-Identifier: Apache-2.0
// The search for slopes: a method's steps, until it gains no more or the preset's stop, less what the judge needs.
#pragma once
#include "inverse/method.h"

namespace nephroid::inverse {

class Search {
public:
  /// The solid has about so many triangles. preset, layout and targets outlive the search.
  Search(const preset::Preset& preset, const Layout& layout, const std::vector<Target>& targets,
         std::uint64_t triangles, const mpi::RankContext& context);

  const Method& method() const { return *method_; }
  /// Where seconds end the search, this asks how long the judge takes. Every rank gets the same answer.
  bool is_over();
  /// Does a short piece of work. Returns true where a step is complete now.
  bool advance();

  /// Counts the stop from here and keeps the facets' slopes, after the preset, the layout and the targets have changed.
  void go_on();

  double seconds() const { return seconds_; }
  void add_seconds(double seconds) { seconds_ += seconds; }
  /// The part of the stop that is done, 0..1.
  double fraction_done() const;
  /// The step that ends the search; -1: time ends it.
  std::int64_t last_step() const { return most_steps() ? began_.steps + *most_steps() : -1; }
  /// Whether neither the method nor the stop's passes ended it.
  bool has_steps_left() const {
    return !method_->finished() && !(most_steps() && method_->steps() - began_.steps >= *most_steps());
  }

  /// Adds the curve "cost", and the figures that the method alone has.
  void show(job::Snapshot& snapshot) const;

  /// Two parts of a state; the job's own part stands between them.
  void state_of_method(Archive& archive);
  void state_of_count(Archive& archive);

private:
  /// Where the stop counts from: the run's begin, or the newest preset that it adopted.
  struct Began {
    std::int64_t steps = 0;
    double seconds = 0;
  };
  struct CostRow {
    double step = 0, seconds = 0;
    Cost cost;
  };

  void note_step();
  double counted_seconds() const { return seconds_ - began_.seconds; }
  double search_seconds() const;
  double last_step_seconds() const;
  std::optional<std::int64_t> most_steps() const;

  mpi::RankContext context_;
  const preset::Preset& preset_;
  const Layout& layout_;
  std::uint64_t triangles_;
  std::unique_ptr<Method> method_;
  Began began_;
  std::vector<CostRow> history_;
  double seconds_ = 0;
  std::optional<double> judge_needs_; ///< seconds; known from the first step on where time ends the run
};

} // namespace nephroid::inverse
