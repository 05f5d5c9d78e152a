// SPDX-License-Identifier: Apache-2.0
// The baked spheres in a snapshot: their E r^2 in latitude and longitude, as in scene/environment.h.
#pragma once
#include "environment/bake/baker.h"
#include "job/job.h"

#include <memory>
#include <vector>

namespace nephroid::environment {

struct Shown {
  std::vector<std::size_t> directions, spheres;
};

/// As many of each as fit into a sheet of this size: the first, the last and some evenly spaced between.
Shown choose_shown(const Bake& bake, int width, int height);

/// Radii go from left to right, directions from top to bottom. 1 stands for an E r^2 of `white` times the square of the
/// object's size. Unused places are grey. Directions that are not baked yet are black.
std::shared_ptr<const job::Picture> sheet(const Bake& bake, const Shown& shown, int width, int height, double white);

/// A baked direction's spheres `spheres` as layers of 512 x 256 pixels, and their sum.
std::shared_ptr<const job::Picture> spheres_picture(const Bake& bake, std::size_t direction,
                                                    const std::vector<std::size_t>& spheres, double white);

/// Both kinds of pictures of a bake so far.
class SpherePictures {
public:
  /// Adds the directions that were baked since the last call. width, height, white: the sheet's.
  void update(const Bake& bake, int width, int height, double white);
  /// Null before the first update().
  const std::shared_ptr<const job::Picture>& all() const { return sheet_; }
  /// A picture for each direction that is shown and baked.
  const std::vector<job::NamedPicture>& directions() const { return directions_; }

private:
  std::shared_ptr<const job::Picture> sheet_; ///< shows directions_
  std::vector<job::NamedPicture> directions_;
};

/// The curve "directions" and the scalars of a bake: how large it is, and where its light goes.
void add_figures(const Bake& bake, job::Snapshot& snapshot);

/// What all pictures of spheres_picture take at most.
std::uint64_t picture_bytes(const BakeTask& task);

} // namespace nephroid::environment
