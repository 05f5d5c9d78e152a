// SPDX-License-Identifier: Apache-2.0
// The environment as kernels/spectral/background.cl reads it, beside its texels: what the eye makes of the primaries' spectra, which
// wavelengths paths have, and scales.
#pragma once
#include "kernels/tracing/shared_types.h"
#include "preset/preset.h"
#include "scene/scene.h"

#include <vector>

namespace nephroid::spectral {

struct BackgroundTables {
  shared::DeviceBackground size{};
  std::vector<shared::float4> primary_xyz; ///< [401, all of them at the end][primary]
  std::vector<float> spectrum_cdf;         ///< [401]: exact_cdf of what the eye makes of a grey environment
  double film_scale = 1;                   ///< quanta per unit of the picture's values, a power of two
  double limit = 1;                        ///< quanta that one contribution may have
};

/// pixel_samples: that the film is to hold.
BackgroundTables make_background_tables(const scene::Environment& environment, int pixel_samples);

/// Whether no glass that an object is of bends one wavelength otherwise than another.
bool goes_one_way(const scene::Scene& scene);

} // namespace nephroid::spectral
