// SPDX-License-Identifier: Apache-2.0
// The plan of a run, put together from its parts.
#include "photons/plan.h"

#include "base/counted.h"
#include "photons/capabilities.h"
#include "photons/describe_settings.h"
#include "photons/effort/effort.h"
#include "photons/plan_part.h"
#include "photons/relight/layer_light.h"
#include "preset/choices.h"
#include "tracing/omissions.h"
#include "tracing/world.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <string_view>

namespace nephroid::photons {
namespace {

/// The part that every run has.
PlanPart plan_scene(const PlanInput& input) {
  const std::uint64_t environment = input.scene.environment ? tracing::bytes_of(input.scene.environment->rgb) : 0;
  PlanPart part;
  part.buffers = tracing::planned_buffers(input.scene, input.bvh, input.tables);
  part.buffers.push_back({"scene (host)",
                          tracing::tree_bytes(input.bvh) + tracing::mesh_bytes(input.scene) + environment +
                              tracing::sky_bytes(input.tables) + 2 * tracing::texture_bytes(input.tables),
                          true});
  part.buffers.push_back({"pixels", 2 * sizeof(std::uint32_t) * input.pixels()}); // all pixels, and those of glass
  part.defines = scene::tree_defines(input.bvh);
  part.defines["NEPHROID_FILM_HALVES"] = std::to_string(input.halves());
  part.defines["NEPHROID_METER"] = std::to_string(int(input.scene.camera.meter != nullptr));
  if (const Settings& s = input.settings; s.step_nm > 1 && s.method != Settings::Method::brute_force)
    part.notes = {
        fmt::format("spectral.step_nm: {} does nothing here: spectral.method is {}, and only brute_force has steps",
                    s.step_nm, preset::word(s.method))};
  if (const Settings& s = input.settings; s.sppm.radius && !input.is_sppm())
    part.notes.push_back(fmt::format(
        "spectral.sppm.radius: {} does nothing here: spectral.estimator is {}, and only sppm gathers within a radius",
        *s.sppm.radius, preset::word(s.estimator)));
  return part;
}

PlanPart plan_omissions(const PlanInput& input) {
  PlanPart part{.decisions = tracing::data_omissions(input.leave_out, input.scene, input.tables.spheres)};
  // Layers of dark lights are kept for lights to come.
  if (input.settings.relight)
    std::erase_if(part.decisions, [](const plan::Decision& decision) {
      return decision.name == "dark lights" || decision.name == "unlit wavelengths";
    });
  tracing::CodeOmissions code =
      tracing::code_omissions(input.leave_out, input.scene, input.tables.wavelengths.takes_light);
  std::ranges::move(code.decisions, std::back_inserter(part.decisions));
  part.defines = std::move(code.defines);
  return part;
}

plan::Decision environment_light_decision(const PlanInput& input) {
  const std::string name = "environment light", field = "/scene/environment/lights";
  const scene::Environment& environment = *input.scene.environment;
  if (environment.is_black()) return {name, false, "the environment is black"};
  if (!environment.lights) return {name, false, "scene.environment.lights is false: it is only seen", field, true};
  return {name, true, size_of(environment) + ": sends photons and lights diffuse surfaces, each texel by its flux",
          field, true};
}

PlanPart plan_environment_light(const PlanInput& input) {
  PlanPart part;
  if (input.scene.environment) part.decisions = {environment_light_decision(input)};
  if (input.scene.environment && !input.scene.environment->about.empty())
    part.decisions.push_back({"sky", true, input.scene.environment->about, "/scene/environment", true});
  return part;
}

/// Decides PlanInput::estimate; caustics is PlanInput::caustics.
plan::Decision estimate_decision(const preset::Preset& preset, const Settings& settings,
                                 const plan::Decision& caustics) {
  const char* const name = "error estimate";
  if (preset.measure.estimate && caustics.runs && settings.estimator == Settings::Estimator::sppm)
    return {name, false,
            "spectral.estimator is sppm, whose radii hang on all photons: there are no two independent halves"};
  // Nothing else can stop the run, so it cannot be switched off.
  if (preset.measure.estimate && preset.stop.error && !preset.reference)
    return {name, true, "every film is kept in two independent halves: stop.error needs them, there is no reference"};
  return {name, preset.measure.estimate,
          preset.measure.estimate ? "every film is kept in two independent halves" : "measure.estimate is false",
          "/measure/estimate", true};
}

PlanPart plan_estimate(const PlanInput& input) { return {.decisions = {input.estimate}}; }

plan::Decision stray_photons_decision(const PlanInput& input) {
  const bool aims = input.leave_out.stray_photons;
  return tracing::not_needed("stray photons", aims,
                             aims ? fmt::format("photons start towards {} about glass and mirrors only",
                                                counted(std::ssize(input.tables.spheres), "sphere"))
                                  : "photons need not start where there is no glass and no mirror");
}

plan::Decision low_discrepancy_decision(const Settings& settings) {
  if (settings.estimator == Settings::Estimator::tiles)
    return {"low discrepancy", true, "photons leave the lights on square lattices", "/spectral/low_discrepancy", true};
  return {"low discrepancy", settings.low_discrepancy,
          settings.low_discrepancy ? "photons leave the lights by a scrambled Sobol sequence"
                                   : "spectral.low_discrepancy is false: plain random numbers",
          "/spectral/low_discrepancy", true};
}

plan::Decision differentials_decision(const PlanInput& input) {
  const char* const name = "differentials";
  if (input.settings.relight) return not_in_layers(name, "a layer is a whole cluster's");
  const bool tiles = input.settings.estimator == Settings::Estimator::tiles;
  if (!input.caustics.runs || input.is_sppm()) return {name, false, "nothing is splatted"};
  const tracing::StretchParameter along = tracing::stretch_parameter(input.scene);
  if (std::string why = why_no_differentials(input.scene); !why.empty()) return {name, false, std::move(why)};
  if (along == tracing::StretchParameter::none)
    return {name, false, "no glass bends one wavelength otherwise than another"};
  if (!input.settings.jitter && !tiles)
    return {name, false, "spectral.jitter is false: a cluster goes one way", "/spectral/jitter", true};
  return {name, true,
          fmt::format("splats are {} along the way that they move with the {}", tiles ? "swept" : "stretched",
                      along == tracing::StretchParameter::index ? "index of refraction"
                                                                : "wavelength, for there are several curves")};
}

/// How the photons of caustics are sent, whichever stage splats or gathers them.
PlanPart plan_caustics(const PlanInput& input) {
  const plan::Decision jitter = jitter_decision(input), low_discrepancy = low_discrepancy_decision(input.settings),
                       differentials = differentials_decision(input);
  const bool disperses = tracing::stretch_parameter(input.scene) != tracing::StretchParameter::none;
  const bool sweeps = input.settings.jitter && !input.settings.relight && disperses;
  PlanPart part;
  if (input.caustics.runs)
    part.decisions = {input.tiles,
                      effort_decision(input.settings, input.tables.importance),
                      stray_photons_decision(input),
                      jitter,
                      low_discrepancy,
                      differentials};
  part.defines = {{"NEPHROID_JITTER", std::to_string(int(jitter.runs))},
                  {"NEPHROID_LOW_DISCREPANCY", std::to_string(int(low_discrepancy.runs))},
                  {"NEPHROID_DIFFERENTIALS", std::to_string(int(differentials.runs))},
                  {"NEPHROID_EYE_SWEEP", std::to_string(int(sweeps))},
                  {"NEPHROID_EYE_PARTS", std::to_string(int(sweeps || !disperses))},
                  {"NEPHROID_EVEN_SKY", std::to_string(int(input.tables.has_even_sky))}};
  return part;
}

constexpr RunPart scene_part{plan_scene}, caustics_part{plan_caustics}, omissions_part{plan_omissions},
    estimate_part{plan_estimate}, environment_light_part{plan_environment_light};

/// The parts in the order of the plan's rows, and of the stages' turns in a pass.
std::vector<const RunPart*> parts_of(const Settings& settings) {
  const bool sppm = settings.estimator == Settings::Estimator::sppm;
  const bool tiles = settings.estimator == Settings::Estimator::tiles;
  std::vector<const RunPart*> parts{&scene_part,
                                    settings.relight ? &layered_direct_stage : &direct_stage,
                                    &sky_stage,
                                    settings.relight ? &layered_photon_stage
                                    : tiles          ? &tile_stage
                                                     : &photon_stage,
                                    &caustics_part,
                                    &smoothing_part,
                                    &omissions_part,
                                    &receiver_stage,
                                    &even_sky_stage,
                                    &indirect_stage,
                                    &indirect_photon_stage,
                                    &background_stage,
                                    &estimate_part,
                                    &environment_light_part,
                                    &relighting_part};
  if (sppm) parts.insert(std::ranges::find(parts, &receiver_stage), &sppm_stage);
  return parts;
}

void add(PlanPart part, plan::Plan& plan) {
  std::ranges::move(part.decisions, std::back_inserter(plan.decisions));
  for (plan::PlannedBuffer& buffer : part.buffers)
    if (const auto same = std::ranges::find(plan.buffers, buffer.name, &plan::PlannedBuffer::name);
        same != plan.buffers.end())
      same->bytes += buffer.bytes;
    else
      plan.buffers.push_back(std::move(buffer));
  plan.defines.merge(part.defines);
  std::ranges::move(part.notes, std::back_inserter(plan.notes));
}

} // namespace

plan::Decision not_asked_for(const std::string& name, const std::string& field) {
  return {name, false, fmt::format("spectral.{} is false", field), "/spectral/" + field, true};
}

plan::Decision not_in_layers(const std::string& name, const std::string& why) {
  return {name, false, "spectral.relight is true, and layers cannot hold it: " + why};
}

std::ptrdiff_t shining_lights(const PlanInput& input) {
  const std::vector<scene::Light>& lights = input.scene.lights;
  return input.settings.relight ? std::ssize(lights) : std::ranges::count_if(lights, tracing::has_power);
}

std::string no_light(const PlanInput& input) {
  if (input.scene.lights.empty()) return "the scene has no light";
  return shining_lights(input) > 0 ? "" : "no light has power";
}

std::string size_of(const scene::Environment& environment) {
  if (environment.width * environment.height == 1) return "one colour all around";
  return fmt::format("a picture of {} x {} texels", environment.width, environment.height);
}

bool RunPlan::runs(const RunPart& part) const { return std::ranges::count(parts, &part) > 0; }

RunPlan make_plan(const preset::Preset& preset, const Settings& wanted, const scene::Scene& scene,
                  const scene::Bvh& bvh, const tracing::LeaveOut& leave_out) {
  Agreed agreed = agree(wanted, scene);
  RunPlan plan;
  plan.settings = agreed.settings;
  plan.settings.pixel_samples = pixel_samples(plan.settings, scene);
  plan.notes = std::move(agreed.notes);
  plan.why_no_layers = std::move(agreed.why_no_layers);
  const Settings& settings = plan.settings;
  plan.tables = make_run_tables(preset, settings, scene, bvh, leave_out);
  PlanInput input{preset, settings, scene, bvh, leave_out, plan.tables, tracing::count_objects(scene)};
  input.tiles = std::move(agreed.tiles);
  input.why_no_indirect = std::move(agreed.why_no_indirect);
  input.caustics = caustics_decision(input);
  input.estimate = estimate_decision(preset, settings, input.caustics);
  std::set<std::string_view> layers;
  for (const RunPart* part : parts_of(settings)) {
    PlanPart planned = part->plan(input);
    if (!planned.decisions.empty() && planned.decisions[0].runs) {
      plan.parts.push_back(part);
      if (part->make) layers.insert(part->layer);
    }
    add(std::move(planned), plan);
  }
  // What photons leave on receivers is seen by stages that come after them.
  std::stable_partition(plan.parts.begin(), plan.parts.end(), [](const RunPart* part) {
    return part == &photon_stage || part == &tile_stage || part == &indirect_photon_stage;
  });
  plan.layers = static_cast<int>(layers.size());
  plan.estimates_error = input.estimate.runs;
  plan.mixes_frames = plan.estimates_error && scene.camera.receiver < 0;
  plan.picture_bytes_a_pixel = plan.runs(smoothing_part) ? 256 : 48; // as measured; a film of two halves read back
  if (layers.empty())
    plan.notes.insert(plan.notes.begin(), fmt::format("there is nothing to render: {}", plan.decisions[0].reason));
  if (settings.relight && any_material(scene, scatter::is_rough))
    plan.notes.push_back("layers have no highlights of lamps on rough surfaces: what these throw is there");
  plan.notes.insert(plan.notes.begin(), scene.warnings.begin(), scene.warnings.end());
  return plan;
}

plan::Decision caustics_decision(const PlanInput& input) {
  const char* const name = "photons";
  if (!input.settings.caustic) return not_asked_for(name, "caustic");
  // No field turns these on, as there is nothing to send.
  if (const std::string dark = no_light(input); !dark.empty()) return {name, false, dark};
  const std::string missing = !input.objects.throw_caustics() ? "no object is of glass or a mirror"
                              : input.objects.diffuse == 0    ? "no diffuse surface can receive a caustic"
                                                              : "";
  if (!missing.empty()) return tracing::not_needed(name, input.leave_out.photons, missing);
  if (input.tables.emitters.empty())
    return {name, false,
            input.tables.has_even_sky ? "all light that shines on glass and mirrors is even: it is found from the eye"
                                      : "no light shines on glass or a mirror"};
  return tracing::needed(name,
                         fmt::format("{} photons a pass in {}", input.tables.photons_per_pass(),
                                     counted(std::ssize(input.tables.wavelengths.clusters), "wavelength cluster")));
}

plan::Decision jitter_decision(const PlanInput& input) {
  const char *const name = "jitter", *const field = "/spectral/jitter";
  if (!input.settings.jitter)
    return {name, false, "spectral.jitter is false: every path of a cluster has the cluster's mean n", field, true};
  if (input.settings.relight)
    return {name, false, "spectral.relight is true: a layer holds clusters as a whole", "/spectral/relight", false};
  if (!input.tables.wavelengths.clusters_spread)
    return {name, false, "n is the same at all wavelengths of every cluster"};
  return {name, true, "each path takes one wavelength of its cluster, so clusters leave no bias", field, true};
}

} // namespace nephroid::photons
