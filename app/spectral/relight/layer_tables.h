// SPDX-License-Identifier: Apache-2.0
// What a run that keeps layers does differently: unit lights, and work dealt out so that it serves lights to come. On the host, without
// OpenCL.
#pragma once
#include "scene/bvh.h"
#include "spectral/relight/layer_light.h"

#include <vector>

namespace nephroid::spectral {

/// make_lit_tables of what a run renders: where it keeps layers, every light has 1 W (W m^-2), none and no wavelength is left out for
/// being dark, and photons and paths through glass are dealt as layer_emitters and layer_cluster_cdf say. Throws as make_lit_tables.
RunTables make_run_tables(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh, tracing::LeaveOut leave_out);

/// Energy quanta per W (W m^-2) as RunTables::energy_scale, for the light's power rather than the tables' unit lights.
double layer_energy_scale(const LayerLight& light, const RunTables& tables);

/// Half of the work goes by what the eye makes of the present light, and half to every cluster alike, for lights to come.
/// DeviceEmitter::share is the cluster's part of the light's power, in units of LayerLight::strongest(). tables: of unit lights. Every
/// light that reaches a target has an emitter for every cluster, whatever its power.
std::vector<shared::DeviceEmitter> layer_emitters(const LayerLight& light, const RunTables& tables, unsigned photons);
/// [cluster + 1]: which cluster a path through glass takes.
std::vector<float> layer_cluster_cdf(const LayerLight& light, const tracing::WavelengthTables& tables);

} // namespace nephroid::spectral
