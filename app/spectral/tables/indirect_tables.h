// SPDX-License-Identifier: Apache-2.0
// What photons of the layer "indirect" start with (kernels/spectral/indirect.cl), beside the tables of the scene.
#pragma once
#include "spectral/tables/run_tables.h"

#include <vector>

namespace nephroid::spectral {

struct IndirectTables {
  shared::DeviceTarget everything{};           ///< photons are sent into it from wherever a light is
  float outside_distance = 0;                  ///< directional photons start this far before it
  std::vector<shared::DeviceEmitter> emitters; ///< photons of one pass: one emitter for each light; cluster and share are not used
  std::vector<float> spectrum_cdf;             ///< [light][member of cluster_wavelengths]: whole numbers of 2^-24, the last 1
  unsigned photons_per_pass = 0;               ///< as dealt out: at least one for each light
  double emitted_w = 0;                        ///< in a pass, by all lights, all wavelengths
  double film_scale = 1, energy_scale = 1;     ///< quanta per unit of XYZ radiance and per watt, powers of two
};

/// tables: of the same scene. photons: wanted in a pass.
IndirectTables make_indirect_tables(const scene::Scene& scene, const RunTables& tables, unsigned photons);

} // namespace nephroid::spectral
