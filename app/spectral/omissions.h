// SPDX-License-Identifier: Apache-2.0
// What a scene does not need of engine 1: the facts that decide it, and the plan's passes that say so.
#pragma once
#include "plan/plan.h"
#include "preset/preset.h"
#include "scene/scene.h"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace nephroid::spectral {

bool has_power(const scene::Light& light);
/// [401]: which wavelengths a light with power has; all of them where no light has power.
std::vector<bool> lit_wavelengths(const scene::Scene& scene);

/// How many objects there are of each kind.
struct ObjectCounts {
  int dielectrics = 0, mirrors = 0, diffuse = 0, smooth = 0;
};
ObjectCounts count_objects(const scene::Scene& scene);

/// False only where no object of glass and no mirror is in the camera's view, and none encloses the camera.
bool may_see_glass_or_mirror(const scene::Scene& scene);

/// A pass of the plan for one field of preset::LeaveOut, `key`: it runs where the scene needs it or the field is false.
/// reason: why the scene needs it or not.
plan::Pass omission(const std::string& key, bool leave_out, bool needed, std::string reason);

/// What the tables of a scene do without; only what there is something of to leave out. targets: DeviceTables::spheres.
std::vector<plan::Pass> data_omissions(const preset::LeaveOut& leave_out, const scene::Scene& scene,
                                       const std::vector<scene::Sphere>& targets);

/// What kernels are compiled without. attenuators: materials that take light away.
std::vector<plan::Pass> code_omissions(const preset::LeaveOut& leave_out, const scene::Scene& scene, int attenuators);

/// The -D flags of `passes` as made by code_omissions.
std::map<std::string, std::string> omission_defines(const std::vector<plan::Pass>& passes, const scene::Scene& scene, int attenuators);

} // namespace nephroid::spectral
