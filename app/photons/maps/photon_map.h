// SPDX-License-Identifier: Apache-2.0
// Photons on surfaces and the grid that finds those near a point (kernels/photons/photon_map.h, grid.cl).
// And what MapStage and SppmStage have in common: what memory photon maps take, and how far around a visible point
// photons are gathered.
#pragma once
#include "compute/compute.h"
#include "kernels/photons/photon_map_types.h"
#include "mpi/rank_context.h"
#include "photons/plan_part.h"

#include <array>
#include <cstdint>
#include <string>

namespace nephroid::photons {

/// Quanta per W of a stored photon: 2^12 for one of `photons` that share `watts`; a photon may carry 4096 times as
/// much.
double photon_scale(std::uint32_t photons, double watts);

class PhotonMap {
public:
  /// Room for `slots` photons, 1 <= slots < 2^30. defines: of every kernel. Throws failed where the device has not
  /// enough memory.
  PhotonMap(const mpi::RankContext& context, std::uint32_t slots, const compute::Defines& defines = {});
  /// What it takes on the device.
  static std::uint64_t bytes(std::uint32_t slots);

  /// Where kernels write photons, each to the slot of its number, before build(). Every slot has to be written, if only
  /// with NO_PHOTON.
  compute::Buffer<shared::StoredPhoton>& stored() { return stored_; }
  /// Sorts the first `slots` stored photons into cells of that edge, in scene units; queued. Searches may be as wide as
  /// 3 cells.
  void build(double cell_edge, std::uint32_t slots);
  std::uint32_t slots() const { return static_cast<std::uint32_t>(stored_.size()); }

  /// What a PhotonMap of photon_map.h is made of: the kernel arguments PHOTON_MAP_ARGUMENTS. They refer to the map.
  std::array<compute::Argument, 4> arguments() const {
    return {{{"starts", starts_}, {"sorted_positions", positions_}, {"sorted_values", values_}, {"grid", grid_}}};
  }

private:
  mpi::RankContext context_;
  compute::Buffer<shared::StoredPhoton> stored_;
  compute::Buffer<std::uint32_t> starts_, block_sums_;
  compute::Buffer<float> positions_;
  compute::Buffer<std::int32_t> values_;
  compute::Kernel count_, sum_, scan_, scatter_;
  shared::PhotonGrid grid_{};
};

/// Paths from the eye that a pixel has in a pass of MapStage, 1..64: those that meet glass or a mirror first, which go
/// on, are a third as many in the whole picture as there are photons, so that neither takes most of the time and
/// neither most of the noise.
unsigned eye_paths_a_pass(const scene::Scene& scene, const scene::Bvh& bvh, unsigned photons_per_pass);

/// For a stage that gathers, if the pass says so: with so many photons at a time. Throws bad_input at
/// FILE#/scene/objects for more objects than photons in so many clusters can tell apart.
PlanPart plan_gathering(const PlanInput& input, plan::Pass pass, std::uint32_t photons);

/// spectral.sppm.radius; without, twice what a pixel covers at the distance of the scene's middle (a quarter of the
/// scene's radius for a camera that is nearer). In scene units.
double first_map_radius(const Settings& settings, const scene::Scene& scene);
/// The same in the plan's words.
std::string map_radius(const Settings& settings, const scene::Scene& scene);

/// What the plan says of a spectral.sppm.radius that loses the caustics: wider than 32 pixels or than the whole scene,
/// or below 1/16 pixel, where a pass of as many photons as pixels finds one in some hundred pixels; and of an alpha
/// that makes it so small by the first photons that a pixel of the estimator sppm finds. Empty for any other.
std::string map_radius_note(const Settings& settings, const scene::Scene& scene);

/// What the first radius is multiplied with in pass p (from 0): r_(p+1)^2 = r_p^2 (p + alpha) / (p + 1), counted from 1
/// (Knaus and Zwicker 2011, "Progressive photon mapping: a probabilistic approach", (15)). Squares of radii then fall
/// as p^(alpha - 1): the bias, which is in proportion, vanishes, and so does the variance of the mean of all passes, as
/// p^-alpha. alpha in (0, 1).
double map_radius_factor(std::int64_t pass, double alpha);

} // namespace nephroid::photons
