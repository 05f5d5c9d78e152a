// SPDX-License-Identifier: Apache-2.0
// What a run judges, and how much worse the pictures are where the object is made or put up a little wrong.
#pragma once
#include "inverse/judge.h"

namespace nephroid::inverse {

/// Judges the object with one error at a time: heights that are off by 1, 5 and 20 micrometres, the object turned by a
/// degree about a level line through its middle, the light turned by a degree about an upright one, and receivers that
/// are 1 % too far. Milling and polishing leave heights off in waves along the surface, wave_mm long; the figure is
/// their root mean square.
class Tolerances {
public:
  static constexpr int count = 6; ///< the number of errors

  /// The arguments outlive it.
  Tolerances(const mpi::RankContext& context, const Layout& layout, const std::vector<Target>& targets,
             const Solid& solid, std::uint64_t seed);

  /// Judges a few rows of facets.
  void advance();
  bool finished() const;
  double fraction_done() const;

  struct Row {
    std::string_view what;
    std::vector<Cost> costs; ///< a cost for each receiver
  };
  const std::vector<Row>& rows() const { return rows_; } ///< the errors judged so far

  void serialize(Archive& archive);

private:
  void begin();

  mpi::RankContext context_;
  const Layout& layout_;
  const std::vector<Target>& targets_;
  const Solid& solid_;
  std::uint64_t seed_;
  std::vector<Row> rows_;
  Layout changed_layout_; ///< the layout with the error in hand; its solid and judge follow
  Solid changed_;
  std::optional<Judge> judge_;
};

/// Length of the waves on the surface. Machines leave waviness that is 0.8 to 8 mm long.
inline constexpr double wave_mm = 5;

/// How often each triangle is cut into four, so that those of wide facets can follow the waves.
int halvings(const Layout& layout);

/// Cuts triangles and moves the surface, but for the flat front, along z in waves of this root mean square.
Solid with_waves(const Layout& layout, Solid solid, double rms_mm, std::uint64_t seed);

/// A section of workshop.md, and the same figures as CSV. `judged` has the costs without errors.
std::string tolerance_table(const std::vector<Cost>& judged, const std::vector<Tolerances::Row>& rows);
std::string tolerance_csv(const std::vector<Cost>& judged, const std::vector<Tolerances::Row>& rows);

/// What becomes of slopes once they are found: the solid, its judge, and where asked for its tolerances.
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

  void serialize(Archive& archive) {
    judge_.serialize(archive);
    if (tolerances_) tolerances_->serialize(archive);
  }

private:
  std::shared_ptr<const Solid> solid_;
  Judge judge_;
  std::optional<Tolerances> tolerances_;
};

} // namespace nephroid::inverse
