// SPDX-License-Identifier: Apache-2.0
#include "environment/view/render_task.h"

#include "environment/bake/baker.h"
#include "scene/move.h"
#include "tracing/omissions.h"

#include <algorithm>

namespace nephroid::environment {
namespace {

/// placement: the object's in the scene.
std::vector<glm::dvec3> viewpoints_of(const preset::Preset& preset, const scene::Scene& scene, const Caster& caster,
                                      const Placement& placement) {
  if (settings(preset).occlusion == Settings::Occlusion::thesis) return {placement.middle};
  return surface_points(scene, caster.objects, 1024);
}

bool shines(const scene::Scene& scene) { return scene.environment && !scene.environment->is_black(); }

/// The scene with its environment as a light, which it always is to this engine, whatever `lights` says.
std::shared_ptr<const scene::Scene> lit_scene(const scene::Scene& scene) {
  auto lit = std::make_shared<scene::Scene>(scene);
  if (shines(scene) && !scene.environment->lights) {
    lit->environment->lights = true;
    lit->lights.push_back(scene::make_environment_light(*scene.environment));
  }
  return lit;
}

bool same_light(const scene::Environment& a, const scene::Environment& b) {
  return a.width == b.width && a.radiance == b.radiance && a.rgb == b.rgb;
}

} // namespace

bool has_light(const scene::Scene& scene) {
  return shines(scene) || std::ranges::any_of(scene.lights, tracing::has_power);
}

const scene::Environment& backdrop(const scene::Scene& scene) {
  static const scene::Environment black{1, 1, {0, 0, 0}, 0, 0, false};
  return scene.environment ? *scene.environment : black;
}

bool is_cut_evenly(const preset::Preset& preset, const CubeMap& cube) {
  const Settings& s = settings(preset);
  return preset.leave_out && cube.even && 2 * s.lights * s.threshold < 1; // otherwise regions would be dropped
}

SegmentSettings segment_settings(const preset::Preset& preset) {
  const Settings& s = settings(preset);
  return {.lights = s.lights, .method = s.segmentation, .weights = s.weights, .threshold = s.threshold};
}

Segmentation segment_by(const preset::Preset& preset, const CubeMap& cube) {
  const SegmentSettings by = segment_settings(preset);
  return is_cut_evenly(preset, cube) ? even_segments(cube, by.lights) : segment(cube, by);
}

RenderTask make_render_task(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh,
                            const Caster& caster, const RenderTask* before) {
  const tracing::LeaveOut leave_out{.all = preset.leave_out};
  RenderTask task;
  task.scene = lit_scene(scene);
  task.bvh = std::make_shared<const scene::Bvh>(bvh);
  task.lamps = lamps(scene);
  task.placement = placement(preset, caster, scene);
  task.viewpoints = viewpoints_of(preset, scene, caster, task.placement);
  task.tables = tracing::make_scene_tables(*task.scene, {optics::all_wavelengths()}, leave_out);
  task.coloured = is_coloured(task.tables.wavelengths);
  task.defines = tracing::code_omissions(leave_out, *task.scene, task.tables.wavelengths.takes_light).defines;
  task.defines.merge(scene::tree_defines(bvh));
  task.defines["NEPHROID_JITTER"] = std::to_string(int(task.coloured));
  task.defines["NEPHROID_DIFFERENTIALS"] = std::to_string(0);

  task.surroundings = without_caster(scene, caster.objects);
  task.has_surroundings = !task.surroundings.object_of_primitive.empty();
  const Settings& s = task.settings = settings(preset);
  task.has_medium = s.extinction > 0 && s.albedo > 0;
  if (shines(scene)) {
    task.cube = before && shines(*before->scene) && same_light(*before->scene->environment, *scene.environment)
                    ? before->cube
                    : make_cube_map(*scene.environment);
    task.segmentation = segment_by(preset, task.cube);
  }
  return task;
}

std::optional<MovedObjects> move_objects(const RenderTask& loaded, const preset::Preset& before,
                                         const preset::Preset& shown, const preset::Preset& now, const Caster& caster) {
  std::optional<scene::Scene> scene = scene::move_objects(*loaded.scene, before, now);
  if (!scene) return {};
  MovedObjects moved;
  moved.camera = tracing::device_camera(scene->camera, Location(now.source) / "scene" / "camera");
  moved.placement = placement(now, caster, *scene);
  moved.viewpoints = viewpoints_of(now, *scene, caster, moved.placement);
  for (std::size_t i = 0; i < now.scene.objects.size() && !moved.surroundings; ++i)
    if (!std::ranges::count(caster.objects, i) && now.scene.objects[i].transform != shown.scene.objects[i].transform)
      moved.surroundings = without_caster(*scene, caster.objects);
  moved.scene = std::make_shared<const scene::Scene>(std::move(*scene));
  return moved;
}

} // namespace nephroid::environment
