// SPDX-License-Identifier: Apache-2.0
// The run of engine 1 that takes the picture over from the spheres: photons, and its own paths from the eye.
#pragma once
#include "environment/view/renderer.h"
#include "mpi/rank_context.h"
#include "photons/job.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace nephroid::environment {

/// preset: one of this engine. scene: with the environment as a light. Throws as photons::make_plan does.
photons::RunPlan plan_photons(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh);

/// plan: that of the same preset and scene. Null where there are no caustics. Throws as photons::make_job does.
std::unique_ptr<photons::PhotonJob> make_photons(const preset::Preset& preset, const scene::Scene& scene,
                                                 const scene::Bvh& bvh, const photons::RunPlan& plan,
                                                 const mpi::RankContext& context);

class SceneView;

/// Photons that join the picture of a renderer, between its passes of paths from the eye.
class JoinedPhotons {
public:
  explicit JoinedPhotons(const mpi::RankContext& context) : context_(context) {}

  /// preset, plan: those of the renderer's scene.
  void begin(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh,
             const photons::RunPlan& plan);
  /// See job::Job.
  void begin_with(const job::Beginning& beginning);
  /// Ends the photons' job. Their next turn begins with a plan of its own.
  void end();
  bool has_begun() const { return run_ != nullptr; }

  /// Whether the next turn is the photons'. A quarter of a pass, with its previews, comes before the renderer's first
  /// two passes, a whole pass before each later one. most: of the photons' passes.
  bool wants_turn(std::int64_t eye_passes, std::int64_t most_eye_passes, std::int64_t most) const;
  /// Does one slice of about 30 ms. The first slice starts the photons for what `view` shows.
  void advance(const SceneView& view);

  std::int64_t complete_passes() const { return run_->progress().step; }
  std::uint64_t sent() const { return run_->progress().work; }
  /// Includes the part of the pass in hand.
  double passes() const { return run_->passes(); }
  void set_white(double white);

  /// Puts the run's layers in the place of the renderer's as soon as it has a whole picture, and returns a draw of
  /// their error (job::Picture::error_draw). smooth: the renderer's layer of that name, the estimate of the layer
  /// "direct".
  std::vector<float> join(std::vector<Renderer::Layer>& layers, std::vector<float> smooth);

  /// What the picture of the last join() leaves for the next frame (job::Snapshot::left).
  std::vector<job::Layer> left() { return std::exchange(left_, {}); }

  void serialize(tracing::Archive& archive, const SceneView& view);

private:
  mpi::RankContext context_;
  std::unique_ptr<photons::PhotonJob> run_; ///< null: there are no photons, or they have not begun
  bool has_planned_ = false;                ///< whether run_ is null because there are none
  std::optional<job::Beginning> beginning_;
  std::vector<job::Layer> left_;
};

} // namespace nephroid::environment
