// SPDX-License-Identifier: Apache-2.0
// What stands around the caustic object, as a cube seen from its middle, with the light on it. Only texels near which a
// path from the eye has ended (kernels/environment/see.cl) are worked out, each once until something changes.
#pragma once
#include "environment/light/caustics.h"
#include "mpi/rank_context.h"
#include "tracing/world.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace nephroid::environment {

/// The scene without the object, and the kernel that finds receivers there.
struct Surroundings {
  tracing::World world;
  compute::Kernel receivers;
};

class Receivers {
public:
  /// size: texels along an edge of a face.
  Receivers(const mpi::RankContext& context, int size);

  static std::uint64_t bytes(int size);

  int size() const { return size_; }
  /// [texel]: RECEIVER_*.
  const compute::Buffer<int>& states() const { return states_; }
  const compute::Buffer<float>& distances() const { return distances_; }
  const compute::Buffer<float>& caustics() const { return caustics_; }
  /// [texel][3]: the part of the environment's light that reaches it past all objects.
  const compute::Buffer<float>& parts_seen() const { return parts_seen_; }

  /// Lists the texels that paths have asked for since the last call, and finds their distances in the surroundings.
  void find_wanted(std::optional<Surroundings>& surroundings, const glm::dvec3& middle);
  /// Works out the distances of all texels.
  void find_all(std::optional<Surroundings>& surroundings, const glm::dvec3& middle);
  /// Lights texels that lack it, by `light`, for one slice of about 30 ms. True when all have their light.
  bool cast(const std::function<void(const CastTexels&)>& light);

  /// Drops everything, because light has changed, or the object or what stands around it has moved.
  void forget();

private:
  void share(const Partition& partition, compute::Buffer<float>& values) const;

  mpi::RankContext context_;
  int size_;
  compute::Buffer<int> states_;
  compute::Buffer<float> distances_, caustics_, parts_seen_;
  compute::Buffer<shared::float4> normals_;
  compute::Buffer<std::uint32_t> list_;
  std::vector<int> states_read_;
  std::vector<std::uint32_t> list_on_host_;
  std::size_t known_ = 0, lit_ = 0, shared_ = 0; ///< texels of the list; shared_: lit on all ranks
  tracing::SliceSize texels_a_slice_{4096};
};

} // namespace nephroid::environment
