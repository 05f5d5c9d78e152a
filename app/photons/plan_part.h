// SPDX-License-Identifier: Apache-2.0
// What a run of engine 1 is made of: stages, and decisions that several stages share. Each says its own part of the
// plan, beside its work; make_plan (plan.h) puts the parts together.
#pragma once
#include "photons/settings.h"
#include "photons/tables/run_tables.h"
#include "plan/plan.h"
#include "preset/preset.h"
#include "scene/bvh.h"
#include "scene/scene.h"
#include "tracing/omissions.h"
#include "tracing/scene_tables.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::photons {

class Stage;
struct DeviceWorld;

/// What parts of a plan go by.
struct PlanInput {
  const preset::Preset& preset;
  const Settings& settings;
  const scene::Scene& scene;
  const scene::Bvh& bvh;
  const tracing::LeaveOut& leave_out;
  const RunTables& tables;
  tracing::ObjectCounts objects;
  plan::Pass caustics = {}; ///< whether there are any, splatted or gathered, and why
  plan::Pass estimate = {}; ///< whether films have two halves, and why

  bool is_sppm() const { return settings.estimator == Settings::Estimator::sppm; }
  std::uint64_t halves() const { return estimate.runs ? 2 : 1; }
  std::uint64_t pixels() const { return scene.camera.pixels(); }
  /// Of a film of XYZ.
  std::uint64_t film_bytes() const { return halves() * 3 * sizeof(std::int64_t) * pixels(); }
};

/// What it adds to the plan.
struct PlanPart {
  std::vector<plan::Pass> passes = {};
  std::vector<plan::PlannedBuffer> buffers = {}; ///< of one name in several parts: their sum
  std::map<std::string, std::string> defines = {};
  std::vector<std::string> notes = {};
};

/// Of a stage: its pass, and its buffers where that runs.
inline PlanPart part_of(plan::Pass pass, std::vector<plan::PlannedBuffer> buffers) {
  PlanPart part{.passes = {std::move(pass)}};
  if (part.passes[0].runs) part.buffers = std::move(buffers);
  return part;
}

struct RunPart {
  /// The first pass says whether this part runs; without passes it does not.
  PlanPart (*plan)(const PlanInput& input);
  /// Of a stage: begins its work, where it runs. world outlives it. Throws as job::Job's making does.
  std::unique_ptr<Stage> (*make)(DeviceWorld& world, const scene::Scene& scene, const Settings& settings) = nullptr;
  const char* layer = ""; ///< of the picture, that the stage adds to
};

/// The stages; all of one is in its file NAME_stage.cpp.
extern const RunPart direct_stage, photon_stage, map_stage, sppm_stage, indirect_stage, background_stage;
/// In their place where layers are kept for another light.
extern const RunPart layered_direct_stage, layered_photon_stage;
extern const RunPart relighting_part; ///< relight/layer_film.cpp: what these two share
extern const RunPart smoothing_part;  ///< smoothing.cpp

/// A stage that the preset does not ask for; field: of its section "spectral".
plan::Pass not_asked_for(const std::string& name, const std::string& field);
/// What a preset with layers may not ask for: no field brings it back.
plan::Pass not_in_layers(const std::string& name, const std::string& why);

/// Lights that shine, or, where layers are kept, may shine when the light changes.
std::ptrdiff_t shining_lights(const PlanInput& input);
/// Why no light shines; empty where one does.
std::string no_light(const PlanInput& input);
/// "one colour all around", or how many texels it has.
std::string size_of(const scene::Environment& environment);

/// PlanInput::caustics; the other members of input are there.
plan::Pass caustics_pass(const PlanInput& input);
/// Whether paths have one wavelength of their cluster each.
plan::Pass jitter_pass(const PlanInput& input);

} // namespace nephroid::photons
