// SPDX-License-Identifier: Apache-2.0
// One picture by a smooth surface: where the light has to go, then heights whose slopes send it there.
#pragma once
#include "base/bytes.h"
#include "base/place.h"
#include "inverse/method.h"
#include "inverse/poisson.h"

namespace nephroid::inverse {

// Where light has to go so that one picture becomes another on the shortest ways: optimal transport, whose map is the gradient of a
// potential. So it is the one way that a smooth surface can bend light (Schwartzburg et al. 2014, "High-contrast computational caustic
// design").

/// The back-and-forth method (Jacobs and Leger 2020, "A fast approach to optimal transport"): steps along the gradient of the dual
/// problem, by turns in its two potentials, in the metric in which the gradient is a solution of Poisson's equation. Lengths are in parts
/// of the grid's longer side; both pictures are on the same grid of square cells and have the same sum.
class Transport {
public:
  Transport(Grid from, Grid to);

  void advance(); ///< a step in either potential
  /// Part of the light that the map of the last step did not bring to its cell.
  double astray() const { return astray_; }
  /// Where the light at p goes. p and the result are in cells from the first cell's corner.
  glm::dvec2 map(const glm::dvec2& p) const;

  glm::dvec2 cells() const { return {from_.cols(), from_.rows()}; } ///< across and down

  void state(State& state);

private:
  struct Side {
    Grid potential;
    double step = 1;
  };
  void move(Side& side, const Grid& wanted, const Grid& arrived, Side& other);
  double value() const; ///< of the dual problem

  Grid from_, to_; ///< densities over the domain whose area is the grid's
  double cell_;
  Poisson poisson_;
  // The state. psi is on the side of `from`.
  Side phi_, psi_;
  double astray_ = 1;
};

/// Light of `from` where x -> x - gradient(potential)(x) brings it. cell: side of a cell.
Grid pushed(const Grid& from, const Grid& potential, double cell);

/// min over y of |x - y|^2 / 2 - f(y), over the middles of cells.
Grid conjugate(const Grid& f, double cell);

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
