// SPDX-License-Identifier: Apache-2.0
// What stands around the caustic object, as a cube seen from its middle, with the light on it. Only those texels are
// worked out that a path from the eye has ended near (kernels/environment/see.cl), each once until something changes.
#pragma once
#include "environment/light/caustics.h"
#include "mpi/rank_context.h"
#include "tracing/world.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace nephroid::environment {

/// The scene without the object, and the kernel that looks for receivers there.
struct Surroundings {
  tracing::World world;
  compute::Kernel receivers;
};

class Receivers {
public:
  /// size: texels along an edge of a face.
  Receivers(const mpi::RankContext& context, int size);

  /// On the device.
  static std::uint64_t bytes(int size);

  int size() const { return size_; }
  /// RECEIVER_*, [texel].
  const compute::Buffer<int>& states() const { return states_; }
  const compute::Buffer<float>& distances() const { return distances_; }
  const compute::Buffer<float>& caustics() const { return caustics_; }
  /// Of the environment's light, past all objects: [texel][3].
  const compute::Buffer<float>& parts_seen() const { return parts_seen_; }

  /// Lists the texels that paths have asked for since the last call, and works out their distances. surroundings: empty
  /// where there is nothing.
  void find_wanted(std::optional<Surroundings>& surroundings, const glm::dvec3& middle);
  /// Works out the distances of all texels.
  void find_all(std::optional<Surroundings>& surroundings, const glm::dvec3& middle);
  /// One slice of about 30 ms of light on texels that lack it: of those that `light` gets. True when all have theirs.
  bool cast(const std::function<void(const CastTexels&)>& light);

  /// All is out of date: light has changed, or the object or what stands around it has moved.
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
  std::size_t known_ = 0, lit_ = 0, shared_ = 0; ///< of the list; shared: lit, and known to all ranks
  tracing::SliceSize texels_a_slice_{4096};
};

} // namespace nephroid::environment
