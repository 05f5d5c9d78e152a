// SPDX-License-Identifier: Apache-2.0
// What engine 1 works out of a preset on the host.
#pragma once
#include "photons/effort/importance.h"
#include "spectral/engine.h"
#include "tests/support/presets.h"
#include "tests/support/test.h"

namespace nephroid::test {

inline photons::RunPlan plan_of(const preset::Preset& p) {
  const scene::Scene scene = scene::load_scene(p);
  return spectral::make_plan(p, scene, scene::build_bvh(scene.geometry));
}

inline photons::RunTables tables_of(const preset::Preset& p) {
  const scene::Scene scene = scene::load_scene(p);
  return photons::make_lit_tables(spectral::settings(p), scene, scene::build_bvh(scene.geometry), {});
}

inline photons::WavelengthImportance importance_of(const preset::Preset& p) {
  const scene::Scene scene = scene::load_scene(p);
  return photons::wavelength_importance(spectral::settings(p), scene, scene::build_bvh(scene.geometry));
}

} // namespace nephroid::test
