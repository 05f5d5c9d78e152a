// SPDX-License-Identifier: Apache-2.0
// One picture by a smooth surface: where light has to go, heights that send it there, then what these lack put right.
#pragma once
#include "inverse/facets/smooth_solid.h"
#include "inverse/lens/transport.h"
#include "inverse/method.h"

#include <limits>

namespace nephroid::inverse {

/// Designs a lens for one receiver. The first step is the optimal transport and the surface that follows from it. Each
/// further one lets the surface's light flow from where there is too much, by a solution of Poisson's equation.
class Lens final : public Method {
public:
  /// The layout and the target outlive it. Without a mesh_error it is default_mesh_error(). `settings` is where the
  /// settings stand, for what solid() refuses.
  Lens(const Layout& layout, const Target& target, std::optional<double> mesh_error, Location settings);

  void advance() override;
  bool finished() const override { return stale_ >= most_stale; }
  std::int64_t steps() const override { return steps_; }
  std::int64_t most() const override { return 60; }
  double fraction_done() const override;
  std::uint64_t tried() const override { return static_cast<std::uint64_t>(steps_) * layout_.facet_count(); }
  job::Units units() const override { return {.step = "step", .steps = "steps", .work = "facet", .works = "facets"}; }

  const std::vector<glm::dvec2>& slopes() const override { return slopes_; }
  std::vector<double> heights() const override;
  double relief() const { return 2 * reach(); } ///< from the lowest of the facets' corners to the highest
  const std::vector<double>& light(std::size_t) const override { return light_; }
  std::vector<Cost> costs() const override { return {cost_of(target_, light_, sent_)}; }
  Solid solid() const override;
  const Surface& surface() const { return surface_; }
  double mesh_error() const { return mesh_error_.value_or(default_mesh_error(costs().front().rel_l2)); }
  void show(job::Snapshot& made) const override;

  void serialize(Archive& archive) override;

  static std::uint64_t bytes(const Layout& layout); ///< memory of fine grids, about

private:
  /// After this many corrections in a row that gain too little, no more follow.
  static constexpr std::int64_t most_stale = 2;

  void aim();
  void correct();
  glm::dvec2 fine_cell() const { return domain_ / glm::dvec2(wanted_.cols(), wanted_.rows()); }
  glm::dvec2 from_corner(const glm::dvec2& p) const;
  glm::dvec2 drawn(const glm::dvec2& p) const;
  Grid wanted_of(const Target& target) const;
  std::vector<double> sharp_light() const;
  glm::dvec2 goal(const glm::dvec2& p) const;
  glm::dvec2 landing(const glm::dvec2& p, const Surface::At& at) const;
  Grid bent(const std::function<glm::dvec2(const glm::dvec2&, const Surface::At&)>& goal) const;
  void set_heights(Grid heights);
  void see();
  std::vector<glm::dvec2> corners_land() const;
  glm::dvec2 lowest_highest(const Grid& heights) const;
  double reach() const { return lowest_highest(heights_).y; }

  const Layout& layout_;
  const Target& target_;
  std::optional<double> mesh_error_;
  Location settings_;
  glm::dvec2 domain_; ///< size of the grid in millimetres, about the middle of the object, and of the receiver
  Layout fine_;       ///< the layout with facets in parts, whose light is that of the surface
  Transport transport_;
  /// What the lens aims at: the target, or, far away, what a lamp's size makes of that; and that of the best heights.
  Target aim_, best_aim_;
  Grid wanted_; ///< the aim on the finest grid
  Poisson heights_of_, flow_of_;
  // The state, and what follows from it.
  int moved_ = 0; ///< completed steps of the transport
  std::int64_t steps_ = 0, stale_ = 0;
  double share_ = 1;                                      ///< the share of a correction that is carried out
  double best_ = std::numeric_limits<double>::infinity(); ///< the least error of a surface
  Grid heights_, best_heights_;                           ///< z of the facets' corners, millimetres
  Surface surface_;
  std::vector<glm::dvec2> slopes_;
  std::vector<double> light_; ///< the light on the receiver, in facets
  Grid sent_by_;              ///< the light that each part of a facet sends, in facets
  double sent_ = 0;
};

} // namespace nephroid::inverse
