// SPDX-License-Identifier: Apache-2.0
// Photons of a pass are dealt to emitters: pairs of a light and a wavelength cluster.
#pragma once
#include "kernels/tracing/shared_types.h"

#include <cstdint>
#include <vector>

namespace nephroid::spectral {

/// A light and a cluster that photons may be dealt to.
struct PhotonSource {
  double weight = 0; ///< photons are dealt in proportion
  int light = 0;     ///< index in the table of lights
  int cluster = 0;
  double share = 0; ///< DeviceEmitter::share
};

/// The emitters of those sources that deal_out gives photons, numbered. Sources of a light follow each other.
std::vector<shared::DeviceEmitter> make_emitters(const std::vector<PhotonSource>& sources, unsigned photons);

/// Photons of one pass for each weight, in proportion to it, none without at least one; sums to max(photons, number of positive weights).
/// What has weight 0 gets 0 photons.
std::vector<unsigned> deal_out(const std::vector<double>& weights, unsigned photons);

/// Fills DeviceEmitter::first_photon and the two of the light from the emitters' photon_count; emitters of a light follow each other.
void number_photons(std::vector<shared::DeviceEmitter>& emitters);

/// Of all emitters together, once they are numbered.
unsigned count_photons(const std::vector<shared::DeviceEmitter>& emitters);

/// Moves an emitter's place in its low-discrepancy sequence on.
void advance_sequence(shared::DeviceEmitter& emitter, std::uint64_t photons);

} // namespace nephroid::spectral
