// SPDX-License-Identifier: Apache-2.0
// Runs engine 1 on a preset built in a test and hands back what it made.
#pragma once
#include "spectral/checks/render.h"
#include "spectral/engine.h"
#include "tests/support/plans.h"
#include "tests/support/test_kernels.h"

namespace nephroid::test {

using check::general_job;
using check::layer;

/// One context for all tests of a program: opening a device takes a second.
inline const compute::Context& shared_context() {
  static const compute::Context context = compute::Context::open(device_options());
  return context;
}

/// The same preset, but what a run would decide by what it measures is decided: plain pictures, whose statistics are
/// known.
inline preset::Preset plain(preset::Preset preset) {
  using photons::Settings;
  Settings& settings = spectral::settings(preset);
  if (settings.smoothing == Settings::Smoothing::automatic) settings.smoothing = Settings::Smoothing::off;
  if (settings.effort == Settings::Effort::automatic) settings.effort = Settings::Effort::power;
  return preset;
}

inline std::unique_ptr<job::Job> job_as_it_is(const preset::Preset& preset, const tracing::LeaveOut& leave_out,
                                              const compute::Context& context = shared_context()) {
  const scene::Scene scene = scene::load_scene(preset);
  const scene::Bvh bvh = scene::build_bvh(scene.geometry);
  return photons::make_job(preset, scene, bvh, spectral::make_plan(preset, scene, bvh, leave_out), context);
}

inline std::unique_ptr<job::Job> job_as_it_is(const preset::Preset& preset) {
  return job_as_it_is(preset, tracing::LeaveOut{.all = preset.leave_out});
}

/// With the kernels that are made for the scene.
inline std::unique_ptr<job::Job> specialised_job_of(const preset::Preset& preset, const tracing::LeaveOut& leave_out,
                                                    const compute::Context& context = shared_context()) {
  return job_as_it_is(plain(preset), leave_out, context);
}

/// With the general kernels: so all tests together build a few programs, which is most of their time.
/// tests/physics/leaving_out_test.cpp compares them with those made for a scene.
inline std::unique_ptr<job::Job> job_of(const preset::Preset& preset,
                                        const compute::Context& context = shared_context()) {
  return general_job(plain(preset), {.all = preset.leave_out}, context);
}

inline job::Snapshot render(job::Job& job) {
  while (!job.finished()) job.advance();
  return job.snapshot();
}

inline job::Snapshot render(const preset::Preset& preset, const compute::Context& context = shared_context()) {
  return render(*job_of(preset, context));
}

inline job::Snapshot render_as_it_is(const preset::Preset& preset, const compute::Context& context = shared_context()) {
  return render(*job_as_it_is(preset, tracing::LeaveOut{.all = preset.leave_out}, context));
}

} // namespace nephroid::test
