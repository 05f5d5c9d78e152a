// SPDX-License-Identifier: Apache-2.0
#include "environment/photons.h"

#include "environment/settings.h"
#include "environment/view/scene_view.h"
#include "scene/scene.h"

#include <algorithm>
#include <utility>

namespace nephroid::environment {
namespace {

/// This engine decides when to stop, and needs halves for smoothing.
preset::Preset without_stop(preset::Preset preset) {
  preset.stop = {};
  preset.measure.estimate = true;
  return preset;
}

} // namespace

photons::RunPlan plan_photons(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh) {
  photons::Settings photons;
  photons.caustic = settings(preset).cast;
  photons.indirect = false;           // the joined picture has no layer of it
  photons.photons_per_pass = 1 << 17; // only after two passes a draw says how noisy a layer is
  return photons::make_plan(without_stop(preset), photons, scene, bvh, {.all = preset.leave_out});
}

std::unique_ptr<photons::PhotonJob> make_photons(const preset::Preset& preset, const scene::Scene& scene,
                                                 const scene::Bvh& bvh, const photons::RunPlan& plan,
                                                 const mpi::RankContext& context) {
  if (plan.layers == 0) return nullptr;
  return photons::make_job(without_stop(preset), scene, bvh, plan, context);
}

void JoinedPhotons::begin(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh,
                          const photons::RunPlan& plan) {
  run_ = make_photons(preset, scene, bvh, plan, context_);
  has_planned_ = true;
  if (run_ && beginning_) run_->begin_with(*beginning_);
}

void JoinedPhotons::begin_with(const job::Beginning& beginning) {
  beginning_ = beginning;
  if (run_) run_->begin_with(beginning);
}

void JoinedPhotons::end() {
  run_.reset();
  has_planned_ = false;
}

bool JoinedPhotons::wants_turn(std::int64_t eye_passes, std::int64_t most_eye_passes, std::int64_t most) const {
  if (!run_) return !has_planned_;
  return complete_passes() < most &&
         (eye_passes >= most_eye_passes || passes() < std::max(0.25, static_cast<double>(eye_passes) - 0.75));
}

void JoinedPhotons::advance(const SceneView& view) {
  if (run_) return run_->advance();
  const Renderer& renderer = *view.renderer();
  scene::Scene scene = renderer.scene();
  scene.camera = scene::make_camera(view.shown().scene.camera, scene);
  if (scene.environment) scene.environment->rotate_deg = view.backdrop_rotate_deg();
  begin(view.shown(), scene, renderer.bvh(), plan_photons(view.shown(), scene, renderer.bvh()));
}

void JoinedPhotons::set_white(double white) {
  if (run_) run_->set_white(white);
}

std::vector<float> JoinedPhotons::join(std::vector<Renderer::Layer>& layers, std::vector<float> smooth) {
  if (!run_ || !run_->progress().whole) {
    layers[Renderer::direct].rgb = std::move(smooth);
    return {};
  }
  run_->set_estimate(std::move(smooth));
  job::Snapshot sent = run_->snapshot();
  left_ = std::move(sent.left);
  for (const job::Layer& layer : sent.picture->layers)
    std::ranges::find(layers, layer.name, &Renderer::Layer::name)->rgb = layer.rgb;
  return sent.picture->error_draw;
}

void JoinedPhotons::serialize(tracing::Archive& archive, const SceneView& view) {
  bool has_run = run_ != nullptr;
  archive.value(has_run);
  has_planned_ = has_run && has_planned_;
  if (!has_run) return run_.reset();
  if (!run_) advance(view); // begins the run
  run_->serialize(archive);
}

} // namespace nephroid::environment
