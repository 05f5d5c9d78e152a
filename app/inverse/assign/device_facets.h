// SPDX-License-Identifier: Apache-2.0
// The facets on the device, their light, and which slopes would serve the pictures better (kernels/inverse).
#pragma once
#include "base/bytes.h"
#include "inverse/layout.h"
#include "kernels/inverse/facet_types.h"
#include "mpi/rank_context.h"

namespace nephroid::inverse {

/// Defines that tell kernels what to leave out.
compute::Defines facet_defines(const Layout& layout);

class DeviceFacets {
public:
  /// The most facets that look for slopes at once: a claim has 12 bits for them (search.cl).
  static constexpr std::size_t most_in_a_batch = 4096;

  /// `weights` are those of the receivers' squares. Throws failed where the device has not enough memory.
  DeviceFacets(const mpi::RankContext& context, const Layout& layout, const std::vector<Target>& targets,
               std::span<const double> weights);

  /// Takes on other distances, targets and weights.
  void aim(const Layout& layout, const std::vector<Target>& targets, std::span<const double> weights);

  /// Takes on the light on the facets, and their neighbours as they are now.
  void set_incoming(const Layout& layout);

  /// Puts all facets' light on the receivers. `heights` are those of their middles.
  void put(const std::vector<glm::dvec2>& slopes, const std::vector<double>& heights);
  std::vector<glm::dvec2> slopes() const;
  /// [receiver][cell], in units of facets that send all of their light.
  std::vector<std::vector<double>> light() const;

  /// Sets a sweep's order and its number, from which its random numbers come.
  void begin_sweep(const std::vector<std::uint32_t>& order, std::int64_t sweep, std::uint64_t seed);
  std::size_t batch() const { return batch_; } ///< how many facets a batch has
  /// Facets first .. first + count - 1 of the order look for better slopes and take them. Each gains what it would gain
  /// alone. `smoothing` is the weight of a facet's Cost_N in the sum.
  void improve(std::size_t first, std::size_t count, double smoothing);

  /// The gradient of the weighted squares, by each facet's slope.
  std::vector<glm::dvec2> gradient();

  static std::uint64_t bytes(const Layout& layout);

  void serialize(Archive& archive);

private:
  mpi::RankContext context_;
  compute::Buffer<shared::DeviceLayout> layout_; ///< a single one
  std::size_t facets_, batch_, cells_, rows_;    ///< cells_ and rows_ are those of all receivers
  compute::Buffer<shared::DeviceReceiver> receivers_;
  compute::Buffer<shared::DeviceIncoming> incoming_;
  compute::Buffer<float> heights_, wanted_, lack_, along_y_, smeared_;
  compute::Buffer<std::array<float, 2>> slopes_, candidates_, found_, gradient_;
  compute::Buffer<std::int64_t> light_;
  compute::Buffer<std::uint32_t> order_, claims_;
  compute::Buffer<int> done_;
  compute::Kernel add_light_, find_lack_, find_gradient_, smear_x_, smear_y_, propose_, improve_, claim_, take_;
  std::uint32_t sweep_ = 0, turn_ = 0;
  shared::uint2 seed_{};

  std::vector<compute::Argument> facet_arguments() const;
  std::vector<compute::Argument> batch_arguments(const shared::DeviceBatch& batch) const;
  void find_lack();
  void find_better(const shared::DeviceBatch& batch);
};

} // namespace nephroid::inverse
