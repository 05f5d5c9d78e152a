// SPDX-License-Identifier: Apache-2.0
// Engine 1, spectral caustics: photons of each wavelength cluster, splatted where the camera sees a diffuse receiver (thesis chapter 4).
#pragma once
#include "compute/compute.h"
#include "engine/engine.h"
#include "job/job.h"
#include "plan/plan.h"
#include "preset/preset.h"
#include "scene/bvh.h"
#include "scene/scene.h"
#include "spectral/settings.h"
#include "spectral/tables/run_tables.h"

#include <memory>
#include <vector>

namespace nephroid::spectral {

struct RunPart; ///< plan_part.h

extern const engine::Engine engine;

/// What a run does, decided once, with the tables that this took.
struct RunPlan : plan::Plan {
  RunTables tables;
  std::vector<const RunPart*> parts; ///< that run; stages in the order of their turns in a pass
  bool runs(const RunPart& part) const;
};

/// Leaves out what the scene does not need where the preset says so. Throws bad_input as make_run_tables does.
RunPlan make_plan(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh);
/// Leaves out what is said, whatever the preset says: for tests of one omission.
RunPlan make_plan(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh, const tracing::LeaveOut& leave_out);

/// The scene and tree are copied to the device; they need not outlive the call. plan: of the same preset and scene.
/// Throws failed where the device has not enough memory, BuildError for a kernel that does not compile.
std::unique_ptr<job::Job> make_job(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh, const RunPlan& plan,
                                   const compute::Context& context);

/// Whether `now` is `before`, which keeps layers, but for the spectra and powers of its lights, its white, its name and its description.
/// Also true where nothing differs.
bool adoptable(const preset::Preset& before, const preset::Preset& now);

} // namespace nephroid::spectral
