// SPDX-License-Identifier: Apache-2.0
// Photons of a round are allocated to emitters, pairs of a light and a wavelength cluster, and leave lights in
// directions where they matter. What is called a pass here is a round of those photons, of which a pass of the run has
// several (RunTables::batches). No OpenCL here.
#pragma once
#include "kernels/tracing/shared_types.h"
#include "tracing/state.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nephroid::photons {

/// A light and a cluster that photons may be allocated to.
struct PhotonSource {
  double weight = 0; ///< photons are allocated in proportion
  int light = 0;     ///< index in the table of lights
  int cluster = 0;
  double share = 0; ///< DeviceEmitter::share
};

/// The emitters of those sources that allocate_photons gives photons, numbered. Sources of a light follow each other.
std::vector<shared::DeviceEmitter> make_emitters(const std::vector<PhotonSource>& sources, unsigned photons);

/// Photons of one pass for each weight, in proportion to it, none without at least one; sums to max(photons, number of
/// positive weights). What has weight 0 gets 0 photons.
std::vector<unsigned> allocate_photons(const std::vector<double>& weights, unsigned photons);

/// Fills DeviceEmitter::first_photon and the two of the light from the emitters' photon_count; emitters of a light
/// follow each other.
void number_photons(std::vector<shared::DeviceEmitter>& emitters);

/// Of all emitters together, once they are numbered.
unsigned count_photons(const std::vector<shared::DeviceEmitter>& emitters);

/// Moves an emitter's place in its low-discrepancy sequence on.
void advance_sequence(shared::DeviceEmitter& emitter, std::uint64_t photons);

/// Allocates the photons of a pass to the emitters by the variance that they had in earlier passes: among all ways to
/// allocate n photons, n_e in proportion to sqrt(V_e) gives the sum of the emitters' variances V_e / n_e its smallest
/// value, where V_e is the variance of one photon that carries all of the emitter's power.
class NeymanAllocation {
public:
  /// emitters: as allocated for the first passes, each with at least one photon.
  explicit NeymanAllocation(std::vector<shared::DeviceEmitter> emitters);

  const std::vector<shared::DeviceEmitter>& emitters() const { return emitters_; }
  /// The pass from which on emitters() are allocated so.
  std::int64_t first_iteration() const { return first_iteration_; }
  /// Whether photons are allocated anew before a pass: before passes 2, 4, 8, 16, ...
  bool is_due(std::int64_t pass) const;
  /// moments: [emitter], summed since first_iteration() over its photons: the square of what each added to the picture,
  /// in any unit; they are taken for the variance, which is right where a pixel gets few photons a pass. halves: of the
  /// film, each with its own low-discrepancy sequence. A tenth of the photons stays as it was allocated first, and
  /// every emitter keeps at least one.
  void reallocate(std::int64_t pass, std::span<const std::int64_t> moments, unsigned halves);
  /// The first allocation again from this pass on.
  void restore_initial(std::int64_t pass, unsigned halves);
  /// What the allocation has gained: the variance of a pass as allocated first over that of a pass as allocated last,
  /// of those that reallocate() was given; 1 before there were two allocations, or nothing to see.
  double gain() const;

  void state(tracing::State& state);

private:
  std::vector<shared::DeviceEmitter> emitters_;
  std::vector<unsigned> initial_counts_; ///< [emitter] photons of a pass at the start
  std::vector<double> initial_shares_;   ///< [emitter] share of the photons at the start
  std::vector<double> squares_,
      photons_; ///< [emitter] sum over allocations of n^2 moments and of n passes: their ratio estimates V_e
  double first_variance_ = 0, last_variance_ = 0; ///< of a pass, in the unit of `moments`; 0: not known yet
  std::int64_t first_iteration_ = 0;

  void assign(std::int64_t pass, const std::vector<unsigned>& counts, unsigned halves);
};

/// Where a light's photons matter: a histogram over the numbers that their directions are made of
/// (kernels/photons/guide.h), learned from what earlier photons added to the picture. A photon's chance is proportional
/// to the root of the mean square of what photons of its cell add, which gives the sum of all cells' variances its
/// smallest value. No OpenCL here.
class EmissionGuide {
public:
  static constexpr std::size_t cells = std::size_t{GUIDE_BINS_X} * GUIDE_BINS_Y * GUIDE_BINS_Z;
  static constexpr std::size_t floats =
      GUIDE_BINS_X + std::size_t{GUIDE_BINS_X} * GUIDE_BINS_Y + cells; ///< of a light in table()

  /// Even for all lights. lights: how many.
  explicit EmissionGuide(std::size_t lights);

  /// [light][GUIDE_FLOATS], see kernels/photons/guide.h.
  const std::vector<float>& table() const { return table_; }
  /// moments: [light][GUIDE_CELLS], summed over `passes` passes: the square of what each photon added to the picture,
  /// in any unit. photons: [light] of a pass, in those passes. Every cell keeps a chance, however dark it was.
  void learn(std::span<const std::int64_t> moments, std::span<const double> photons, double passes);

  void state(tracing::State& state);

private:
  std::vector<double> chance_; ///< [light][cell]: of a photon of the light; sums to 1 for each light
  std::vector<double> squares_,
      samples_; ///< [light][cell]: their ratio estimates the mean square of an even photon, times the volume
  std::vector<float> table_;
};

} // namespace nephroid::photons
