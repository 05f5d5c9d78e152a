// SPDX-License-Identifier: Apache-2.0
// Where the baked spheres stand in the scene. A bake has coordinates of its own, so that it stays right when the preset turns or moves what
// was baked (caster.h).
#pragma once
#include "environment/bake/caster.h"
#include "preset/preset.h"
#include "scene/scene.h"

#include <glm/glm.hpp>

namespace nephroid::environment {

/// From the bake's coordinates (those of Caster::scene and Bake, whose spheres are about (0, 0, 0)) to the scene's (of
/// scene::Scene::origin). Both are in units of the preset. Directions, of light too, are turned alone.
struct Placement {
  glm::dmat3 turn{1};   ///< a rotation; its transpose leads back
  glm::dvec3 middle{0}; ///< of the spheres, in the scene's coordinates
};

/// scene: of the preset. caster: of the preset, or of another one in which only objects, lights and cameras are turned and moved.
Placement placement(const preset::Preset& preset, const Caster& caster, const scene::Scene& scene);

} // namespace nephroid::environment
