// SPDX-License-Identifier: Apache-2.0
// Light on receivers, on the device: its pages, what photons add to them, and what paths from the eye find there.
#pragma once
#include "kernels/photons/receiver_types.h"
#include "photons/receivers/pages.h"
#include "photons/tables/run_tables.h"
#include "tracing/archive.h"
#include "tracing/world.h"

#include <cstdint>
#include <vector>

namespace nephroid::photons {

/// Layers of light, each of some of the clusters, which what parts wavelengths on the eye's side shows apart.
int receiver_layers(std::size_t clusters);
/// How many pages there may be for so many pixels that show glass or a mirror, and the bytes of each in all layers.
std::size_t most_pages(std::size_t glass_pixels, int layers, unsigned halves);
std::uint64_t page_bytes(int layers, unsigned halves);

class ReceiverLight {
public:
  /// looks: those of paths from the eye; NO_PAGE charts count for nothing. pages: at most so many.
  ReceiverLight(tracing::World& world, Charts charts, std::vector<shared::DeviceLook> looks, std::size_t pages,
                int layers, unsigned halves, double quanta_per_watt);

  const compute::Buffer<int>& table() const { return table_; }
  compute::Buffer<std::int64_t>& sums() { return sums_; }
  const compute::Buffer<float>& totals() const { return totals_; }
  double quanta_per_watt() const { return quanta_per_watt_; }
  bool has_light() const { return has_light_; }

  /// Makes `part` of the light that is found that of sums(), times scale, which adding them leaves as they are.
  void take(double scale, double part);
  void clear();
  void serialize(tracing::Archive& archive);

private:
  tracing::World& world_;
  Charts charts_;
  PageTrees trees_;
  int layers_;
  unsigned halves_;
  double quanta_per_watt_; ///< of what is found
  bool has_light_ = false; ///< whether take() was called
  compute::Buffer<int> table_;
  compute::Buffer<std::int64_t> sums_; ///< quanta of all photons of this rank: [half][page][layer][PAGE_TEXELS][3]
  compute::Buffer<float> totals_;      ///< as sums_
  compute::Kernel take_, sum_;
};

/// The table of receivers without pages, by which paths from the eye ask for them.
std::vector<int> receiver_table(const Charts& charts, const PageTrees& trees, int layers);

} // namespace nephroid::photons
