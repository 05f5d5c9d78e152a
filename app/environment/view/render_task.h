// SPDX-License-Identifier: Apache-2.0
// What is shown and under which light, worked out once on the host.
#pragma once
#include "compute/compute.h"
#include "environment/bake/caster.h"
#include "environment/light/distant_lights.h"
#include "environment/segment/cube.h"
#include "environment/settings.h"
#include "preset/preset.h"
#include "scene/bvh.h"
#include "scene/scene.h"
#include "tracing/scene_tables.h"

#include <memory>
#include <optional>
#include <vector>

namespace nephroid::environment {

struct RenderTask {
  std::shared_ptr<const scene::Scene> scene; ///< its environment is a light
  std::shared_ptr<const scene::Bvh> bvh;     ///< the scene's tree
  tracing::SceneTables tables;
  compute::Defines defines;           ///< for kernels that trace the scene
  bool coloured = false;              ///< paths from the eye have one wavelength each
  Placement placement;                ///< the bake's
  std::vector<glm::dvec3> viewpoints; ///< in the scene: from where it is seen what hides a light

  bool has_surroundings = false; ///< whether there is more in the scene than the object
  scene::Scene surroundings;     ///< the scene without the object

  CubeMap cube;              ///< the environment's; empty where there is none
  Segmentation segmentation; ///< the cube's
  std::vector<DistantLight> lamps;

  Settings settings;       ///< the preset's
  bool has_medium = false; ///< whether caustics are seen in the air
};

/// The part of a task that changes when objects move.
struct MovedObjects {
  std::shared_ptr<const scene::Scene> scene;
  Placement placement;
  std::vector<glm::dvec3> viewpoints;
  shared::DeviceCamera camera{};
  std::optional<scene::Scene> surroundings; ///< empty where only the caster moves
};

/// Whether the scene has light. Without light only the bake is shown.
bool has_light(const scene::Scene& scene);

/// caster: the preset's. before: a task whose cube is kept where it is the same. Throws bad_input as `lamps` does.
RenderTask make_render_task(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh,
                            const Caster& caster, const RenderTask* before = nullptr);

/// The environment as it is seen; black where there is none.
const scene::Environment& backdrop(const scene::Scene& scene);

/// Whether the map has one colour all around, so that no cuts need be searched.
bool is_cut_evenly(const preset::Preset& preset, const CubeMap& cube);

/// As scene::move_objects. loaded: the task of `before`. shown: the preset that the surroundings were made for.
std::optional<MovedObjects> move_objects(const RenderTask& loaded, const preset::Preset& before,
                                         const preset::Preset& shown, const preset::Preset& now, const Caster& caster);

SegmentSettings segment_settings(const preset::Preset& preset);
/// Cuts the cube into lights by segment_settings(preset).
Segmentation segment_by(const preset::Preset& preset, const CubeMap& cube);

} // namespace nephroid::environment
