// SPDX-License-Identifier: Apache-2.0
// Photons on surfaces and the grid that finds those near a point (kernels/spectral/photon_map.h, grid.cl).
#pragma once
#include "compute/compute.h"
#include "kernels/spectral/photon_map_types.h"

#include <array>
#include <cstdint>

namespace nephroid::spectral {

/// Quanta per W of a stored photon: 2^12 for one of `photons` that share `watts`; a photon may carry 4096 times as much.
double photon_scale(std::uint32_t photons, double watts);

class PhotonMap {
public:
  /// Room for `slots` photons, 1 <= slots < 2^30. defines: of every kernel. Throws failed where the device has not enough memory.
  PhotonMap(const compute::Context& context, std::uint32_t slots, const compute::Defines& defines = {});
  /// What it takes on the device.
  static std::uint64_t bytes(std::uint32_t slots);

  /// Where kernels write photons, each to the slot of its number, before build(). Every slot has to be written, if only with NO_PHOTON.
  compute::Buffer<shared::StoredPhoton>& stored() { return stored_; }
  /// Sorts the first `slots` stored photons into cells of that edge, in scene units; queued. Searches may be as wide as 3 cells.
  void build(double cell_edge, std::uint32_t slots);
  std::uint32_t slots() const { return static_cast<std::uint32_t>(stored_.size()); }

  /// What a PhotonMap of photon_map.h is made of: the kernel arguments PHOTON_MAP_ARGUMENTS. They refer to the map.
  std::array<compute::Argument, 4> arguments() const
  {
    return {{{"starts", starts_}, {"sorted_positions", positions_}, {"sorted_values", values_}, {"grid", grid_}}};
  }

private:
  compute::Buffer<shared::StoredPhoton> stored_;
  compute::Buffer<std::uint32_t> starts_, block_sums_;
  compute::Buffer<float> positions_;
  compute::Buffer<std::int32_t> values_;
  compute::Kernel count_, sum_, scan_, scatter_;
  shared::PhotonGrid grid_{};
};

} // namespace nephroid::spectral
