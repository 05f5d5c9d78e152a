// SPDX-License-Identifier: Apache-2.0
// The finished solid's own pictures: rays through its mesh, walls and all, by Snell's law, on the device
// (kernels/inverse/judge.cl).
#pragma once
#include "base/bytes.h"
#include "check/check.h"
#include "compute/compute.h"
#include "inverse/assign/cost.h"
#include "inverse/facets/solid.h"
#include "inverse/layout.h"
#include "kernels/inverse/facet_types.h"
#include "mpi/rank_context.h"
#include "scene/bvh.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace nephroid::inverse {

/// Where the light goes that falls on the front; reflected, lost and sent sum to 1, for a lamp but for noise.
struct RayOutcomes {
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

/// Follows rays that start in front of the object. Light is refracted, less Fresnel's reflectance; total reflection is
/// followed. The object's sides are black: a frame holds them, or a saw has left them rough.
std::vector<WayOut> follow(const compute::Context& context, const Solid& solid, double n, const std::vector<Ray>& rays);

/// What kernels need of a solid.
struct SolidOnDevice {
  SolidOnDevice() = default;
  /// spreads: light has a width, or many wavelengths. Throws failed where the device has not enough memory.
  SolidOnDevice(const compute::Context& context, const Solid& solid, bool spreads, bool coloured);

  compute::Buffer<float> nodes, blocks;
  compute::Buffer<shared::float4> normals; ///< of each triangle; w: its part
  int root = 0;
  std::optional<compute::Program> program; ///< inverse/judge.cl
};

/// What falls on the facets of such an object in a round.
std::uint64_t rays_of(const Layout& layout);

/// Rays fall evenly on all facets, a jittered lattice on each, in rounds. Rounds are drawn apart, so that what those of
/// even and odd number differ by is noise. Of a spectrum, each ray of a facet has another part. The same seed gives the
/// same bits on any number of threads.
class Judge {
public:
  /// layout and targets outlive it. Two rounds, about four million rays. Where noise is then more than a third of what
  /// a figure of these targets says, two more. Throws as SolidOnDevice.
  Judge(const mpi::RankContext& context, const Layout& layout, const Solid& solid, std::uint64_t seed,
        const std::vector<Target>& targets = no_targets);

  void advance(); ///< a few rows of facets; light and outcomes are there once it has finished
  bool finished() const { return finished_; }
  double fraction_done() const; ///< of the rounds that it knows of
  /// What counts in each cell, in what falls on a facet: luminance of coloured light, else energy.
  const std::vector<double>& light(std::size_t receiver) const { return light_[receiver]; }
  const std::vector<double>& frame(std::size_t i) const {
    return light_[layout_.distances.size() + i];
  } ///< the same of layout.frames
  /// XYZ of each cell, y being light(). Of coloured light; screens are the receivers, then the frames.
  std::vector<glm::dvec3> colours(std::size_t screen) const;
  RayOutcomes outcomes() const;
  std::vector<Cost> costs(const std::vector<Target>& targets) const; ///< of each receiver
  /// How much of each figure is noise: without it, it would be the root of the difference of the squares.
  std::vector<Cost> noise(const std::vector<Target>& targets) const;

  void state(State& state);

private:
  static inline const std::vector<Target> no_targets{};

  void judge_rows(std::uint32_t first, std::uint32_t count, std::uint32_t turn);
  void end_pair(); ///< of rounds
  void read_sums();

  mpi::RankContext context_;
  const Layout& layout_;
  const std::vector<Target>& targets_;
  SolidOnDevice solid_;
  shared::uint2 seed_;
  shared::DeviceFront front_{};
  compute::Buffer<shared::float4> parts_;           ///< of the spectrum: index and XYZ
  compute::Buffer<shared::DeviceReceiver> screens_; ///< the receivers, then the frames
  std::array<compute::Buffer<std::int64_t>, 2>
      light_on_screens_; ///< of even and of odd rounds: [screen][y, x, z][cell]
  compute::Buffer<std::int64_t> outcomes_;
  compute::Kernel judge_;
  int row_ = 0, round_ = 0;
  bool finished_ = false;
  RayOutcomes sum_;                                        ///< in facets; of all rows and rounds
  std::vector<std::vector<double>> light_;                 ///< [screen][cell], in facets
  std::array<std::vector<std::vector<double>>, 2> halves_; ///< the same of even and odd rounds
};

/// Closed forms, for `nephroid check`.
check::Checks closed_forms();

} // namespace nephroid::inverse
