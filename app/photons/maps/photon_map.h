// SPDX-License-Identifier: Apache-2.0
// Photons on surfaces, the grid that finds those near a point (kernels/photons/photon_map.h, grid.cl), and the radius
// in which they are gathered.
#pragma once
#include "compute/compute.h"
#include "kernels/photons/photon_map_types.h"
#include "mpi/rank_context.h"
#include "photons/plan_part.h"

#include <array>
#include <cstdint>
#include <string>

namespace nephroid::photons {

/// Quanta per W of a stored photon: 2^12 for one of `photons` that share `watts`. It may carry 4096 times as much.
double photon_scale(std::uint32_t photons, double watts);

class PhotonMap {
public:
  /// Has room for `slots` photons, 1 <= slots < 2^30. Throws failed where the device has not enough memory.
  PhotonMap(const mpi::RankContext& context, std::uint32_t slots, const compute::Defines& defines = {});
  static std::uint64_t bytes(std::uint32_t slots);

  /// Where kernels write photons before build(). Every slot has to be written, if only with NO_PHOTON.
  compute::Buffer<shared::StoredPhoton>& stored() { return stored_; }
  /// Queues the sorting of the first `slots` stored photons into cells. The radius of a search may be up to 3 cells.
  void build(double cell_edge, std::uint32_t slots);

  /// The kernel arguments PHOTON_MAP_ARGUMENTS, from which kernels make a PhotonMap. They refer to this map.
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

/// spectral.sppm.radius, in scene units. By default it is twice the width of a pixel at the distance of the scene's
/// middle (at a quarter of the scene's radius for a camera that is nearer).
double first_map_radius(const Settings& settings, const scene::Scene& scene);
/// The width of a pixel at that distance, in scene units.
double middle_pixel_width(const scene::Scene& scene);
/// The first radius as the plan states it.
std::string map_radius(const Settings& settings, const scene::Scene& scene);

/// The factor of the first radius in pass p (from 0): r_(p+1)^2 = r_p^2 (p + alpha) / (p + 1), counted from 1 (Knaus
/// and Zwicker 2011, "Progressive photon mapping: a probabilistic approach", (15)). Squares of radii then fall as
/// p^(alpha - 1). The bias is proportional to them; the variance of the mean of all passes falls as p^-alpha.
double map_radius_factor(std::int64_t pass, double alpha);

} // namespace nephroid::photons
