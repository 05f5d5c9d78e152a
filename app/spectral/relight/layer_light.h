// SPDX-License-Identifier: Apache-2.0
// The light that layers are weighed by (kernels/spectral/layers.h), which may change while a run goes on, and by how much. On the host,
// without OpenCL.
#pragma once
#include "optics/colour.h"
#include "preset/preset.h"
#include "scene/scene.h"
#include "spectral/tables/run_tables.h"

#include <vector>

namespace nephroid::spectral {

/// What may change.
struct LayerLight {
  std::vector<optics::Spectrum> spectra; ///< of each light of the preset, sums to 1
  std::vector<double> power;             ///< W, or W m^-2 of a directional light
  double white = 1;                      ///< preset::Preset::white

  double strongest() const; ///< the largest power, 1 where all are 0
};

LayerLight layer_light(const scene::Scene& scene, double white);
/// Of a preset with the same lights but for these. Throws bad_input at FILE#/scene/lights/INDEX/spectrum.
LayerLight layer_light(const preset::Preset& preset);

/// Linear sRGB over white of what a layer of value 1 adds to the picture where a reflector is seen.
struct LayerWeights {
  std::vector<optics::Colour> clusters; ///< [light][cluster][reflector]
  std::vector<optics::Colour> all;      ///< [light][reflector]: of all wavelengths
};
LayerWeights layer_weights(const LayerLight& light, const tracing::WavelengthTables& tables);

/// What kernels ask of reflectors where a pixel's survey missed one.
struct FlatLight {
  std::vector<float> mean_reflectance; ///< [cluster][reflector], then by luminance over all wavelengths: [reflector]
  std::vector<float> luminance_share;  ///< [cluster]; of light that has the same power at every wavelength
};
FlatLight flat_light(const tracing::WavelengthTables& tables);

} // namespace nephroid::spectral
