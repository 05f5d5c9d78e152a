// SPDX-License-Identifier: Apache-2.0
// From a preset to a plan, and to the engine's job on a device.
#pragma once
#include "base/watch.h"
#include "compute/compute.h"
#include "job/job.h"
#include "mpi/rank_context.h"
#include "plan/plan.h"
#include "preset/preset.h"
#include "scene/bvh.h"
#include "scene/scene.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace nephroid::run {

/// A loaded scene with its tree: what stays the same while only the camera, the light or the engine's settings change.
struct LoadedScene {
  scene::Scene scene;
  std::shared_ptr<const scene::Bvh> bvh; ///< never null; shared by scenes with the same primitives in the same places
};

struct Afterimage;

/// A preset made ready: files read, plan made, nothing on a device yet.
struct Prepared {
  preset::Preset preset;
  std::shared_ptr<const LoadedScene> loaded;
  std::shared_ptr<const plan::Plan> plan;             ///< never null
  std::shared_ptr<const Afterimage> before = nullptr; ///< what the frame before left (run/afterimage.h); null: nothing
};

/// Reads what the preset names and makes the plan. `previous`, if given, lends its scene where only the camera or the
/// engine's settings differ (files are not read again then), and its tree where the triangles are the same, refitted
/// where they have moved. Throws bad_input as the loaders do, and interrupted where `watch` asks for it.
Prepared prepare(const preset::Preset& preset, const Prepared* previous = nullptr, const Watch& watch = {},
                 std::shared_ptr<const Afterimage> before = nullptr);

/// The same preset of another scene with the same triangles, seen by that one's camera. smaller: what the plan says to
/// do where it does not fit (plan::Plan::smaller).
Prepared with_scene(const Prepared& prepared, scene::Scene scene, const std::string& smaller);

/// Builds the engine's job on a device, whose memory was asked for (require_memory). Its preset's white is a number.
/// Throws BuildError for a kernel that does not compile, and bad_input for what the engine cannot render.
std::unique_ptr<job::Job> make_job(const Prepared& prepared, const mpi::RankContext& context);

/// A picture that something else is made of: not measured, nothing written. advanced: hears of each slice, and says
/// whether another one follows; may throw. Throws as require_memory and make_job do.
job::Snapshot render_picture(const Prepared& prepared, const compute::Context& context,
                             const std::function<bool(const job::Progress&)>& advanced);

/// A device that is opened by the first who needs it, and stays open for the next run: opening takes a while.
class DeviceOnDemand {
public:
  explicit DeviceOnDemand(std::function<compute::Context()> open) : open_(std::move(open)) {}
  const compute::Context& context(const Watch& watch = {}) {
    if (!context_) {
      watch.begin("opening the device");
      context_ = open_();
    }
    return *context_;
  }
  /// The context of a device that has been opened.
  const compute::Context& opened() const { return context_.value(); }
  /// It is opened anew when it is needed again.
  void close() { context_.reset(); }

private:
  std::function<compute::Context()> open_;
  std::optional<compute::Context> context_;
};

} // namespace nephroid::run
