// SPDX-License-Identifier: Apache-2.0
// What engine 1 runs for a preset and what it leaves out.
#include "plan/plan.h"
#include "base/counted.h"
#include "preset/choices.h"
#include "spectral/clusters/scene_clusters.h"
#include "spectral/describe_settings.h"
#include "spectral/effort/effort.h"
#include "spectral/effort/emission_guide.h"
#include "spectral/engine.h"
#include "spectral/maps/map_plan.h"
#include "spectral/relight/layer_cells.h"
#include "spectral/relight/layer_light.h"
#include "spectral/smoothing.h"
#include "spectral/tables/run_tables.h"
#include "tracing/omissions.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace nephroid::spectral {
namespace {

/// Why there are no photon maps.
plan::Pass no_maps_of_layers()
{
  return {"photon maps", false, "spectral.relight is true: layers are kept of splats, not of photon maps", "/spectral/relight", false};
}

/// What a run that keeps layers has in its plan: adds the pass "relighting", puts the layers' memory in place of the films' and takes out
/// what only runs without layers leave out. tables: of make_run_tables.
void plan_layers(const RunTables& tables, bool direct, bool photons, int halves, plan::Plan& plan)
{
  const std::size_t lights = tables.lights.size(), clusters = tables.wavelengths.clusters.size();
  std::erase_if(plan.passes, [](const plan::Pass& p) { return p.name == "dark lights" || p.name == "unlit wavelengths"; });
  const std::string split =
      fmt::format("; in a cluster, what a material leaves of two wavelengths differs by at most {}", largest_loss_difference);
  plan.passes.push_back({"relighting", true,
                         fmt::format("{} of {} in {} are kept apart, so that spectra and powers can change; dark ones too, for which "
                                     "half of the photons go to every cluster alike{}",
                                     counted(lights * clusters, "layer"), counted(lights, "light"), counted(clusters, "wavelength cluster"),
                                     tables.wavelengths.attenuator_count > 0 ? split : ""),
                         "/spectral/relight", true});

  std::erase_if(plan.buffers, [](const plan::PlannedBuffer& b) { return b.name == "film direct" || b.name == "film caustic"; });
  const LayerBudget budget = layer_budget(tables.camera, tables.spheres);
  const int reflectors = tables.wavelengths.reflector_count;
  const std::size_t unbent = padded_cells(budget.unbent, reflectors), bent = padded_cells(budget.bent, reflectors);
  const std::size_t pixels = static_cast<std::size_t>(tables.camera.width) * static_cast<std::size_t>(tables.camera.height);
  std::uint64_t beside = pixels * SURVEY_PLACES * (1 + SURVEY_PATHS) * sizeof(int); // the survey
  const auto film = [&](const char* name, std::size_t layers, std::size_t cells) {
    plan.buffers.push_back({name, sizeof(std::int64_t) * static_cast<std::uint64_t>(halves) * layers * cells});
    // Where the cells are, and two weighed pictures by cell and by pixel.
    beside += cells * sizeof(shared::LayerCell) + pixels * sizeof(int) + 6 * sizeof(float) * (cells + pixels);
  };
  if (direct) {
    film("film direct", lights, unbent);
    film("film direct through glass", lights * clusters, bent);
  }
  if (photons) film("film caustic", lights * clusters, unbent);
  plan.buffers.push_back({"survey and weighing", beside});
}

/// A layer that the preset does not ask for.
plan::Pass not_asked_for(const std::string& name, const std::string& field)
{
  return {name, false, fmt::format("spectral.{} is false", field), "/spectral/" + field, true};
}

/// What a preset with layers may not ask for: no field brings it back.
plan::Pass not_in_layers(const std::string& name, const std::string& why)
{
  return {name, false, "spectral.relight is true, and layers cannot hold it: " + why, "", false};
}

/// Lights that shine, or, where layers are kept, may shine when the light changes.
std::ptrdiff_t shining_lights(const Settings& settings, const scene::Scene& scene)
{
  return settings.relight ? std::ssize(scene.lights) : std::count_if(scene.lights.begin(), scene.lights.end(), tracing::has_power);
}

std::string no_light_reason(const Settings& settings, const scene::Scene& scene)
{
  if (scene.lights.empty()) return "the scene has no light";
  return shining_lights(settings, scene) > 0 ? "" : "no light has power";
}

constexpr const char* more_through_glass = ", more where glass or a mirror is seen";

plan::Pass direct_pass(const Settings& settings, const scene::Scene& scene, const tracing::ObjectCounts& objects,
                       const tracing::LeaveOut& leave_out)
{
  if (!settings.direct) return not_asked_for("direct", "direct");
  const std::string none = objects.diffuse == 0 ? "the scene has no diffuse surface" : no_light_reason(settings, scene);
  if (!none.empty()) return tracing::omission("direct", leave_out.direct, false, none);
  return tracing::omission("direct", leave_out.direct, true,
                           fmt::format("{} lit by {}, {} a pixel{}", counted(objects.diffuse, "diffuse object"),
                                       counted(shining_lights(settings, scene), "light"), counted(settings.pixel_samples, "sample"),
                                       !settings.relight && tracing::may_see_glass_or_mirror(scene) ? more_through_glass : ""));
}

plan::Pass photon_pass(const Settings& settings, const scene::Scene& scene, const tracing::ObjectCounts& objects, const RunTables& tables,
                       const tracing::LeaveOut& leave_out)
{
  if (!settings.caustic) return not_asked_for("photons", "caustic");
  // No field brings these back: there is nothing to send.
  if (const std::string none = no_light_reason(settings, scene); !none.empty()) return {"photons", false, none, "", false};
  const std::string none = objects.dielectrics + objects.mirrors == 0 ? "no object is of glass or a mirror"
                           : objects.diffuse == 0                     ? "no diffuse surface can receive a caustic"
                                                                      : "";
  if (!none.empty()) return tracing::omission("photons", leave_out.photons, false, none);
  if (tables.emitters.empty()) return {"photons", false, "no light shines on glass or a mirror", "", false};
  return tracing::omission("photons", leave_out.photons, true,
                           fmt::format("{} photons a pass in {}", tables.photons_per_pass,
                                       counted(std::ssize(tables.wavelengths.clusters), "wavelength cluster")));
}

plan::Pass indirect_pass(const Settings& settings, const scene::Scene& scene, const tracing::ObjectCounts& objects)
{
  if (settings.relight) return not_in_layers("indirect", "its light met several reflectors");
  if (!settings.indirect) return not_asked_for("indirect", "indirect");
  const std::string none = objects.diffuse == 0 ? "the scene has no diffuse surface" : no_light_reason(settings, scene);
  if (!none.empty()) return {"indirect", false, none, "", false};
  std::string reason = counted(settings.indirect_photons_per_pass, "photon a pass", "photons a pass");
  if (objects.dielectrics + objects.mirrors > 0)
    reason += ", shown where the camera sees a surface directly; through glass and in mirrors it is left out";
  return {"indirect", true, reason, "/spectral/indirect", true};
}

std::string size_of(const scene::Environment& environment)
{
  if (environment.width * environment.height == 1) return "one colour all around";
  return fmt::format("a picture of {} x {} texels", environment.width, environment.height);
}

/// Of a scene that has an environment.
plan::Pass environment_light_pass(const Settings& settings, const scene::Environment& environment)
{
  const std::string name = "environment light", field = "/scene/environment/lights";
  if (environment.is_black()) return {name, false, "the environment is black", "", false};
  if (settings.relight) return not_in_layers(name, "every texel has a spectrum of its own");
  if (!environment.lights) return {name, false, "scene.environment.lights is false: it is only seen", field, true};
  return {name, true, size_of(environment) + ": sends photons and lights diffuse surfaces, each texel by its flux", field, true};
}

plan::Pass background_pass(const Settings& settings, const scene::Scene& scene)
{
  if (!settings.background) return not_asked_for("background", "background");
  if (!scene.environment) return {"background", false, "there is no environment: what meets nothing is black", "", false};
  if (scene.environment->is_black()) return {"background", false, "the environment is black", "", false};
  return {"background", true,
          size_of(*scene.environment) + fmt::format(", seen directly, through glass and in mirrors; {} a pixel{}",
                                                    counted(settings.pixel_samples, "sample"),
                                                    tracing::may_see_glass_or_mirror(scene) ? more_through_glass : ""),
          "/spectral/background", true};
}

plan::Pass stray_photons_pass(const tracing::LeaveOut& leave_out, const RunTables& tables)
{
  return tracing::omission("stray photons", leave_out.stray_photons, false,
                           leave_out.stray_photons ? fmt::format("photons start towards {} about glass and mirrors only",
                                                                 counted(std::ssize(tables.spheres), "sphere"))
                                                   : "photons need not start where there is no glass and no mirror");
}

/// caustics: whether there are any.
plan::Pass estimate_pass(const preset::Preset& preset, bool caustics)
{
  if (preset.measure.estimate && caustics && spectral::settings(preset).estimator == Settings::Estimator::sppm)
    return {"error estimate", false, "spectral.estimator is sppm, whose radii hang on all photons: there are no two independent halves", "",
            false};
  // Nothing else can stop the run, so nobody may switch it off.
  if (preset.measure.estimate && preset.stop.error && !preset.reference)
    return {"error estimate", true, "every film is kept in two independent halves: stop.error needs them, there is no reference", "",
            false};
  return {"error estimate", preset.measure.estimate,
          preset.measure.estimate ? "every film is kept in two independent halves" : "measure.estimate is false", "/measure/estimate",
          true};
}

plan::Pass differentials_pass(const Settings& settings, const scene::Scene& scene, bool splats)
{
  const std::string field = "/spectral/differentials";
  if (settings.relight) return not_in_layers("differentials", "a layer is a whole cluster's");
  if (!settings.differentials) return not_asked_for("differentials", "differentials");
  if (!splats) return {"differentials", false, "nothing is splatted", "", false};
  const tracing::StretchParameter along = tracing::stretch_parameter(scene);
  if (along == tracing::StretchParameter::none)
    return {"differentials", false, "no glass bends one wavelength otherwise than another", "", false};
  return {"differentials", true,
          fmt::format("splats are stretched along the way that they move with the {}",
                      along == tracing::StretchParameter::index ? "index of refraction" : "wavelength, for there are several curves"),
          field, true};
}

/// halves: whether films are kept in two, which tells how noisy they are. passes: at most so many, if known.
plan::Pass smoothing_pass(const Settings& settings, bool caustics, bool halves, std::optional<int> passes)
{
  using Smoothing = Settings::Smoothing;
  if (settings.smoothing == Smoothing::off) return {"smoothing", false, "spectral.smoothing is off", "", false};
  if (!caustics) return {"smoothing", false, "there are no caustics", "", false};
  if (settings.estimator == Settings::Estimator::sppm)
    return {"smoothing", false, "spectral.estimator is sppm, which has radii of its own", "", false};
  if (!halves) return {"smoothing", false, "measure.estimate is false: nothing tells how noisy a pixel is", "/measure/estimate", true};
  if (passes == 1) return {"smoothing", false, "the run has one pass, and it takes two to tell how noisy a pixel is", "", false};
  return {"smoothing", true,
          fmt::format("a pixel's caustics are spread until their noise is {} of them, {}; the estimated error takes in how far it goes",
                      spectral::Smoothing::noise,
                      settings.smoothing == Smoothing::on ? "everywhere" : "where the two halves of the film say that it helps"),
          "", false};
}

std::uint64_t film_bytes(const scene::Scene& scene, int halves)
{
  return static_cast<std::uint64_t>(halves) * 3 * sizeof(std::int64_t) * static_cast<std::uint64_t>(scene.camera.width) *
         scene.camera.height;
}

std::uint64_t bytes_of(const auto& items) { return items.size() * sizeof(items[0]); }

plan::Pass jitter_pass(const Settings& settings, const tracing::WavelengthTables& tables)
{
  const std::string field = "/spectral/jitter";
  if (!settings.jitter) return {"jitter", false, "spectral.jitter is false: every path of a cluster has the cluster's mean n", field, true};
  if (settings.relight) return {"jitter", false, "spectral.relight is true: a layer holds clusters as a whole", "/spectral/relight", false};
  if (!tables.clusters_spread) return {"jitter", false, "n is the same at all wavelengths of every cluster", "", false};
  return {"jitter", true, "each path takes one wavelength of its cluster, so clusters leave no bias", field, true};
}

/// Wavelengths of a cluster in one pass, where photon maps need photons and eye paths of one wavelength: so many that a pass has 32 in all,
/// for a picture of a few wavelengths has a cast. In sppm a pass has one cluster's turn after the other, with one each.
int pass_bands(const Settings& settings, bool jittered_maps, const tracing::WavelengthTables& tables)
{
  if (!jittered_maps || settings.estimator == Settings::Estimator::sppm) return 1;
  return std::max(1, 32 / static_cast<int>(std::max<std::size_t>(tables.clusters.size(), 1)));
}

plan::Pass low_discrepancy_pass(const Settings& settings)
{
  const std::string field = "/spectral/low_discrepancy";
  if (!settings.low_discrepancy) return {"low discrepancy", false, "spectral.low_discrepancy is false: plain random numbers", field, true};
  return {"low discrepancy", true, "photons leave the lights by a scrambled Sobol sequence", field, true};
}

std::vector<plan::PlannedBuffer> buffers(const scene::Scene& scene, const scene::Bvh& bvh, const RunTables& tables, bool direct,
                                         bool photons, int halves)
{
  const tracing::WavelengthTables& w = tables.wavelengths;
  const std::uint64_t tree = bytes_of(bvh.nodes) + bytes_of(bvh.blocks),
                      triangles = bytes_of(scene.geometry.triangles) + bytes_of(scene.geometry.positions) +
                                  bytes_of(scene.geometry.normals) + bytes_of(scene.object_of_primitive),
                      environment = scene.environment ? bytes_of(scene.environment->rgb) : 0,
                      sky = tables.sky ? tracing::bytes_of(*tables.sky) : 0;
  std::vector<plan::PlannedBuffer> list{
      {"scene (host)", tree + triangles + environment + sky, true},
      {"tree", tree},
      {"triangles", triangles},
      {"wavelength tables", bytes_of(w.index_of_cluster) + bytes_of(w.index_of_wavelength) + bytes_of(w.wavelength_cdf) +
                                bytes_of(w.coefficient) + bytes_of(w.reflectance) + bytes_of(w.light_xyz) + bytes_of(w.reflected_xyz) +
                                bytes_of(w.reflected_xyz_all) + bytes_of(w.cluster_wavelengths)}};
  const std::uint64_t pixels = static_cast<std::uint64_t>(scene.camera.width) * static_cast<std::uint64_t>(scene.camera.height);
  list.push_back({"pixels", 2 * sizeof(std::uint32_t) * pixels}); // all, and those of glass
  if (direct) list.push_back({"film direct", film_bytes(scene, halves)});
  if (photons) list.push_back({"film caustic", film_bytes(scene, halves)});
  if (sky > 0) list.push_back({"environment as a light", sky});
  return list;
}

/// Settings that do nothing, or not what they are for.
std::vector<std::string> setting_notes(const preset::Preset& preset, const scene::Scene& scene, const RunTables& tables, bool splats,
                                       bool maps, const plan::Pass& smoothing)
{
  const Settings& settings = spectral::settings(preset);
  std::vector<std::string> notes;
  if (settings.step_nm > 1 && settings.method != Settings::Method::brute_force)
    notes.push_back(fmt::format("spectral.step_nm: {} does nothing here: spectral.method is {}, and only brute_force has steps",
                                settings.step_nm, preset::word(settings.method)));
  const bool insists = settings.smoothing == Settings::Smoothing::on;
  if (insists && !smoothing.runs) notes.push_back("spectral.smoothing: on does nothing here: " + smoothing.reason);
  if (insists && smoothing.runs && preset.stop.error && !preset.reference)
    notes.push_back("stop.error: the run's own estimate may not know how far spectral.smoothing moves light; a 'reference' does");
  if (const std::string note = map_radius_note(settings, scene); maps && !note.empty()) notes.push_back(note);
  if (splats && tables.photons_per_pass > static_cast<unsigned>(settings.photons_per_pass))
    notes.push_back(fmt::format("spectral.photons_per_pass: raised from {} to {}, one for each cluster of each light",
                                settings.photons_per_pass, tables.photons_per_pass));
  return notes;
}

} // namespace

RunPlan make_plan(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh)
{
  return make_plan(preset, scene, bvh, tracing::LeaveOut{.all = preset.leave_out});
}

RunPlan make_plan(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh, const tracing::LeaveOut& leave_out)
{
  const Settings& settings = spectral::settings(preset);
  RunPlan plan;
  plan.tables = make_run_tables(preset, scene, bvh, leave_out);
  const RunTables& tables = plan.tables;
  const tracing::ObjectCounts objects = tracing::count_objects(scene);
  const int attenuators = tables.wavelengths.attenuator_count;
  plan.engine = "spectral";
  const plan::Pass direct = direct_pass(settings, scene, objects, leave_out);
  plan::Pass photons = photon_pass(settings, scene, objects, tables, leave_out);
  const bool caustics = photons.runs;
  const plan::Pass estimate = estimate_pass(preset, caustics);
  const int halves = estimate.runs ? 2 : 1;
  const MapPlan maps = settings.relight ? MapPlan{no_maps_of_layers(), {}}
                                        : plan_maps(settings, scene, tables, caustics, film_bytes(scene, halves), leave_out.photon_maps);
  if (caustics && settings.estimator == Settings::Estimator::sppm)
    photons = {"photons", false, "spectral.estimator is sppm: nothing is splatted", "", false};
  const plan::Pass differentials = differentials_pass(settings, scene, photons.runs);
  const plan::Pass smoothing = smoothing_pass(settings, caustics, estimate.runs, preset.stop.passes);
  const plan::Pass jitter = jitter_pass(settings, tables.wavelengths);
  const plan::Pass indirect = indirect_pass(settings, scene, objects), background = background_pass(settings, scene);
  plan.passes = {direct, photons};
  if (caustics)
    for (const plan::Pass& pass : {effort_pass(settings, tables.importance), stray_photons_pass(leave_out, tables), jitter,
                                   low_discrepancy_pass(settings), differentials, smoothing})
      plan.passes.push_back(pass);
  const tracing::CodeOmissions code = tracing::code_omissions(leave_out, scene, attenuators);
  for (const std::vector<plan::Pass>& passes : {tracing::data_omissions(leave_out, scene, tables.spheres), code.passes})
    plan.passes.insert(plan.passes.end(), passes.begin(), passes.end());
  for (const plan::Pass& pass : {maps.pass, indirect, background, estimate}) plan.passes.push_back(pass);
  if (scene.environment) plan.passes.push_back(environment_light_pass(settings, *scene.environment));
  plan.direct = direct.runs;
  plan.photons = photons.runs;
  plan.maps = maps.pass.runs;
  plan.smoothing = smoothing.runs;
  plan.indirect = indirect.runs;
  plan.background = background.runs;
  plan.estimates_error = estimate.runs;
  plan.picture_bytes_a_pixel = smoothing.runs ? 120 : 48; // what is smoothed; a film of two halves read back
  plan.layers = direct.runs + caustics + indirect.runs + background.runs;
  plan.buffers = buffers(scene, bvh, tables, direct.runs, photons.runs, halves);
  if (indirect.runs) plan.buffers.push_back({"film indirect", film_bytes(scene, halves)});
  if (background.runs) {
    plan.buffers.push_back({"environment", bytes_of(scene.environment->rgb)});
    plan.buffers.push_back({"film background", film_bytes(scene, halves)});
  }
  if (photons.runs && !settings.relight &&
      (settings.effort == Settings::Effort::variance || settings.effort == Settings::Effort::automatic))
    plan.buffers.push_back({"guide of directions",
                            tables.lights.size() * (EmissionGuide::floats * sizeof(float) + EmissionGuide::cells * sizeof(std::int64_t))});
  if (smoothing.runs) plan.buffers.push_back({"surfaces in pixels (host)", Smoothing::bytes(scene.camera), true});
  if (settings.relight) plan_layers(tables, direct.runs, photons.runs, halves, plan);
  plan.buffers.insert(plan.buffers.end(), maps.buffers.begin(), maps.buffers.end());
  plan.defines = code.defines;
  plan.defines["NEPHROID_DIFFERENTIALS"] = std::to_string(int(differentials.runs));
  plan.defines["NEPHROID_JITTER"] = std::to_string(int(jitter.runs));
  plan.defines["NEPHROID_PASS_BANDS"] = std::to_string(pass_bands(settings, jitter.runs && maps.pass.runs, tables.wavelengths));
  plan.defines["NEPHROID_LOW_DISCREPANCY"] = std::to_string(int(settings.low_discrepancy));
  plan.defines["NEPHROID_FILM_HALVES"] = std::to_string(halves);
  plan.defines["NEPHROID_MAX_SURFACES"] = std::to_string(settings.max_surfaces);
  plan.defines["NEPHROID_ELLIPSOIDS"] = bvh.ellipsoid_places.empty() ? "0" : "1";
  plan.defines["NEPHROID_BVH_STACK"] = std::to_string(std::max(bvh.stack, 1));
  plan.notes = scene.warnings;
  if (!direct.runs && !caustics && !indirect.runs && !background.runs)
    plan.notes.push_back(fmt::format("there is nothing to render: {}", direct.reason));
  std::ranges::move(setting_notes(preset, scene, tables, photons.runs, maps.pass.runs, smoothing), std::back_inserter(plan.notes));
  return plan;
}

} // namespace nephroid::spectral
