// SPDX-License-Identifier: Apache-2.0
// The tables over wavelength of device_scene.h, and which row of them each material has.
#pragma once
#include "spectral/tables/device_scene.h"

namespace nephroid::spectral {

/// For `lights` of the scene; fills materials[i].type, reflector and attenuator and every table. Only materials that an object uses get
/// rows. lit: which wavelengths stay in the clusters; a cluster's index of refraction is the mean over all that it had.
WavelengthTables make_wavelength_tables(const scene::Scene& scene, const std::vector<const scene::Light*>& lights,
                                        const std::vector<std::vector<int>>& clusters, const std::vector<bool>& lit,
                                        std::vector<shared::DeviceMaterial>& materials);

} // namespace nephroid::spectral
