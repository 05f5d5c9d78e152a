// SPDX-License-Identifier: Apache-2.0
// The finished solid's own pictures: rays through its mesh, walls and all, by Snell's law in double precision.
#pragma once
#include "base/bytes.h"
#include "inverse/assign/cost.h"
#include "inverse/facets/solid.h"
#include "inverse/layout.h"
#include "scene/bvh.h"

namespace nephroid::inverse {

/// Where the light goes that falls on the front; reflected, lost and sent sum to 1, for a lamp but for noise.
struct Fates {
  double reflected = 0; ///< by a surface that lets some of it through, the front first; it is not followed
  double lost = 0;      ///< on the object's sides, backwards, or after too many surfaces
  double sent = 0;      ///< forward, to the receivers and beside them
  double by_walls = 0;  ///< of `sent`, what met a wall between facets
};

/// A ray's way out.
struct WayOut {
  glm::dvec3 from{0}, direction{0, 0, -1};
  double part = 0; ///< of its light; 0: lost
  double reflected = 0;
  bool met_wall = false;
};

/// Follows a ray that starts in front of the object. Light is refracted, less Fresnel's reflectance; total reflection is followed. The
/// object's sides are black: a frame holds them, or a saw has left them rough.
WayOut follow(const Solid& solid, const scene::Bvh& bvh, double n, glm::dvec3 from, glm::dvec3 direction);

/// Rays fall evenly on all facets, a jittered lattice on each. The same seed gives the same bits on any number of threads.
class Judge {
public:
  /// layout and solid outlive it.
  Judge(const Layout& layout, const Solid& solid, std::uint64_t seed);

  void advance(); ///< a few rows of facets
  bool finished() const { return row_ >= layout_.facets.y; }
  double part() const { return static_cast<double>(row_) / layout_.facets.y; }
  const std::vector<double>& light(std::size_t receiver) const { return light_[receiver]; } ///< of each cell, in what falls on a facet
  const std::vector<double>& frame(std::size_t i) const { return light_[layout_.distances.size() + i]; } ///< the same of layout.frames
  Fates fates() const;
  std::vector<Cost> costs(const std::vector<Target>& targets) const; ///< of each receiver

  void state(State& state);

private:
  struct Row;
  Row trace_row(int row) const;

  const Layout& layout_;
  const Solid& solid_;
  scene::Bvh bvh_;
  std::uint64_t seed_;
  int row_ = 0;
  Fates sum_;                              ///< of the rows so far, in facets
  std::vector<double> screens_;            ///< distances: the receivers', then the frames'
  std::vector<std::vector<double>> light_; ///< [screen][cell], in facets
};

} // namespace nephroid::inverse
