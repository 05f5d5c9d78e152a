// SPDX-License-Identifier: Apache-2.0
// A scene on a device: the tables of scene_tables.h, and how kernels run in it.
#pragma once
#include "compute/compute.h"
#include "mpi/rank_context.h"
#include "plan/plan.h"
#include "scene/bvh.h"
#include "tracing/scene_tables.h"

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

namespace nephroid::tracing {

/// The two blocks of tables of kernels/tracing/scene_table_types.h, and where each table begins in its block.
struct SceneBuffers {
  compute::Buffer<std::uint8_t> geometry, tables;
  shared::DeviceTables first{};
};

/// Bytes of a scene's tree, of its environment as a light, and of its textures.
std::uint64_t tree_bytes(const scene::Bvh& bvh);
std::uint64_t sky_bytes(const SceneTables& tables);
std::uint64_t texture_bytes(const SceneTables& tables);

/// The plan's rows of what `upload` allocates.
std::vector<plan::PlannedBuffer> planned_buffers(const scene::Scene& scene, const scene::Bvh& bvh,
                                                 const SceneTables& tables);

/// Uploads the tables that say where surfaces are. Throws failed where the device has not enough memory.
void upload_surfaces(const compute::Context& context, const scene::Scene& scene, const scene::Bvh& bvh,
                     SceneBuffers& buffers);

/// Throws failed where the device has not enough memory.
SceneBuffers upload(const compute::Context& context, const scene::Scene& scene, const scene::Bvh& bvh,
                    const SceneTables& tables);

struct World {
  mpi::RankContext context;
  SceneBuffers buffers;
  shared::DeviceScene scene{};
  compute::Defines defines; ///< for every kernel
  shared::uint2 seed{};

  compute::Buffer<std::int64_t> zeroed(const std::string& name, std::size_t count) const {
    return compute::zeroed<std::int64_t>(context, name, count);
  }

  /// Queues a kernel that has WORLD_ARGUMENTS (kernels/tracing/world.h) beside its `own`.
  void queue(compute::Kernel& kernel, std::size_t global, std::size_t local,
             std::initializer_list<compute::Argument> own, std::initializer_list<compute::Argument> more = {}) {
    scene.first = buffers.first;
    std::vector<compute::Argument> arguments{
        {"geometry", buffers.geometry}, {"tables", buffers.tables}, {"scene", scene}};
    arguments.insert(arguments.end(), more);
    kernel.run(global, local, arguments, own);
  }

  /// Queues a kernel and waits for it, so that a slice's time is that of its work (slices.h).
  void run(compute::Kernel& kernel, std::size_t global, std::size_t local, std::initializer_list<compute::Argument> own,
           std::initializer_list<compute::Argument> more = {}) {
    queue(kernel, global, local, own, more);
    context.finish();
  }

  /// How many photons one work item follows: on a CPU several, because an item adds up its own sums first.
  unsigned photons_per_item() const { return context.device().type == "cpu" ? 16 : 1; }
  /// The defines of a kernel that run_photons runs.
  compute::Defines photon_defines() const {
    compute::Defines result = defines;
    result["NEPHROID_PHOTONS_PER_ITEM"] = std::to_string(photons_per_item());
    return result;
  }
  /// Those of paths from the eye. sweeps: their ends are swept over wavelengths, where those go different ways.
  compute::Defines eye_defines(bool sweeps = false) const {
    compute::Defines result = defines;
    const bool swept = sweeps && defines.at("NEPHROID_EYE_SWEEP") == "1";
    result["NEPHROID_DIFFERENTIALS"] = std::to_string(int(swept));
    if (!sweeps) result["NEPHROID_EYE_PARTS"] = std::to_string(0);
    if (swept) result["NEPHROID_JITTER"] = std::to_string(1); // also where each cluster has one wavelength
    return result;
  }
  /// Does what run does, with items for `count` photons, and at least one.
  void run_photons(compute::Kernel& kernel, std::uint32_t count, std::initializer_list<compute::Argument> own,
                   std::initializer_list<compute::Argument> more = {}) {
    run(kernel, std::max(1u, (count + photons_per_item() - 1) / photons_per_item()), 32, own, more);
  }
};

/// A preset's seed as kernels take it.
inline shared::uint2 seed_words(std::uint64_t seed) {
  return {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)};
}

/// Copies the scene and tree to the device; they need not outlive the call. defines: the plan's. Throws as upload does.
World make_world(const mpi::RankContext& context, const scene::Scene& scene, const scene::Bvh& bvh,
                 const SceneTables& tables, const compute::Defines& defines, std::uint64_t seed);

} // namespace nephroid::tracing
