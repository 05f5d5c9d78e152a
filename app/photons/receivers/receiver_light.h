// SPDX-License-Identifier: Apache-2.0
// Light on receivers, on the device: its pages, what photons add to them, and what paths from the eye find there.
#pragma once
#include "kernels/photons/receiver_types.h"
#include "photons/receivers/pages.h"
#include "photons/tables/run_tables.h"
#include "tracing/archive.h"
#include "tracing/world.h"

#include <array>
#include <cstdint>
#include <vector>

namespace nephroid::photons {

/// Light that is kept and found apart.
enum class KindOfLight { caustic, indirect };

/// The most bytes that a scene's light on receivers takes. kinds: 1, caustics alone, or 2.
std::uint64_t most_receiver_bytes(const scene::Scene& scene, const tracing::WavelengthTables& tables, bool jitter,
                                  unsigned halves, int kinds);

/// How light is kept apart by its wavelengths, for what parts them on the eye's side: whole clusters where there are
/// enough, or runs of their members.
struct LightLayers {
  std::vector<int> first_members{0, 0};                                 ///< [layer + 1], see DeviceReceiverTable
  std::vector<float> places{0, 1};                                      ///< [layer + 1]
  std::vector<int> of_wavelengths = std::vector<int>(WAVELENGTH_COUNT); ///< [wavelength]: its layer

  int count() const { return static_cast<int>(first_members.size()) - 1; }
};

/// At most so many layers. jitter: paths have one wavelength of their cluster.
LightLayers make_layers(const tracing::WavelengthTables& tables, bool jitter, std::size_t most);

/// Charts and pages as kernels read them (DeviceReceiverTable).
std::vector<int> receiver_table(const Charts& charts, const PageTrees& trees, const LightLayers& layers);

class ReceiverLight {
public:
  ReceiverLight(tracing::World& world, const Charts& charts, PageTrees trees, const LightLayers& layers,
                unsigned halves, int kinds, double quanta_per_watt);

  const compute::Buffer<int>& table() const { return table_; }
  compute::Buffer<std::int64_t>& sums() { return sums_; }
  const compute::Buffer<float>& totals() const { return totals_; }
  double quanta_per_watt() const { return quanta_per_watt_; }

  /// Makes `part` of the caustics that are found those of sums(), times scale, and clears them there.
  void take_tiles(double scale, double part);
  /// The same of photons that are points: makes all of a kind's light that of sums(), over how often each half of them
  /// had its part of the power.
  void take_points(KindOfLight kind, std::array<double, 2> count);
  void clear();
  void serialize(tracing::Archive& archive);

private:
  void take(KindOfLight kind, std::array<double, 2> scale, double part, bool are_points);

  tracing::World& world_;
  PageTrees trees_;
  int layers_;
  unsigned halves_;
  double quanta_per_watt_; ///< of what is found
  compute::Buffer<int> table_;
  compute::Buffer<std::int64_t>
      sums_;                      ///< quanta of all photons of this rank: [half][page][kind][layer][PAGE_TEXELS][3]
  compute::Buffer<float> totals_; ///< as sums_
  compute::Kernel take_, sum_, clear_;
};

} // namespace nephroid::photons
