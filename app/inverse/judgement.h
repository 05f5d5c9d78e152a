// SPDX-License-Identifier: Apache-2.0
// What becomes of slopes once they are found: the solid, its judge, and where asked for the same with errors of making.
#pragma once
#include "inverse/tolerances.h"

namespace nephroid::inverse {

class Judgement {
public:
  /// preset, context, layout and targets outlive it. Throws as Judge.
  Judgement(const preset::Preset& preset, const mpi::RankContext& context, const Layout& layout,
            const std::vector<Target>& targets, Solid solid)
      : solid_(std::make_shared<const Solid>(std::move(solid))),
        judge_(context, layout, *solid_, preset.seed, targets) {
    if (settings(preset).tolerances) tolerances_.emplace(context, layout, targets, *solid_, preset.seed);
  }

  void advance() { is_judged() ? tolerances_->advance() : judge_.advance(); } ///< judges a few rows of facets
  bool is_judged() const { return judge_.finished(); }
  bool finished() const { return is_judged() && (!tolerances_ || tolerances_->finished()); }
  /// The part done, 0..1; each error of the tolerances counts as much as the object itself.
  double fraction_done() const {
    return tolerances_
               ? (judge_.fraction_done() + Tolerances::count * tolerances_->fraction_done()) / (1 + Tolerances::count)
               : judge_.fraction_done();
  }

  const std::shared_ptr<const Solid>& solid() const { return solid_; }
  /// The judge, whose light is there once is_judged().
  const Judge& judge() const { return judge_; }
  /// Empty where the preset asks for no tolerances.
  const std::optional<Tolerances>& tolerances() const { return tolerances_; }

  void state(State& state) {
    judge_.state(state);
    if (tolerances_) tolerances_->state(state);
  }

private:
  std::shared_ptr<const Solid> solid_;
  Judge judge_;
  std::optional<Tolerances> tolerances_;
};

} // namespace nephroid::inverse
