// SPDX-License-Identifier: Apache-2.0
// Photons of a batch are allocated to emitters, pairs of a light and a wavelength cluster, and leave lights in
// directions where they matter.
#pragma once
#include "kernels/tracing/shared_types.h"
#include "tracing/archive.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nephroid::photons {

/// A light and a cluster that photons may be allocated to.
struct PhotonSource {
  double weight = 0; ///< weight in the allocation of photons
  int light = 0;     ///< index in the table of lights
  int cluster = 0;
  double share = 0; ///< DeviceEmitter::share
};

/// Numbers the emitters of those sources that allocate_photons gives photons. Sources of a light follow each other.
std::vector<shared::DeviceEmitter> make_emitters(const std::vector<PhotonSource>& sources, unsigned photons);

/// Allocates so many photons in proportion to the weights. Each positive weight gets at least one photon, a
/// weight of 0 none. The result sums to max(photons, number of positive weights).
std::vector<unsigned> allocate_photons(const std::vector<double>& weights, unsigned photons);

/// Fills DeviceEmitter::first_photon and the two fields of the light from photon_count.
void number_photons(std::vector<shared::DeviceEmitter>& emitters);

/// The photons of all emitters together, once they are numbered.
unsigned count_photons(const std::vector<shared::DeviceEmitter>& emitters);

/// Moves an emitter on in its low-discrepancy sequence.
void advance_sequence(shared::DeviceEmitter& emitter, std::uint64_t photons);

/// Allocates the photons of a batch to the emitters by their variance in earlier batches. V_e is the variance of one
/// photon that carries all of the emitter's power. Of all allocations of n photons, n_e in proportion to sqrt(V_e)
/// makes the sum of the emitters' variances V_e / n_e smallest.
class NeymanAllocation {
public:
  /// emitters have the allocation of the first batches, each with at least one photon.
  explicit NeymanAllocation(std::vector<shared::DeviceEmitter> emitters);

  const std::vector<shared::DeviceEmitter>& emitters() const { return emitters_; }
  /// The first batch that emitters() are for.
  std::int64_t first_iteration() const { return first_iteration_; }
  /// Whether photons are allocated anew before this batch: before batches 2, 4, 8, 16, ...
  bool is_due(std::int64_t batch) const;
  /// moments[emitter] is the sum, since first_iteration(), of the squares of what each photon added to the picture, in
  /// any unit. They are taken for the variance, as is right for few photons a pixel and batch. halves: of the film,
  /// each with its own low-discrepancy sequence. A tenth of the photons keeps its first allocation.
  void reallocate(std::int64_t batch, std::span<const std::int64_t> moments, unsigned halves);
  /// Restores the first allocation from this batch on.
  void restore_initial(std::int64_t batch, unsigned halves);
  /// The gain of the allocation: the variance of a batch as allocated first over that of a batch as allocated last, as
  /// measured by reallocate(). 1 before there were two allocations, or where nothing was measured.
  double gain() const;

  void serialize(tracing::Archive& archive);

private:
  std::vector<shared::DeviceEmitter> emitters_;
  std::vector<unsigned> initial_counts_;  ///< [emitter] photons of a batch at the start
  std::vector<double> initial_shares_;    ///< [emitter] share of the photons at the start
  std::vector<double> squares_, photons_; ///< [emitter] sums of n^2 moments and of n batches: the ratio estimates V_e
  double first_variance_ = 0, last_variance_ = 0; ///< variances of a batch, in the unit of `moments`; 0: not known yet
  std::int64_t first_iteration_ = 0;

  void assign(std::int64_t batch, const std::vector<unsigned>& counts, unsigned halves);
};

/// Where a light's photons matter: a histogram over the numbers that give their directions (kernels/photons/guide.h),
/// learned from what earlier photons added to the picture. A cell's chance of a photon is proportional to the root of
/// the mean square of what its photons add; that makes the sum of all cells' variances smallest.
class EmissionGuide {
public:
  static constexpr std::size_t cells = std::size_t{GUIDE_BINS_X} * GUIDE_BINS_Y * GUIDE_BINS_Z;
  static constexpr std::size_t floats = GUIDE_FLOATS; ///< floats of a light in table()

  /// All cells of all lights have the same chance at first. lights is the number of lights.
  explicit EmissionGuide(std::size_t lights);

  /// The table [light][GUIDE_FLOATS]; kernels/photons/guide.h describes it.
  const std::vector<float>& table() const { return table_; }
  /// moments[light][GUIDE_CELLS] is the sum over `batches` batches of the squares of what each photon added to the
  /// picture, in any unit. photons[light] is their number in each of those batches. Every cell keeps a chance.
  void learn(std::span<const std::int64_t> moments, std::span<const double> photons, double batches);
  /// Learns from now on alone; until then the chances stay.
  void forget();

  void serialize(tracing::Archive& archive);

private:
  std::vector<double> chance_;            ///< [light][cell]: a photon's chance of a cell; sums to 1 for each light
  std::vector<double> squares_, samples_; ///< [light][cell]: the ratio estimates an even photon's mean square
  std::vector<float> table_;
};

} // namespace nephroid::photons
