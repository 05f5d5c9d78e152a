// SPDX-License-Identifier: Apache-2.0
// What photons and paths from the eye do for a preset, and what is left out.
#pragma once
#include "photons/settings.h"
#include "photons/tables/run_tables.h"
#include "plan/plan.h"
#include "preset/preset.h"
#include "scene/bvh.h"
#include "scene/scene.h"

#include <vector>

namespace nephroid::photons {

struct RunPart; ///< plan_part.h

/// The decisions about a run, made once, and the tables that they needed.
struct RunPlan : plan::Plan {
  Settings settings;
  RunTables tables;
  std::string why_no_layers;         ///< why spectral.relight cannot be done, wanted or not; empty where it can
  std::vector<const RunPart*> parts; ///< parts that run; stages in the order of their turns in a pass
  bool runs(const RunPart& part) const;
};

/// Throws bad_input as make_run_tables (relight/layer_light.h) does.
RunPlan make_plan(const preset::Preset& preset, const Settings& settings, const scene::Scene& scene,
                  const scene::Bvh& bvh, const tracing::LeaveOut& leave_out);

} // namespace nephroid::photons
