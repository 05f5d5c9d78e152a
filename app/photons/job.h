// SPDX-License-Identifier: Apache-2.0
// Photons from the lights and paths from the eye, pass after pass: the whole of engine 1, and a part of engine 2.
#pragma once
#include "compute/compute.h"
#include "job/job.h"
#include "mpi/rank_context.h"
#include "photons/plan.h"
#include "preset/preset.h"
#include "scene/bvh.h"
#include "scene/scene.h"
#include "tracing/archive.h"

#include <memory>
#include <vector>

namespace nephroid::photons {

/// A job with additional functions for an engine that has an estimate of its own.
class PhotonJob : public job::Job {
public:
  /// Sets an estimate of the layer "direct" that has a bias but no noise: [pixel][3], over the preset's white. It
  /// stands in for the layer while that has no two halves; then it is mixed with what they show (mixture.h).
  virtual void set_estimate(std::vector<float> direct) = 0;
  /// Sets the white of all further pictures; an estimate is over the same white.
  virtual void set_white(double white) = 0;
  /// The complete passes and the fraction of the one in hand.
  virtual double passes() const = 0;
  /// The whole state that save() and load() handle.
  virtual void serialize(tracing::Archive& archive) = 0;
};

/// Copies scene and tree to the device; they need not outlive the call. plan belongs to the same preset and scene.
/// Throws failed where the device has not enough memory, BuildError for a kernel that does not compile.
std::unique_ptr<PhotonJob> make_job(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh,
                                    const RunPlan& plan, const mpi::RankContext& context);

} // namespace nephroid::photons
