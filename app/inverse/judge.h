// SPDX-License-Identifier: Apache-2.0
// The finished solid's own pictures: rays through its mesh, walls and all, by Snell's law, on the device (kernels/inverse/judge.cl).
#pragma once
#include "base/bytes.h"
#include "compute/compute.h"
#include "inverse/assign/cost.h"
#include "inverse/facets/solid.h"
#include "inverse/layout.h"
#include "kernels/inverse/facet_types.h"
#include "scene/bvh.h"

#include <cstdint>
#include <optional>
#include <vector>

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

struct Ray {
  glm::dvec3 from{0}, direction{0, 0, -1};
};

/// Follows rays that start in front of the object. Light is refracted, less Fresnel's reflectance; total reflection is followed. The
/// object's sides are black: a frame holds them, or a saw has left them rough.
std::vector<WayOut> follow(const compute::Context& context, const Solid& solid, double n, const std::vector<Ray>& rays);

/// What kernels need of a solid.
struct SolidOnDevice {
  SolidOnDevice() = default;
  /// spreads: light has a width, or a band of wavelengths. Throws failed where the device has not enough memory.
  SolidOnDevice(const compute::Context& context, const Solid& solid, bool spreads);

  compute::Buffer<float> nodes, blocks;
  compute::Buffer<shared::float4> normals; ///< of each triangle; w: its part
  int root = 0;
  std::optional<compute::Program> program; ///< inverse/judge.cl
};

/// What falls on the facets of such an object.
std::uint64_t rays_of(const Layout& layout);

/// Rays fall evenly on all facets, a jittered lattice on each. The same seed gives the same bits on any number of threads.
class Judge {
public:
  /// layout outlives it. Throws as SolidOnDevice.
  Judge(const compute::Context& context, const Layout& layout, const Solid& solid, std::uint64_t seed);

  void advance(); ///< a few rows of facets; light and fates are there once it has finished
  bool finished() const { return row_ >= layout_.facets.y; }
  double part() const { return static_cast<double>(row_) / layout_.facets.y; }
  const std::vector<double>& light(std::size_t receiver) const { return light_[receiver]; } ///< of each cell, in what falls on a facet
  const std::vector<double>& frame(std::size_t i) const { return light_[layout_.distances.size() + i]; } ///< the same of layout.frames
  Fates fates() const;
  std::vector<Cost> costs(const std::vector<Target>& targets) const; ///< of each receiver

  void state(State& state);

private:
  void read_sums();

  compute::Context context_;
  const Layout& layout_;
  SolidOnDevice solid_;
  shared::uint2 seed_;
  shared::DeviceFront front_{};
  compute::Buffer<float> indices_, distances_; ///< distances of the screens: the receivers', then the frames'
  compute::Buffer<std::int64_t> light_on_screens_, fates_;
  compute::Kernel judge_;
  int row_ = 0;
  Fates sum_;                              ///< in facets; of all rows
  std::vector<std::vector<double>> light_; ///< [screen][cell], in facets; of all rows
};

} // namespace nephroid::inverse
