// SPDX-License-Identifier: Apache-2.0
// The photons that engine 2 comes to: those of engine 1, for the layer "caustic" alone.
#pragma once
#include "environment/view/renderer.h"
#include "mpi/rank_context.h"
#include "photons/job.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace nephroid::environment {

/// preset: of this engine. scene: with the environment as a light. Throws as photons::make_plan.
photons::RunPlan plan_photons(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh);

/// plan: of the same preset and scene. Null where there are no caustics. Throws as photons::make_job.
std::unique_ptr<photons::PhotonJob> make_photons(const preset::Preset& preset, const scene::Scene& scene,
                                                 const scene::Bvh& bvh, const photons::RunPlan& plan,
                                                 const mpi::RankContext& context);

class SceneView;

/// Photons that join the picture of a renderer, in batches between its passes of paths from the eye.
class JoinedPhotons {
public:
  explicit JoinedPhotons(const mpi::RankContext& context) : context_(context) {}

  /// preset, plan: of the renderer's scene.
  void begin(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh,
             const photons::RunPlan& plan);
  /// They stop, and begin with a plan of their own in their next turn.
  void end();
  bool has_begun() const { return run_ != nullptr; }

  /// Whether theirs is the next turn. A quarter of a pass of photons comes before each of the first two passes of paths
  /// from the eye, for a first picture of both soon: then there are two halves of each. A whole one follows each later
  /// one. most: passes of either.
  bool wants_turn(std::int64_t eye_passes, std::int64_t most) const;
  /// One slice of about 30 ms; the first one begins with what is shown.
  void advance(const SceneView& view);
  /// So many passes ahead of paths from the eye they stay.
  void stay_ahead() { ahead_ = run_ ? passes() : 0; }

  std::int64_t complete_passes() const { return run_->progress().step; }
  std::uint64_t sent() const { return run_->progress().work; }
  /// With the part of the one in hand.
  double passes() const { return static_cast<double>(run_->batches()) / static_cast<double>(run_->batches_per_pass()); }
  void set_white(double white);

  /// Mixes what photons say into the renderer's layers: caustics by these and by spheres, if there are any, together;
  /// and no layer keeps the noise of a single sample. smooth: that layer.
  void join(std::vector<Renderer::Layer>& layers, const Renderer::Layer& smooth, bool has_spheres);

  void state(tracing::State& state, const SceneView& view);

private:
  mpi::RankContext context_;
  std::unique_ptr<photons::PhotonJob> run_; ///< null: there are none, or not yet
  bool has_planned_ = false;                ///< whether it is known which
  double ahead_ = 0;
};

} // namespace nephroid::environment
