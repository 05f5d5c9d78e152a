// SPDX-License-Identifier: Apache-2.0
// Where a light's photons matter: a histogram over the numbers that their directions are made of (kernels/spectral/guide.h), learned from
// what earlier photons added to the picture. A photon's chance is proportional to the root of the mean square of what photons of its cell
// add, which gives the sum of all cells' variances its smallest value. No OpenCL here.
#pragma once
#include "kernels/tracing/shared_types.h"
#include "tracing/state.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace nephroid::spectral {

class EmissionGuide {
public:
  static constexpr std::size_t cells = std::size_t{GUIDE_BINS_X} * GUIDE_BINS_Y * GUIDE_BINS_Z;
  static constexpr std::size_t floats = GUIDE_BINS_X + std::size_t{GUIDE_BINS_X} * GUIDE_BINS_Y + cells; ///< of a light in table()

  /// Even for all lights. lights: how many.
  explicit EmissionGuide(std::size_t lights);

  /// [light][GUIDE_FLOATS], see kernels/spectral/guide.h.
  const std::vector<float>& table() const { return table_; }
  /// moments: [light][GUIDE_CELLS], summed over `passes` passes: the square of what each photon added to the picture, in any unit.
  /// photons: [light] of a pass, in those passes. Every cell keeps a chance, however dark it was.
  void learn(std::span<const std::int64_t> moments, std::span<const double> photons, double passes);

  void state(tracing::State& state);

private:
  std::vector<double> chance_;            ///< [light][cell]: of a photon of the light; sums to 1 for each light
  std::vector<double> squares_, samples_; ///< [light][cell]: their ratio estimates the mean square of an even photon, times the volume
  std::vector<float> table_;
};

} // namespace nephroid::spectral
