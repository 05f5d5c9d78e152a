// SPDX-License-Identifier: Apache-2.0
// What is to be shown and under which light, worked out once on the host.
#pragma once
#include "compute/compute.h"
#include "environment/bake/caster.h"
#include "environment/light/distant_lights.h"
#include "environment/segment/cube.h"
#include "environment/settings.h"
#include "preset/preset.h"
#include "scene/bvh.h"
#include "scene/move.h"
#include "scene/scene.h"
#include "tracing/scene_tables.h"

#include <memory>
#include <optional>
#include <vector>

namespace nephroid::environment {

struct RenderTask {
  std::shared_ptr<const scene::Scene> scene; ///< its environment is a light
  std::shared_ptr<const scene::Bvh> bvh;     ///< its tree
  tracing::SceneTables tables;
  compute::Defines defines;               ///< of kernels that trace the scene
  bool coloured = false;                  ///< paths from the eye have one wavelength each
  Placement placement;                    ///< of the bake
  std::vector<glm::dvec3> surface_points; ///< of the object: surface_points()

  bool has_surroundings = false; ///< whether there is more in the scene than the object
  scene::Scene surroundings;     ///< the scene without it

  CubeMap cube;              ///< of the environment; empty where there is none
  Segmentation segmentation; ///< of the cube
  std::vector<DistantLight> lamps;

  Settings settings;       ///< the preset's
  bool has_medium = false; ///< whether caustics are seen in the air
};

/// What of a task changes when objects move.
struct MovedObjects {
  std::shared_ptr<const scene::Scene> scene;
  Placement placement;
  std::vector<glm::dvec3> surface_points;
  shared::DeviceCamera camera{};
  std::optional<scene::Scene> surroundings; ///< where others than the caster move
};

/// Whether the scene has light: else only the bake is shown.
bool has_light(const scene::Scene& scene);

/// caster: of the preset. bvh: of the scene. before: a task whose environment is kept where it is the same. Throws
/// bad_input as `lamps`.
RenderTask make_render_task(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh,
                            const Caster& caster, const RenderTask* before = nullptr);

/// What is seen behind everything; black where there is no environment.
const scene::Environment& backdrop(const scene::Scene& scene);

/// Whether the map has one colour all around, so that there is nothing to look for.
bool is_cut_evenly(const preset::Preset& preset, const CubeMap& cube);

/// As scene::move_objects. loaded: of `before`. shown: what the surroundings were last made for. caster: of the
/// presets.
std::optional<MovedObjects> move_objects(const RenderTask& loaded, const preset::Preset& before,
                                         const preset::Preset& shown, const preset::Preset& now, const Caster& caster);

/// The preset's lights of the cube, by its settings.
Segmentation segment_by(const preset::Preset& preset, const CubeMap& cube);

} // namespace nephroid::environment
