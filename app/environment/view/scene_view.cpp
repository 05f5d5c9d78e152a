// SPDX-License-Identifier: Apache-2.0
#include "environment/view/scene_view.h"

#include "base/error.h"
#include "scene/scene.h"

#include <algorithm>

namespace nephroid::environment {

preset::Preset with_view_of(const preset::Preset& preset, const preset::Preset& other) {
  preset::Preset result = preset;
  result.scene.camera = other.scene.camera;
  if (result.scene.environment && other.scene.environment)
    result.scene.environment->rotate_deg = other.scene.environment->rotate_deg;
  result.white = other.white;
  result.name = other.name;
  result.description = other.description;
  Settings& s = settings(result);
  const Settings& o = settings(other);
  s.lights = o.lights;
  s.segmentation = o.segmentation;
  s.weights = o.weights;
  s.threshold = o.threshold;
  return result;
}

preset::Preset with_places_of(const preset::Preset& preset, const preset::Preset& other) {
  preset::Preset result = preset;
  for (std::size_t i = 0; i < result.scene.objects.size(); ++i) {
    result.scene.objects[i].transform.rotate_deg = other.scene.objects[i].transform.rotate_deg;
    result.scene.objects[i].transform.translate = other.scene.objects[i].transform.translate;
  }
  return result;
}

preset::Preset with_weights_of(const preset::Preset& preset, const preset::Preset& other) {
  preset::Preset result = preset;
  for (std::size_t i = 0; i < result.scene.objects.size(); ++i) {
    const std::vector<preset::State>& states = other.scene.objects[i].states;
    for (std::size_t k = 0; k < std::min(states.size(), result.scene.objects[i].states.size()); ++k)
      result.scene.objects[i].states[k].weight = states[k].weight;
  }
  return result;
}

void SceneView::begin(const preset::Preset& preset, const Caster& caster) {
  make_renderer(preset);
  shown_ = loaded_;
  go_on_with(preset, caster);
}

void SceneView::end() {
  renderer_.reset();
  caustics_.reset();
  caustics_seconds_before_ = 0;
}

bool SceneView::show(const preset::Preset& preset, const Caster& caster) {
  const double seconds = caustics_ ? caustics_->seconds() : 0;
  bool begins = false;
  try {
    begins = go_on_with(preset, caster);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::bad_input) renderer_.reset(); // it is changed in part
    throw;
  } catch (...) {
    renderer_.reset();
    throw;
  }
  if (begins) caustics_seconds_before_ = seconds;
  return begins;
}

void SceneView::set_bake(const Bake& bake) {
  caustics_.emplace(bake, context_);
  caustics_seconds_before_ = 0;
  renderer_->set_caustics(*caustics_);
}

void SceneView::set_caustics_seconds(double seconds) {
  if (caustics_) caustics_seconds_before_ = caustics_->seconds() - seconds;
}

void SceneView::make_renderer(const preset::Preset& preset) {
  renderer_.reset(); // frees its device memory for the next
  renderer_.emplace(*task_, preset.white.value_or(1), preset.seed, context_);
  if (caustics_) renderer_->set_caustics(*caustics_);
}

bool SceneView::show_anew(const preset::Preset& preset, const Caster& caster) {
  const scene::Scene scene = scene::load_scene(preset);
  task_ = std::make_shared<const RenderTask>(
      make_render_task(preset, scene, scene::build_bvh(scene.geometry), caster, task_.get()));
  loaded_ = preset;
  if (with_weights_of(shown_, preset) != shown_) caustics_.reset();
  make_renderer(preset);
  shown_ = preset;
  return true;
}

bool SceneView::go_on_with(const preset::Preset& preset, const Caster& caster) {
  const auto& sky = preset.scene.environment;
  const bool turns_a_sun = sky && sky->type == preset::Environment::Type::sky &&
                           sky->rotate_deg != shown_.scene.environment.value_or(*sky).rotate_deg;
  if (!(with_view_of(with_places_of(shown_, preset), preset) == preset) || turns_a_sun ||
      is_plain(preset.scene.camera) != is_plain(shown_.scene.camera)) // it takes other programs
    return show_anew(preset, caster);
  bool begins = false;
  if (!(with_places_of(shown_, preset) == shown_)) {
    std::optional<MovedObjects> moved = move_objects(*task_, loaded_, shown_, preset, caster);
    if (!moved) return show_anew(preset, caster);
    renderer_->move_objects(std::move(*moved));
    begins = true;
  } else if (!(preset.scene.camera == shown_.scene.camera)) {
    renderer_->set_camera(scene::make_camera(preset.scene.camera, renderer_->scene()),
                          Location(preset.source) / "scene" / "camera");
    begins = true;
  }
  if (task_->cube.size > 0 && segment_settings(preset) != segment_settings(shown_)) {
    renderer_->set_segmentation(segment_by(preset, task_->cube));
    begins = true;
  }
  if (preset.scene.environment && preset.scene.environment->rotate_deg != shown_.scene.environment->rotate_deg) {
    renderer_->turn_environment(preset.scene.environment->rotate_deg);
    begins = true;
  }
  renderer_->set_white(preset.white.value_or(1));
  shown_ = preset;
  return begins;
}

} // namespace nephroid::environment
