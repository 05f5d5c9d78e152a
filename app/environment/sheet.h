// SPDX-License-Identifier: Apache-2.0
// What a snapshot has of baked spheres: what they look like, E r^2 of each in latitude and longitude, as environments
// are (scene/environment.h).
#pragma once
#include "environment/bake/baker.h"
#include "job/job.h"

#include <memory>
#include <vector>

namespace nephroid::environment {

/// Which directions and spheres are shown.
struct Shown {
  std::vector<std::size_t> directions, spheres;
};

/// As many of each as fit into a sheet of this size, the first and the last among them, the others as far apart.
Shown choose_shown(const Bake& bake, int width, int height);

/// Radii from left to right, directions from top to bottom. 1: E r^2 is `white` times the square of the object's size;
/// grey: nothing. Directions that are not baked yet are black.
std::shared_ptr<const job::Picture> sheet(const Bake& bake, const Shown& shown, int width, int height, double white);

/// Of a baked direction: its shown spheres as layers, 512 x 256 pixels, and their sum.
std::shared_ptr<const job::Picture> spheres_picture(const Bake& bake, std::size_t direction,
                                                    const std::vector<std::size_t>& spheres, double white);

/// Both kinds of pictures of a bake, as far as it is.
class SpherePictures {
public:
  /// Makes what shows the directions that were baked since the last call. width, height, white: of the sheet.
  void update(const Bake& bake, int width, int height, double white);
  /// Null before the first update().
  const std::shared_ptr<const job::Picture>& all() const { return sheet_; }
  /// Of each direction that is shown and baked.
  const std::vector<job::NamedPicture>& directions() const { return directions_; }

private:
  std::shared_ptr<const job::Picture> sheet_; ///< of directions_
  std::vector<job::NamedPicture> directions_;
};

/// The curve "directions" and the scalars of a bake: how large it is, and where its light goes.
void add_figures(const Bake& bake, job::Snapshot& snapshot);

/// That all of spheres_picture take, at most.
std::uint64_t picture_bytes(const BakeTask& task);

} // namespace nephroid::environment
