// SPDX-License-Identifier: Apache-2.0
#include "photons/maps/photon_map.h"

#include "tracing/scales.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace nephroid::photons {
namespace {

/// The number of work items of a scan in kernels/photons/grid.cl.
constexpr unsigned scan_blocks = 256;

/// There is at least one bucket a photon, so that few cells share one.
std::uint32_t bucket_mask(std::uint32_t slots) { return std::bit_ceil(std::max(slots, 1024u)) - 1; }

/// Kernels read eight photons at a time, up to seven beyond the last, where eight stand that match no search.
std::uint32_t stride(std::uint32_t slots) { return (slots + 15) / 8 * 8; }

} // namespace

double photon_scale(std::uint32_t photons, double watts) {
  return tracing::power_of_two_below(std::exp2(12) * photons / watts);
}

PhotonMap::PhotonMap(const mpi::RankContext& context, std::uint32_t slots, const compute::Defines& defines)
    : context_(context), stored_(context, "photons", slots),
      starts_(context, "photon grid", bucket_mask(slots) + GRID_BLOCK + 1),
      block_sums_(context, "photon grid blocks", scan_blocks),
      positions_(context, "sorted photon positions", 3 * std::size_t{stride(slots)}),
      values_(context, "sorted photons", 4 * std::size_t{stride(slots)}) {
  grid_.bucket_mask = bucket_mask(slots);
  grid_.stride = stride(slots);
  stored_.fill_zero();
  // What is read beyond the last photon does not count, but it has to be numbers.
  positions_.fill_zero();
  values_.fill_zero();
  compute::Defines grid_defines = defines;
  grid_defines["NEPHROID_SCAN_BLOCKS"] = std::to_string(scan_blocks);
  const compute::Program program(context, "photons/grid.cl", grid_defines);
  count_ = program.kernel("count_photons");
  sum_ = program.kernel("sum_blocks");
  scan_ = program.kernel("scan_blocks");
  scatter_ = program.kernel("scatter_photons");
}

std::uint64_t PhotonMap::bytes(std::uint32_t slots) {
  return std::uint64_t{slots} * sizeof(shared::StoredPhoton) +
         (std::uint64_t{bucket_mask(slots)} + GRID_BLOCK + 1 + scan_blocks) * 4 + std::uint64_t{stride(slots)} * 7 * 4;
}

void PhotonMap::build(double cell_edge, std::uint32_t slots) {
  grid_.inverse_cell = static_cast<float>(1 / cell_edge);
  if (!context_.communicator().is_alone()) stored_.write(context_.all_reduced_or(stored_));
  starts_.fill_zero();
  count_.run(std::max(slots, 1u), 64, {{"stored", stored_}, {"counts", starts_}, {"grid", grid_}, {"slots", slots}});
  sum_.run(scan_blocks, 16, {{"counts", starts_}, {"sums", block_sums_}, {"grid", grid_}});
  scan_.run(scan_blocks, 16, {{"counts", starts_}, {"sums", block_sums_}, {"grid", grid_}});
  scatter_.run(std::max(slots, 8u), 64,
               {{"stored", stored_},
                {"ends", starts_},
                {"positions", positions_},
                {"values", values_},
                {"grid", grid_},
                {"slots", slots}});
}

double middle_pixel_width(const scene::Scene& scene) {
  const scene::Camera& camera = scene.camera;
  const scene::Sphere bounds = tracing::scene_bounds(scene);
  const double distance =
      camera.orthographic ? 1 : std::max<double>(glm::length(camera.position - bounds.centre), 0.25 * bounds.radius);
  return 2 * distance * camera.tan_y / camera.height;
}

double first_map_radius(const Settings& settings, const scene::Scene& scene) {
  return settings.sppm.radius ? *settings.sppm.radius : 2 * middle_pixel_width(scene);
}

std::string map_radius(const Settings& settings, const scene::Scene& scene) {
  return fmt::format("from {:.3g} units around a visible point", first_map_radius(settings, scene));
}

double map_radius_factor(std::int64_t pass, double alpha) {
  // The product of (k + alpha) / (k + 1) over k = 1 .. p is Gamma(p + 1 + alpha) / Gamma(1 + alpha) / Gamma(p + 2).
  const auto p = static_cast<double>(pass);
  return std::exp(0.5 * (std::lgamma(p + 1 + alpha) - std::lgamma(1 + alpha) - std::lgamma(p + 2)));
}

} // namespace nephroid::photons
