// SPDX-License-Identifier: Apache-2.0
// What the menu "Add" and a dropped mesh put into a scene, and "Delete" takes out: where the camera looks, on the
// ground, beside what is there, with the material that it needs. Nothing of it has to be mended first.
#pragma once
#include "scene/scene.h"
#include "ui/state/selection.h"

namespace nephroid::ui {

enum class Thing { sphere, glass, table, lamp, sun, sky };

struct Addition {
  preset::Preset preset;
  Selection selection; ///< what was added
};
/// The preset must have a scene. Light that is added has the white found anew.
Addition with_thing(preset::Preset preset, Thing thing);

/// Without an object, which takes the lamps with it that are its surface, a light or the environment; the preset must
/// have it. It may be named elsewhere.
preset::Preset without_thing(preset::Preset preset, const Selection& selection);

/// The same scene seen whole by a camera that looks the same way; the preset's own camera where there is nothing to
/// see.
preset::Camera camera_on_all(const preset::Preset& preset);

/// The shorter side of the visible rectangle in the plane of the camera's target.
double view_at_target(const preset::Camera& camera);
/// Where a body of these edge lengths is to stand: the middle of its foot. size: more than 0.
glm::dvec3 free_place(const preset::Preset& preset, const glm::dvec3& size);
/// The preset's first dielectric that is no thin pane; without one new N-BK7.
std::string glass_of(preset::Scene& scene);

} // namespace nephroid::ui
