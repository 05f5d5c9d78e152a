// SPDX-License-Identifier: Apache-2.0
// What a scene does not need: the facts that decide it, and the plan's rows that say so.
#pragma once
#include "plan/plan.h"
#include "tracing/scene_tables.h"

#include <map>
#include <string>
#include <vector>

namespace nephroid::tracing {

bool has_power(const scene::Light& light);
/// [401]: whether any light with power has the wavelength; true for all where no light has power.
std::vector<bool> lit_wavelengths(const scene::Scene& scene);

/// By the lobes of their materials: one may be specular and diffuse. A mirror is specular alone, and no light passes.
struct ObjectCounts {
  int specular = 0, mirrors = 0, diffuse = 0, smooth = 0;
  bool throw_caustics() const { return specular > 0; }
};
ObjectCounts count_objects(const scene::Scene& scene);

/// False only where no glass object or mirror is in the camera's view or encloses the camera.
bool may_see_glass_or_mirror(const scene::Scene& scene);

/// Rows of the plan for what may be left out. What the scene does not need runs where nothing is left out.
plan::Decision needed(const std::string& name, std::string reason);
plan::Decision not_needed(const std::string& name, bool leave_out, std::string reason);

/// What the tables leave out: rows for what the scene has and does not need. targets: SceneTables::spheres.
std::vector<plan::Decision> data_omissions(const LeaveOut& leave_out, const scene::Scene& scene,
                                           const std::vector<scene::Sphere>& targets);

struct CodeOmissions {
  std::vector<plan::Decision> decisions;
  std::map<std::string, std::string> defines; ///< -D flags
};
/// takes_light: of WavelengthTables.
CodeOmissions code_omissions(const LeaveOut& leave_out, const scene::Scene& scene, bool takes_light);

} // namespace nephroid::tracing
