// SPDX-License-Identifier: Apache-2.0
// Bakes on a device: photons direction after direction, in slices of about 30 ms (kernels/environment/bake.cl). And the
// bake of a run: read from its file, or made and then kept there.
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
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::environment {

/// Whether any two wavelengths take different ways through the materials of the tables, or lose different parts.
bool is_coloured(const tracing::WavelengthTables& tables);

/// What is baked and how, worked out once.
struct BakeTask {
  Caster caster;
  scene::Bvh bvh;
  tracing::SceneTables tables;
  bool coloured = false;     ///< whether the object bends or absorbs wavelengths differently
  std::vector<double> radii; ///< the spheres'
  std::vector<glm::dvec3> directions;
  int resolution = 0;
  std::uint32_t photons = 0; ///< from each direction
  std::uint64_t seed = 0;
  compute::Defines defines;

  Bake empty_bake() const;
  /// A texel has its channels of light and x, y and z of its way.
  std::size_t sums_a_texel() const { return coloured ? 6 : 4; }
  std::size_t sums_a_sphere() const { return sums_a_texel() * SphereMap{resolution}.texels(); }
  std::uint64_t film_bytes() const { return radii.size() * sums_a_sphere() * sizeof(std::int64_t); }
  /// The memory that the bake of all directions takes.
  std::uint64_t bytes() const { return empty_bake().bytes(directions.size()); }
};

/// Throws bad_input as make_caster and sphere_radii do.
BakeTask make_task(const preset::Preset& preset);

class Baker {
public:
  /// task outlives it. wanted: how many directions will be baked. Throws failed where the device has not enough memory.
  Baker(const BakeTask& task, const mpi::RankContext& context, std::size_t wanted = ~std::size_t{0});

  /// Sends some photons of the direction in hand, one for each rank. The last ones add it to the bake.
  void advance();
  bool finished() const { return bake_.baked.size() == task_.directions.size(); }
  /// The part of the direction in hand that is done, 0..1.
  double fraction_done() const { return static_cast<double>(sent_) / task_.photons; }
  /// The time until all is baked, at the last direction's pace; nothing before the first direction is done.
  std::optional<double> seconds_left() const;
  std::uint64_t photons() const {
    return bake_.baked.size() * std::uint64_t{task_.photons} + at_once() * std::uint64_t{sent_};
  }
  const Bake& bake() const { return bake_; }
  /// Only when finished().
  Bake take() { return std::move(bake_); }

  void serialize(tracing::Archive& archive);

private:
  /// How many directions are in hand: one for each rank.
  std::size_t at_once() const;
  void finish_directions();
  BakedDirection finish_direction(std::size_t direction);
  void finish_sphere(std::size_t direction, std::size_t sphere, double scale);
  void clear();

  const BakeTask& task_;
  std::size_t wanted_;
  tracing::World world_;
  double watts_; ///< the power of all photons of a direction
  compute::Buffer<shared::float4> light_rgb_;
  compute::Buffer<float> radii_;
  compute::Buffer<std::int64_t> film_, energy_; ///< [sphere][texel][channels, then x, y and z of the way]
  compute::Kernel kernel_;
  tracing::SliceSize photons_a_slice_{8192};
  Bake bake_;
  std::uint32_t sent_ = 0; ///< photons, for each direction in hand
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now(); ///< when the direction in hand began
  std::optional<double> seconds_a_direction_; ///< how long the direction before it took
};

class Baking {
public:
  /// key: the bake's. directions: how many will be baked. reads: the file is there and looks right; a file that turns
  /// out wrong is a warning. Throws as Baker does.
  Baking(std::shared_ptr<const BakeTask> task, std::uint64_t key, std::filesystem::path file, bool reads,
         std::size_t directions, const mpi::RankContext& context);

  const BakeTask& task() const { return *task_; }
  bool is_complete() const { return bake_.has_value(); }
  /// What is baked so far. It becomes another object when the bake is complete, and stays that one.
  const Bake& bake() const { return bake_ ? *bake_ : baker_->bake(); }

  /// Bakes for one slice of about 30 ms. Only for a bake that is not complete.
  void advance();
  /// Drops a complete bake, because a state is about to be loaded.
  void begin_anew();

  std::int64_t directions() const { return static_cast<std::int64_t>(bake().baked.size()); } ///< complete ones
  double fraction_done() const;                                                              ///< 0..1
  std::uint64_t photons() const { return bake_ ? photons_ : baker_->photons(); }
  /// The time until the bake is complete; nothing where that is not known.
  std::optional<double> seconds_left() const { return baker_->seconds_left(); }
  bool is_from_file() const { return is_from_file_; }
  /// What is wrong with the file, a sentence each.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Only for a bake that is not complete.
  void serialize(tracing::Archive& archive) { baker_->serialize(archive); }

private:
  void read();
  void keep();

  std::shared_ptr<const BakeTask> task_;
  mpi::RankContext context_;
  std::filesystem::path file_;
  BakeIdentity identity_;
  std::size_t wanted_;
  std::optional<Baker> baker_; ///< the bake in work; empty once it is complete
  std::optional<Bake> bake_;   ///< the complete bake
  bool is_from_file_ = false;
  std::uint64_t photons_ = 0; ///< photons that this run sent for the complete bake
  std::vector<std::string> warnings_;
};

} // namespace nephroid::environment
