// SPDX-License-Identifier: Apache-2.0
// The tables over wavelength of device_scene.h, and which row of them each material has.
#pragma once
#include "spectral/device_scene.h"

namespace nephroid::spectral {

/// For `lights` of the scene; fills materials[i].type, reflector and attenuator and every table. Only materials that an object uses get
/// rows. lit: which wavelengths stay in the clusters; a cluster's index of refraction is the mean over all that it had.
WavelengthTables make_wavelength_tables(const scene::Scene& scene, const std::vector<const scene::Light*>& lights,
                                        const std::vector<std::vector<int>>& clusters, const std::vector<bool>& lit,
                                        std::vector<shared::DeviceMaterial>& materials);

/// Photons of one pass for each emitter (light and cluster), in proportion to weight, none without at least one; sums to
/// max(photons, number of positive weights). Emitters of weight 0 are left out with 0 photons.
std::vector<unsigned> deal_out(const std::vector<double>& weights, unsigned photons);

/// Fills DeviceEmitter::first_photon and the two of the light from the emitters' photon_count; emitters of a light follow each other.
/// Returns how many photons there are in all.
unsigned number_photons(std::vector<shared::DeviceEmitter>& emitters);

/// Moves an emitter's place in its low-discrepancy sequence on.
void advance_sequence(shared::DeviceEmitter& emitter, std::uint64_t photons);

} // namespace nephroid::spectral
