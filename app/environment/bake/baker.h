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
  Baker(const BakeTask& task, const mpi::RankContext& context, std::size_t wanted = ~std::size_t{0})
      : Baker(task, context, wanted, task.empty_bake()) {}
  /// before: what it adds to, with the shapes before this one.
  Baker(const BakeTask& task, const mpi::RankContext& context, std::size_t wanted, Bake before);

  /// Sends some photons of the direction in hand, one for each rank. The last ones add it to the bake.
  void advance();
  bool finished() const { return done() == task_.directions.size(); }
  /// The part of the direction in hand that is done, 0..1.
  double fraction_done() const { return static_cast<double>(sent_) / task_.photons; }
  /// The time until all is baked, and so many directions more, at the last direction's pace; nothing before the first
  /// direction is done.
  std::optional<double> seconds_left(std::size_t more = 0) const;
  std::uint64_t photons() const { return done() * std::uint64_t{task_.photons} + at_once() * std::uint64_t{sent_}; }
  const Bake& bake() const { return bake_; }
  Bake& bake() { return bake_; }
  Bake take() { return std::move(bake_); }

  void serialize(tracing::Archive& archive);

private:
  std::size_t done() const { return bake_.baked.size() - first_; } ///< directions of this shape
  /// How many directions are in hand: one for each rank.
  std::size_t at_once() const;
  void finish_directions();
  BakedDirection finish_direction(std::size_t direction);
  void finish_sphere(std::size_t direction, std::size_t sphere, double scale);
  void clear();

  const BakeTask& task_;
  std::size_t first_, wanted_; ///< in the bake: the shape's first direction; the end of those to be baked
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

/// A bake that a run needs: of its object's shape, or of one that it is between.
struct PlannedBake {
  std::shared_ptr<const BakeTask> task;
  double weight = 1;          ///< as BakedShape's
  std::uint64_t key = 0;      ///< bake_key
  std::filesystem::path file; ///< that keeps it
  bool reads = false;         ///< the file is there and looks right
};

class Baking {
public:
  /// task: of the object as it stands; its spheres are mixed of the bakes, which it outlives. directions: how many will
  /// be baked. A file that turns out wrong is a warning. Throws as Baker does.
  Baking(std::shared_ptr<const BakeTask> task, std::vector<PlannedBake> bakes, std::size_t directions,
         const mpi::RankContext& context);

  const BakeTask& task() const { return *task_; }
  bool is_complete() const { return shape_ == bakes_.size(); }
  std::size_t shape() const { return shape_; }         ///< the number of the bake in hand
  std::size_t shapes() const { return bakes_.size(); } ///< how many bakes there are
  /// What is baked so far. It becomes another object when a bake is complete; when all are it stays that one.
  const Bake& bake() const { return baker_ ? baker_->bake() : bake_; }

  /// Bakes for one slice of about 30 ms. Only for a bake that is not complete.
  void advance();
  /// The object has another shape between the same ones. task: of this. weights: Bake's.
  void set_shape(std::shared_ptr<const BakeTask> task, std::vector<double> weights);
  /// Drops the bakes from that one on, because a state in which it was in hand is about to be loaded.
  void begin_anew(std::size_t shape);

  std::int64_t directions() const { return static_cast<std::int64_t>(bake().baked.size()); } ///< complete ones
  double fraction_done() const;                                                              ///< 0..1
  std::uint64_t photons() const { return photons_ + (baker_ ? baker_->photons() : 0); }
  /// The time until the bake is complete; nothing where that is not known.
  std::optional<double> seconds_left() const;
  /// Whether nothing had to be baked.
  bool is_from_file() const { return is_complete() && photons_ == 0; }
  /// What is wrong with the file, a sentence each.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Only for a bake that is not complete.
  void serialize(tracing::Archive& archive) {
    archive.value(photons_);
    baker_->serialize(archive);
  }

private:
  void go_on();
  bool read();
  void keep();
  BakeIdentity identity() const { return {bakes_[shape_].key, kernels_}; }

  std::shared_ptr<const BakeTask> task_;
  mpi::RankContext context_;
  std::vector<PlannedBake> bakes_;
  std::uint64_t kernels_; ///< hash of the kernels' sources
  std::size_t wanted_;
  std::size_t shape_ = 0;      ///< the bake in hand
  std::optional<Baker> baker_; ///< in work; empty once all are complete
  Bake bake_;                  ///< the complete bakes, while there is no baker
  std::uint64_t photons_ = 0;  ///< photons that this run sent for complete bakes
  std::vector<std::string> warnings_;
};

} // namespace nephroid::environment
