// SPDX-License-Identifier: Apache-2.0
#include "run/run.h"

#include "engine/engine.h"
#include "run/content.h"
#include "run/memory.h"

#include <cstring>
#include <utility>
#include <vector>

namespace nephroid::run {
namespace {

/// Whether two presets load the same scene but for the camera.
bool same_but_camera(const preset::Preset& a, const preset::Preset& b)
{
  preset::Scene scene = a.scene;
  scene.camera = b.scene.camera;
  return a.source == b.source && a.unit == b.unit && scene == b.scene;
}

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b)
{
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool same_triangles(const scene::Mesh& a, const scene::Mesh& b)
{
  return same_bytes(a.positions, b.positions) && same_bytes(a.triangles, b.triangles);
}

/// What the scene that `lender` lends was read from, at its time.
std::vector<plan::Input> inputs_of_scene(const Prepared& lender)
{
  preset::Preset scene_only;
  scene_only.source = lender.preset.source;
  scene_only.scene = lender.preset.scene;
  return read_inputs(scene_only, lender.plan->inputs);
}

LoadedScene load(const preset::Preset& preset, const Prepared* previous, bool lends_scene)
{
  if (lends_scene) {
    LoadedScene loaded = *previous->loaded;
    loaded.scene.camera = scene::make_camera(preset.scene.camera, loaded.scene);
    return loaded;
  }
  LoadedScene loaded{scene::load_scene(preset), nullptr};
  if (previous && same_triangles(loaded.scene.geometry, previous->loaded->scene.geometry))
    loaded.bvh = previous->loaded->bvh;
  else
    loaded.bvh = std::make_shared<const scene::Bvh>(scene::build_bvh(loaded.scene.geometry));
  return loaded;
}

} // namespace

Prepared prepare(const preset::Preset& preset, const Prepared* previous)
{
  const bool lends_scene = previous && same_but_camera(preset, previous->preset);
  // Before the files are loaded: of one that is written meanwhile the run is bound to what it held before, and goes on nowhere.
  std::vector<plan::Input> inputs = read_inputs(preset, lends_scene ? inputs_of_scene(*previous) : std::vector<plan::Input>());
  auto loaded = std::make_shared<const LoadedScene>(load(preset, previous, lends_scene));
  std::unique_ptr<plan::Plan> plan = engine::engine_of(preset).plan(preset, loaded->scene, *loaded->bvh);
  plan->buffers.push_back(picture_and_files(*plan, loaded->scene.camera.width, loaded->scene.camera.height));
  plan->inputs = std::move(inputs);
  return {preset, std::move(loaded), std::move(plan)};
}

void require_memory(const Prepared& prepared, const compute::Context& context)
{
  const scene::Camera& camera = prepared.loaded->scene.camera;
  require_memory(*prepared.plan, camera.width, camera.height, context.device(), available_memory_bytes());
}

std::unique_ptr<job::Job> make_job(const Prepared& prepared, const compute::Context& context)
{
  require_memory(prepared, context);
  return engine::engine_of(prepared.preset).job(prepared.preset, prepared.loaded->scene, *prepared.loaded->bvh, *prepared.plan, context);
}

} // namespace nephroid::run
