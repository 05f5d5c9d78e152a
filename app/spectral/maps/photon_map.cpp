// SPDX-License-Identifier: Apache-2.0
#include "spectral/maps/photon_map.h"

#include "tracing/scales.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace nephroid::spectral {
namespace {

/// The work items of a scan; kernels/spectral/grid.cl.
constexpr unsigned scan_blocks = 256;

/// At least one bucket a photon, so that few cells share one.
std::uint32_t bucket_mask(std::uint32_t slots) { return std::bit_ceil(std::max(slots, 1024u)) - 1; }

/// Eight photons are read at a time, up to seven of them beyond the last, and eight are written there that fit no search.
std::uint32_t stride(std::uint32_t slots) { return (slots + 15) / 8 * 8; }

} // namespace

double photon_scale(std::uint32_t photons, double watts) { return tracing::power_of_two_below(std::exp2(12) * photons / watts); }

PhotonMap::PhotonMap(const compute::Context& context, std::uint32_t slots, const compute::Defines& defines)
    : stored_(context, "photons", slots), starts_(context, "photon grid", bucket_mask(slots) + GRID_BLOCK + 1),
      block_sums_(context, "photon grid blocks", scan_blocks),
      positions_(context, "sorted photon positions", 3 * std::size_t{stride(slots)}),
      values_(context, "sorted photons", 4 * std::size_t{stride(slots)})
{
  grid_.bucket_mask = bucket_mask(slots);
  grid_.stride = stride(slots);
  stored_.fill_zero();
  // What is read beyond the last photon does not count, but it has to be numbers.
  positions_.fill_zero();
  values_.fill_zero();
  compute::Defines grid_defines = defines;
  grid_defines["NEPHROID_SCAN_BLOCKS"] = std::to_string(scan_blocks);
  const compute::Program program(context, "spectral/grid.cl", grid_defines);
  count_ = program.kernel("count_photons");
  sum_ = program.kernel("sum_blocks");
  scan_ = program.kernel("scan_blocks");
  scatter_ = program.kernel("scatter_photons");
}

std::uint64_t PhotonMap::bytes(std::uint32_t slots)
{
  return std::uint64_t{slots} * sizeof(shared::StoredPhoton) + (std::uint64_t{bucket_mask(slots)} + GRID_BLOCK + 1 + scan_blocks) * 4 +
         std::uint64_t{stride(slots)} * 7 * 4;
}

void PhotonMap::build(double cell_edge, std::uint32_t slots)
{
  grid_.inverse_cell = static_cast<float>(1 / cell_edge);
  starts_.fill_zero();
  count_.run(std::max(slots, 1u), 64, {{"stored", stored_}, {"counts", starts_}, {"grid", grid_}, {"slots", slots}});
  sum_.run(scan_blocks, 16, {{"counts", starts_}, {"sums", block_sums_}, {"grid", grid_}});
  scan_.run(scan_blocks, 16, {{"counts", starts_}, {"sums", block_sums_}, {"grid", grid_}});
  scatter_.run(std::max(slots, 8u), 64,
               {{"stored", stored_}, {"ends", starts_}, {"positions", positions_}, {"values", values_}, {"grid", grid_}, {"slots", slots}});
}

} // namespace nephroid::spectral
