// SPDX-License-Identifier: Apache-2.0
// The light that layers are weighed by (kernels/photons/layers.h), which may change while a run goes on, and the
// weights. Also what such a run does differently: its lights have unit power, and its work serves lights to come.
#pragma once
#include "optics/colour.h"
#include "photons/settings.h"
#include "photons/tables/run_tables.h"
#include "preset/preset.h"
#include "scene/bvh.h"
#include "scene/scene.h"

#include <vector>

namespace nephroid::photons {

struct LayerLight {
  std::vector<optics::Spectrum> spectra; ///< spectrum of each light of the preset, sums to 1
  std::vector<double> power;             ///< W, or W m^-2 for a directional light
  double white = 1;                      ///< preset::Preset::white

  double strongest() const; ///< the largest power; 1 where all are 0
};

LayerLight layer_light(const scene::Scene& scene, double white);
/// The light of a preset that differs in nothing but its lights. Throws bad_input at FILE#/scene/lights/INDEX/spectrum.
LayerLight layer_light(const preset::Preset& preset);

/// Linear sRGB over white that a layer of value 1 adds to the picture where a reflector is seen.
struct LayerWeights {
  std::vector<optics::Colour> clusters; ///< [light][cluster][reflector]
  std::vector<optics::Colour> whole;    ///< [light][reflector]: over all wavelengths
};
LayerWeights layer_weights(const LayerLight& light, const tracing::WavelengthTables& tables);

/// Adds to radiance [wavelength], in W m^-2 sr^-1 nm^-1, the light of a layer of this value where a reflector is seen.
/// cluster is an index into WavelengthTables::clusters; -1: all wavelengths.
void add_radiance(const LayerLight& light, const tracing::WavelengthTables& tables, std::size_t light_index,
                  int cluster, int reflector, double value, std::vector<double>& radiance);

/// What kernels need of reflectors where a pixel's survey missed one.
struct FlatLight {
  std::vector<float> mean_reflectance; ///< [cluster][reflector], then by luminance over all wavelengths: [reflector]
  std::vector<float> luminance_share;  ///< [cluster]: for light with the same power at every wavelength
};
FlatLight flat_light(const tracing::WavelengthTables& tables);

/// The tables of make_lit_tables for a run. Where it keeps layers, every light has 1 W (W m^-2), no light and no
/// wavelength is left out for being dark, and work is allocated by layer_emitters and layer_cluster_cdf.
RunTables make_run_tables(const preset::Preset& preset, const Settings& settings, const scene::Scene& scene,
                          const scene::Bvh& bvh, tracing::LeaveOut leave_out);

/// Energy quanta per W (W m^-2), like RunTables::energy_scale, but for the light's power instead of unit lights.
double layer_energy_scale(const LayerLight& light, const RunTables& tables);

/// Allocates half of the work by what the eye makes of the present light, and half to every cluster alike, for lights
/// to come. DeviceEmitter::share is the cluster's part of the light's power, in units of LayerLight::strongest().
/// tables have unit lights. Every light that reaches a target has an emitter for every cluster, whatever its power.
std::vector<shared::DeviceEmitter> layer_emitters(const LayerLight& light, const RunTables& tables, unsigned photons);
/// The cdf, [cluster + 1], by which a path through glass takes a cluster.
std::vector<float> layer_cluster_cdf(const LayerLight& light, const tracing::WavelengthTables& tables);

} // namespace nephroid::photons
