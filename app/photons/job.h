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
#include <span>
#include <vector>

namespace nephroid::photons {

/// A job with additional functions for an engine that renders further layers.
class PhotonJob : public job::Job {
public:
  /// Smooths light on the same surfaces as Smoothing::spread does, with an estimate of it that has a bias but no noise.
  /// Where the run smooths nothing, it changes nothing.
  virtual void smooth(std::vector<float>& rgb, std::vector<float>& error_draw, std::span<const float> estimate) = 0;
  /// Sets the white of all further pictures.
  virtual void set_white(double white) = 0;
  /// The complete batches of splatted photons, and the batches of a pass.
  virtual std::int64_t batches() const = 0;
  virtual std::int64_t batches_per_pass() const = 0;
  /// The whole state that save() and load() handle.
  virtual void serialize(tracing::Archive& archive) = 0;
};

/// Copies scene and tree to the device; they need not outlive the call. plan belongs to the same preset and scene.
/// Throws failed where the device has not enough memory, BuildError for a kernel that does not compile.
std::unique_ptr<PhotonJob> make_job(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh,
                                    const RunPlan& plan, const mpi::RankContext& context);

} // namespace nephroid::photons
