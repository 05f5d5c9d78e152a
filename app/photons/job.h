// SPDX-License-Identifier: Apache-2.0
// Photons from the lights and paths from the eye, pass after pass: what engine 1 is, and what engine 2 comes to.
#pragma once
#include "compute/compute.h"
#include "job/job.h"
#include "mpi/rank_context.h"
#include "photons/plan.h"
#include "preset/preset.h"
#include "scene/bvh.h"
#include "scene/scene.h"
#include "tracing/state.h"

#include <memory>
#include <span>
#include <vector>

namespace nephroid::photons {

/// A job with what an engine needs that knows more than photons do.
class PhotonJob : public job::Job {
public:
  /// What the layer "caustic" is as somebody else knows it, without noise but not quite right: [pixel][3], over the
  /// preset's white. From now on it is mixed with what photons say (mixture.h). Empty: there is none.
  virtual void set_estimate(std::vector<float> caustics) = 0;
  /// Smoothing::spread of light on the same surfaces. Where the run smooths nothing, nothing changes.
  virtual void smooth(std::vector<float>& rgb, std::vector<float>& error_draw, std::span<const float> estimate) = 0;
  /// Of pictures from now on; an estimate is over the same.
  virtual void set_white(double white) = 0;
  /// Of photons that are splatted, complete ones, and how many a pass has.
  virtual std::int64_t batches() const = 0;
  virtual std::int64_t batches_per_pass() const = 0;
  /// All that save() and load() are about.
  virtual void state(tracing::State& state) = 0;
};

/// The scene and tree are copied to the device; they need not outlive the call. plan: of the same preset and scene.
/// Throws failed where the device has not enough memory, BuildError for a kernel that does not compile.
std::unique_ptr<PhotonJob> make_job(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh,
                                    const RunPlan& plan, const mpi::RankContext& context);

} // namespace nephroid::photons
