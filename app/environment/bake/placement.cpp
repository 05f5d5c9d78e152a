// SPDX-License-Identifier: Apache-2.0
#include "environment/bake/placement.h"

#include "scene/scene.h"

namespace nephroid::environment {

// A point that the object has at p without its rotation R and its translation T is at R p + T in the preset.
Placement placement(const preset::Preset& preset, const Caster& caster, const scene::Scene& scene)
{
  const preset::Transform& transform = preset.scene.objects.at(caster.objects.front()).transform;
  const glm::dmat3 turn = scene::rotation(transform.rotate_deg);
  const glm::dvec3 translate(transform.translate[0], transform.translate[1], transform.translate[2]);
  return {turn, turn * caster.scene.origin + translate - scene.origin};
}

} // namespace nephroid::environment
