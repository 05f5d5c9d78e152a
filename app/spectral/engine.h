// SPDX-License-Identifier: Apache-2.0
// Engine 1, spectral caustics: photons of wavelength clusters, splatted on diffuse receivers (thesis chapter 4).
#pragma once
#include "engine/engine.h"
#include "photons/job.h"
#include "spectral/settings.h"

namespace nephroid::spectral {

extern const engine::Engine engine;

/// Plans a run. leave_out: for tests; by default what the preset says. Throws bad_input as photons::make_plan.
photons::RunPlan make_plan(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh);
photons::RunPlan make_plan(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh,
                           const tracing::LeaveOut& leave_out);

/// Whether `now` differs from `before`, which keeps layers, in its lights' spectra and powers, white and texts alone.
bool adoptable(const preset::Preset& before, const preset::Preset& now);

} // namespace nephroid::spectral
