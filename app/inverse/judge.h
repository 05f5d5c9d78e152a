// SPDX-License-Identifier: Apache-2.0
// The finished solid's own pictures: rays through its mesh, by Snell's law, on the device (kernels/inverse/judge.cl).
#pragma once
#include "base/bytes.h"
#include "check/check.h"
#include "inverse/assign/cost.h"
#include "inverse/facets/solid.h"
#include "kernels/inverse/facet_types.h"
#include "mpi/rank_context.h"
#include "scene/bvh.h"

namespace nephroid::inverse {

/// Where the light that falls on the front goes. `reflected`, `lost` and `sent` sum to 1. For a lamp that is true apart
/// from noise, and for one of some size nearly, because its places see the front otherwise than its middle does.
struct RayOutcomes {
  double reflected = 0; ///< by a surface that lets some of it through, the front first; it is not followed
  double lost = 0;      ///< on the object's sides, backwards, or after too many surfaces
  double sent = 0;      ///< forward, to the receivers and beside them
  double by_walls = 0;  ///< the part of `sent` that met a wall between facets
};

/// How a ray leaves the object.
struct WayOut {
  glm::dvec3 from{0}, direction{0, 0, -1};
  double part = 0; ///< the part of the ray's light that leaves; 0: lost
  double reflected = 0;
  bool met_wall = false;
};

struct Ray {
  glm::dvec3 from{0}, direction{0, 0, -1};
};

/// Follows rays that start in front of the object. Light is refracted, less Fresnel's reflectance; total reflection is
/// followed. A mirror, n < 0, sends back all light. The object's sides are black: a frame holds them, or a saw has left
/// them rough.
std::vector<WayOut> follow(const compute::Context& context, const Solid& solid, double n, const std::vector<Ray>& rays);

/// The parts of a solid that kernels need.
struct SolidOnDevice {
  SolidOnDevice() = default;
  /// `more`: what rays do besides, as defines of inverse/judge.cl. Throws failed where the device has not enough
  /// memory.
  SolidOnDevice(const compute::Context& context, const Solid& solid, const compute::Defines& more);

  compute::Buffer<float> nodes, blocks;
  compute::Buffer<shared::float4> normals; ///< a triangle's unit normal, and its part as w
  int root = 0;
  std::optional<compute::Program> program; ///< inverse/judge.cl
};

/// How many rays fall on the facets of such an object in a round.
std::uint64_t rays_of(const Layout& layout);

/// Judges by rays that fall evenly on all facets, a jittered lattice on each, in rounds. The difference between even
/// and odd rounds is noise. With a spectrum each ray of a facet has another part of it.
class Judge {
public:
  /// layout and targets outlive the judge. It takes two rounds, about four million rays, and two more where noise is
  /// over a third of a figure of these targets. Throws as SolidOnDevice.
  Judge(const mpi::RankContext& context, const Layout& layout, const Solid& solid, std::uint64_t seed,
        const std::vector<Target>& targets = no_targets);

  void advance(); ///< judges a few rows of facets; light and outcomes are there once it has finished
  bool finished() const { return finished_; }
  double fraction_done() const; ///< the part done of the rounds that are planned so far
  /// Each cell's luminance, or energy without colours, in facets' incident light. Screens: receivers, then frames, each
  /// in its own light; a frame's is between those of the receivers before and behind it.
  const std::vector<double>& light(std::size_t screen) const { return light_[screen]; }
  /// A receiver in another's light.
  const std::vector<double>& light_under(std::size_t receiver, std::size_t other) const {
    return lights_[lamp_of(other)].light[receiver];
  }
  /// The XYZ of each cell of coloured light; y is light().
  std::vector<glm::dvec3> colours(std::size_t screen) const;
  RayOutcomes outcomes() const;                                      ///< the mean over the receivers' lights
  std::vector<Cost> costs(const std::vector<Target>& targets) const; ///< a cost for each receiver
  /// The noise in each figure. Without it, a figure would be the root of the difference of the squares.
  std::vector<Cost> noise(const std::vector<Target>& targets) const;

  void serialize(Archive& archive);

private:
  static inline const std::vector<Target> no_targets{};

  /// One light, and what it casts on some screens.
  struct OneLight {
    shared::DeviceFront front{};
    std::vector<std::size_t> screens;                  ///< numbers among the judge's
    compute::Buffer<shared::DeviceReceiver> receivers; ///< the same
    compute::Buffer<shared::float4> lamp_places;       ///< Illumination::lamp_places
    std::array<compute::Buffer<std::int64_t>, 2> sums; ///< even and odd rounds: [screen][y, x, z][cell]
    compute::Buffer<std::int64_t> outcomes;
    RayOutcomes sum;                                        ///< in facets; over all rows and rounds
    std::vector<std::vector<double>> light;                 ///< [screen][cell], in facets
    std::array<std::vector<std::vector<double>>, 2> halves; ///< light of even and of odd rounds
  };

  void judge_rows(OneLight& light, std::uint32_t first, std::uint32_t count, std::uint32_t turn);
  void add_light(const Illumination& light, std::vector<std::size_t> screens);
  void read_sums(OneLight& light);
  /// The place among lights_ of the one on a screen, and the screen's place there.
  std::size_t lamp_of(std::size_t screen) const;
  std::size_t place_of(std::size_t screen) const;
  std::vector<Cost> costs_by(const std::vector<Target>& targets, const std::vector<std::vector<double>>& light) const;
  void end_pair();
  void read_sums();

  mpi::RankContext context_;
  const Layout& layout_;
  const std::vector<Target>& targets_;
  SolidOnDevice solid_;
  shared::uint2 seed_;
  compute::Buffer<shared::float4> parts_;       ///< the spectrum's parts: index and XYZ
  compute::Buffer<float> wavelengths_;          ///< of the parts, in mm
  compute::Buffer<float> quantiles_;            ///< slit_quantiles()
  std::vector<shared::DeviceReceiver> screens_; ///< the receivers, then the frames
  std::vector<OneLight> lights_;                ///< the receivers' lights, then those of frames in lights between them
  std::size_t first_light_ = 0;                 ///< number of the first light that some receiver has, 0 or 1
  compute::Kernel judge_;
  int along_ = 1;           ///< rays along one side of a facet
  int row_ = 0, round_ = 0; ///< row: of the facets in one light after the other
  bool finished_ = false;
  std::vector<std::vector<double>> light_;                 ///< [screen][cell], in facets
  std::array<std::vector<std::vector<double>>, 2> halves_; ///< light_ of even and of odd rounds
};

/// Checks rays against closed forms, for `nephroid check`.
check::Checks closed_forms();

} // namespace nephroid::inverse
