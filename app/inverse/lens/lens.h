// SPDX-License-Identifier: Apache-2.0
// One picture by a smooth surface: where the light has to go, then heights whose slopes send it there.
#pragma once
#include "base/place.h"
#include "inverse/lens/transport.h"
#include "inverse/method.h"

namespace nephroid::inverse {

/// For one receiver and light along -z. Steps are those of Transport; the surface is made after each.
class Lens final : public Method {
public:
  /// The layout and the target outlive it. settings: where they stand, for what solid() refuses.
  Lens(const Layout& layout, const Target& target, Place settings);

  void advance() override;
  /// Ten steps brought no less light astray.
  bool finished() const override { return steps_ - best_step_ >= 10; }
  std::int64_t steps() const override { return steps_; }
  std::int64_t most() const override { return 100; }
  double part() const override { return 0; }
  std::uint64_t tried() const override { return static_cast<std::uint64_t>(steps_) * layout_.facet_count(); }
  job::Units units() const override { return {.step = "step", .steps = "steps", .work = "facet", .works = "facets"}; }

  const std::vector<glm::dvec2>& slopes() const override { return slopes_; }
  std::vector<double> heights() const override;
  const std::vector<double>& light(std::size_t) const override { return light_.front(); }
  std::vector<Cost> costs() const override;
  Solid solid() const override;
  void show(job::Snapshot& made) const override;

  void state(State& state) override;

private:
  void make_surface();
  glm::dvec2 goal(const glm::dvec2& p) const;

  const Layout& layout_;
  const Target& target_;
  Place settings_;
  glm::dvec2 domain_; ///< size of the grid in millimetres, centred as the object and the receiver are
  Transport transport_;
  Poisson heights_of_;
  // The state, and what follows from it.
  std::int64_t steps_ = 0, best_step_ = 0;
  double best_ = 1;
  Grid heights_; ///< of the facets' corners, millimetres
  std::vector<glm::dvec2> slopes_;
  std::vector<std::vector<double>> light_; ///< of the one receiver
};

} // namespace nephroid::inverse
