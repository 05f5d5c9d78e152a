// SPDX-License-Identifier: Apache-2.0
// What engine 1 works out of a preset on the host.
#pragma once
#include "spectral/effort/importance.h"
#include "spectral/engine.h"
#include "tests/support/presets.h"
#include "tests/support/test.h"

namespace nephroid::test {

inline spectral::RunPlan plan_of(const preset::Preset& p)
{
  const scene::Scene scene = scene::load_scene(p);
  return spectral::make_plan(p, scene, scene::build_bvh(scene.geometry));
}

inline spectral::RunTables tables_of(const preset::Preset& p)
{
  const scene::Scene scene = scene::load_scene(p);
  return spectral::make_lit_tables(p, scene, scene::build_bvh(scene.geometry), {});
}

inline spectral::WavelengthImportance importance_of(const preset::Preset& p)
{
  const scene::Scene scene = scene::load_scene(p);
  return spectral::wavelength_importance(spectral::settings(p), scene, scene::build_bvh(scene.geometry));
}

} // namespace nephroid::test
