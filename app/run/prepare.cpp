// SPDX-License-Identifier: Apache-2.0
#include "run/prepare.h"

#include "engine/engine.h"
#include "run/afterimage.h"
#include "run/content.h"
#include "run/memory.h"
#include "run/night.h"
#include "scene/placement.h"

#include <fmt/format.h>

#include <cstring>
#include <utility>

namespace nephroid::run {
namespace {

/// Whether two presets load the same scene but for the camera.
bool same_but_camera(const preset::Preset& a, const preset::Preset& b) {
  preset::Scene scene = a.scene;
  scene.camera = b.scene.camera;
  return a.source == b.source && a.unit == b.unit && scene == b.scene;
}

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// The tree that the lender's becomes for another mesh. Null where that has other primitives.
std::shared_ptr<const scene::Bvh> lent_tree(const LoadedScene& lender, const scene::Mesh& mesh) {
  const scene::Mesh& lent = lender.scene.geometry;
  if (!same_bytes(lent.triangles, mesh.triangles) || lent.ellipsoids.size() != mesh.ellipsoids.size()) return nullptr;
  if (lent.ellipsoids == mesh.ellipsoids && same_bytes(lent.positions, mesh.positions)) return lender.bvh;
  return std::make_shared<const scene::Bvh>(scene::refitted(*lender.bvh, mesh));
}

/// What the scene that `lender` lends was read from, at its time.
std::vector<plan::Input> inputs_of_scene(const Prepared& lender) {
  preset::Preset scene_only;
  scene_only.source = lender.preset.source;
  scene_only.scene = lender.preset.scene;
  return read_inputs(scene_only, lender.plan->inputs);
}

LoadedScene load(const preset::Preset& preset, const Prepared* previous, bool lends_scene, const Watch& watch) {
  if (lends_scene) {
    LoadedScene loaded = *previous->loaded;
    loaded.scene.camera = scene::make_camera(preset.scene.camera, loaded.scene);
    return loaded;
  }
  LoadedScene loaded{scene::load_scene(preset, watch), nullptr};
  watch.begin("sorting the triangles");
  if (previous) loaded.bvh = lent_tree(*previous->loaded, loaded.scene.geometry);
  if (!loaded.bvh) loaded.bvh = std::make_shared<const scene::Bvh>(scene::build_bvh(loaded.scene.geometry));
  return loaded;
}

std::unique_ptr<plan::Plan> make_plan(const preset::Preset& preset, const LoadedScene& loaded) {
  std::unique_ptr<plan::Plan> plan = engine::engine_of(preset).plan(preset, loaded.scene, *loaded.bvh);
  plan->not_imported = preset.not_imported;
  plan->buffers.push_back(picture_and_files(*plan, loaded.scene.camera.width, loaded.scene.camera.height));
  return plan;
}

} // namespace

Prepared prepare(const preset::Preset& preset, const Prepared* previous, const Watch& watch,
                 std::shared_ptr<const Afterimage> before) {
  const bool lends_scene = previous && same_but_camera(preset, previous->preset);
  // Hashed before the files are loaded. If one is written in between, the hash is of its old contents, and no resume
  // goes on with the new ones.
  std::vector<plan::Input> inputs =
      read_inputs(preset, lends_scene ? inputs_of_scene(*previous) : std::vector<plan::Input>());
  auto loaded = std::make_shared<const LoadedScene>(load(preset, previous, lends_scene, watch));
  watch.begin("making the plan");
  std::unique_ptr<plan::Plan> plan = make_plan(preset, *loaded);
  plan->inputs = std::move(inputs);
  if (before && !(plan->mixes_frames && has_parts_of(loaded->scene, before->seen))) before.reset();
  if (before) plan->inputs.push_back(before->input);
  if (preset.provenance.frame && !preset.animation && plan->mixes_frames) { // a film's, not one that a window shows
    plan->buffers.push_back(held_of_frame_before(*plan, loaded->scene.camera.width, loaded->scene.camera.height));
    if (const int frame = *preset.provenance.frame; frame > 0 && !before)
      plan->notes.push_back(fmt::format(
          "frame {} begins by itself: of frame {} there is nothing, or it has other objects", frame, frame - 1));
  }
  for (std::string& line : scene::hidden_lamps(loaded->scene)) plan->notes.push_back(std::move(line));
  if (const std::string night = night_note(preset); !night.empty()) plan->notes.push_back(night);
  plan->notes.insert(plan->notes.begin(), preset.provenance.notes.begin(), preset.provenance.notes.end());
  return {preset, std::move(loaded), std::move(plan), std::move(before)};
}

Prepared with_scene(const Prepared& prepared, scene::Scene scene, const std::string& smaller) {
  Prepared other = prepared;
  other.preset.scene.camera.resolution = {scene.camera.width, scene.camera.height};
  other.loaded = std::make_shared<const LoadedScene>(LoadedScene{std::move(scene), prepared.loaded->bvh});
  std::unique_ptr<plan::Plan> plan = make_plan(other.preset, *other.loaded);
  plan->smaller = smaller;
  other.plan = std::move(plan);
  return other;
}

std::unique_ptr<job::Job> make_job(const Prepared& prepared, const mpi::RankContext& context) {
  return engine::engine_of(prepared.preset)
      .job(prepared.preset, prepared.loaded->scene, *prepared.loaded->bvh, *prepared.plan, context);
}

job::Snapshot render_picture(const Prepared& prepared, const compute::Context& context,
                             const std::function<bool(const job::Progress&)>& advanced) {
  require_memory(prepared, context);
  const std::unique_ptr<job::Job> job = make_job(prepared, context);
  for (bool goes_on = true; goes_on && !job->finished(); goes_on = advanced(job->progress())) job->advance();
  return job->snapshot();
}

} // namespace nephroid::run
