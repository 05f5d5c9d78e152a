// SPDX-License-Identifier: Apache-2.0
// The parts of a run: stages, and decisions that stages share. Each plans for itself; make_plan puts them together.
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
struct StageContext;

/// What the parts of a plan are decided by.
struct PlanInput {
  const preset::Preset& preset;
  const Settings& settings;
  const scene::Scene& scene;
  const scene::Bvh& bvh;
  const tracing::LeaveOut& leave_out;
  const RunTables& tables;
  tracing::ObjectCounts objects;
  plan::Decision tiles = {};        ///< whether photons are tiles, and why
  plan::Decision caustics = {};     ///< whether there are any of photons, splatted or gathered, and why
  std::string why_no_indirect = {}; ///< where settings.indirect is false
  plan::Decision estimate = {};     ///< whether films have two halves, and why

  bool has_caustics() const { return caustics.runs || (tables.has_even_sky && settings.caustic); }
  bool is_sppm() const { return settings.estimator == Settings::Estimator::sppm; }
  std::uint64_t halves() const { return scene.camera.meter ? meter_replicates : estimate.runs ? 2 : 1; }
  std::uint64_t pixels() const { return scene.camera.pixels(); }
  /// The bytes of a film of XYZ.
  std::uint64_t film_bytes() const { return halves() * 3 * sizeof(std::int64_t) * pixels(); }
};

/// What a part adds to the plan.
struct PlanPart {
  std::vector<plan::Decision> decisions = {};
  std::vector<plan::PlannedBuffer> buffers = {}; ///< buffers; those of one name in several parts are added up
  std::map<std::string, std::string> defines = {};
  std::vector<std::string> notes = {};
};

/// The plan of a stage: its decision, and its buffers where that runs.
inline PlanPart part_of(plan::Decision decision, std::vector<plan::PlannedBuffer> buffers) {
  PlanPart part{.decisions = {std::move(decision)}};
  if (part.decisions[0].runs) part.buffers = std::move(buffers);
  return part;
}

struct RunPart {
  /// Plans the part. It runs if its first decision says so; without decisions it does not run.
  PlanPart (*plan)(const PlanInput& input);
  /// Makes the stage of a part that runs; null for other parts. world outlives the stage. Throws as make_job does.
  std::unique_ptr<Stage> (*make)(StageContext& world, const scene::Scene& scene, const Settings& settings) = nullptr;
  const char* layer = ""; ///< the picture's layer that the stage adds to
};

/// The stages, each in its file NAME_stage.cpp.
extern const RunPart direct_stage, sky_stage, photon_stage, receiver_stage, even_sky_stage, indirect_stage,
    indirect_photon_stage, background_stage;
/// The stages in the place of photon_stage where photons are tiles, and where all are gathered.
extern const RunPart tile_stage, sppm_stage;
/// The stages in their place where layers are kept for another light.
extern const RunPart layered_direct_stage, layered_photon_stage;
extern const RunPart relighting_part; ///< relight/layer_film.cpp: what these two share
extern const RunPart smoothing_part;  ///< smoothing.cpp

/// The decision on a stage that the preset turns off with `field` of its section "spectral".
plan::Decision not_asked_for(const std::string& name, const std::string& field);
/// The decision on something that a preset with layers cannot have, whatever its fields.
plan::Decision not_in_layers(const std::string& name, const std::string& why);

/// The number of lights that shine, or, where layers are kept, may shine when the light changes.
std::ptrdiff_t shining_lights(const PlanInput& input);
/// Why no light shines; empty where one does.
std::string no_light(const PlanInput& input);
/// The text "one colour all around", or the number of texels.
std::string size_of(const scene::Environment& environment);

/// Decides whether there is light that met several diffuse surfaces.
plan::Decision indirect_decision(const PlanInput& input);
/// Decides PlanInput::caustics from the other members of input.
plan::Decision caustics_decision(const PlanInput& input);
/// Decides whether each path has one wavelength of its cluster.
plan::Decision jitter_decision(const PlanInput& input);

} // namespace nephroid::photons
