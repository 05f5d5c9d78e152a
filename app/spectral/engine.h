// SPDX-License-Identifier: Apache-2.0
// Engine 1, spectral caustics: photons of each wavelength cluster, splatted where the camera sees a diffuse receiver (thesis chapter 4).
#pragma once
#include "compute/compute.h"
#include "job/job.h"
#include "plan/plan.h"
#include "preset/preset.h"
#include "scene/bvh.h"
#include "scene/scene.h"

#include <memory>
#include <string>

namespace nephroid::spectral {

/// What runs, what is left out and why. Throws bad_input as make_device_tables does.
plan::Plan make_plan(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh);

/// The scene and tree are copied to the device; they need not outlive the call. plan: of the same preset and scene.
/// Throws failed where the device has not enough memory, BuildError for a kernel that does not compile.
std::unique_ptr<job::Job> make_job(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh, const plan::Plan& plan,
                                   const compute::Context& context);

/// The text of every kernel that a job may run, as this context would build it: pictures are kept by it (run/reference.h).
std::string kernel_sources(const compute::Context& context);

} // namespace nephroid::spectral
