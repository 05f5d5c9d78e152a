// SPDX-License-Identifier: Apache-2.0
// Bakes on a device: photons direction after direction, in slices of about 30 ms (kernels/environment/bake.cl).
#pragma once
#include "environment/bake/bake.h"
#include "environment/bake/caster.h"
#include "mpi/rank_context.h"
#include "scene/bvh.h"
#include "tracing/scene_tables.h"
#include "tracing/slices.h"
#include "tracing/world.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

namespace nephroid::environment {

/// Whether two wavelengths go other ways through the materials of the tables, or lose more or less on the same.
bool is_coloured(const tracing::WavelengthTables& tables);

/// What is baked and how, worked out once.
struct BakeTask {
  Caster caster;
  scene::Bvh bvh;
  tracing::SceneTables tables;
  bool coloured = false;     ///< the object bends or takes away one wavelength otherwise than another
  std::vector<double> radii; ///< of the spheres
  std::vector<glm::dvec3> directions;
  int resolution = 0;
  std::uint32_t photons = 0; ///< from each direction
  std::uint64_t seed = 0;
  compute::Defines defines;

  Bake empty_bake() const;
  /// Of a sphere's texels: channels of the light, and three of its way.
  std::size_t sums_a_texel() const { return coloured ? 6 : 4; }
  std::size_t sums_a_sphere() const { return sums_a_texel() * SphereMap{resolution}.texels(); }
  std::uint64_t film_bytes() const { return radii.size() * sums_a_sphere() * sizeof(std::int64_t); }
  /// Of all directions, in memory.
  std::uint64_t bytes() const {
    const Bake bake = empty_bake();
    return static_cast<std::uint64_t>(bake.direction_items() + bake.direction_texels()) * directions.size() *
           sizeof(std::uint16_t);
  }
};

/// task: without its seed and photons being 0. Throws bad_input as make_caster and sphere_radii.
BakeTask make_task(const preset::Preset& preset);

class Baker {
public:
  /// task outlives it. wanted: directions that it will be asked for. Throws failed where the device has not enough
  /// memory.
  Baker(const BakeTask& task, const mpi::RankContext& context, std::size_t wanted = ~std::size_t{0});

  /// Photons of the direction in hand; with its last ones the direction is added to the bake. With several ranks, of a
  /// direction for each rank.
  void advance();
  bool finished() const { return bake_.baked.size() == task_.directions.size(); }
  /// Of the direction in hand, 0..1.
  double fraction_done() const { return static_cast<double>(sent_) / task_.photons; }
  /// Until all is baked, if all goes on as it went with the last direction; nothing before the first is done.
  std::optional<double> seconds_left() const;
  /// Sent so far.
  std::uint64_t photons() const {
    return bake_.baked.size() * std::uint64_t{task_.photons} + at_once() * std::uint64_t{sent_};
  }
  const Bake& bake() const { return bake_; }
  /// Once finished.
  Bake take() { return std::move(bake_); }

  void state(tracing::State& state);

private:
  /// Directions in hand: each rank has one.
  std::size_t at_once() const;
  void finish_directions();
  BakedDirection finish_direction(std::size_t direction);
  void finish_sphere(std::size_t direction, std::size_t sphere, double scale);
  void clear();

  const BakeTask& task_;
  std::size_t wanted_;
  tracing::World world_;
  double watts_; ///< that all photons of a direction have together
  compute::Buffer<shared::float4> light_rgb_;
  compute::Buffer<float> radii_;
  compute::Buffer<std::int64_t> film_, energy_; ///< [sphere][texel][channels, then x, y and z of the way]
  compute::Kernel kernel_;
  tracing::SliceSize photons_a_slice_{8192};
  Bake bake_;
  std::uint32_t sent_ = 0;                                                         ///< of each direction in hand
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now(); ///< with the direction in hand
  std::optional<double> seconds_a_direction_;                                      ///< that the one before it took
  std::vector<std::size_t> texels_;                                                ///< SphereMap::texels_of_stored
  std::vector<std::uint16_t> outward_; ///< [texel]: the number of its direction among ways
};

} // namespace nephroid::environment
