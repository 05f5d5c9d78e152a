// SPDX-License-Identifier: Apache-2.0
#include "environment/plan.h"

#include "environment/bake/bake.h"
#include "environment/describe_settings.h"
#include "environment/photons.h"
#include "environment/sheet.h"
#include "environment/view/renderer.h"
#include "tracing/omissions.h"
#include "tracing/world.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>

namespace nephroid::environment {
namespace {

/// anew: whether there is a file that cannot be used.
plan::Decision bake_decision(const EnvironmentPlan& plan, const Settings& s, bool anew) {
  const auto missing = std::ranges::count(plan.baked, false, &PlannedBake::reads);
  if (missing == 0) {
    std::vector<std::string> files;
    for (const PlannedBake& bake : plan.baked) files.push_back(bake.file.string());
    return {"bake", false,
            fmt::format("{} {} it: the same object, material and settings", fmt::join(files, ", "),
                        files.size() == 1 ? "has" : "have")};
  }
  return {
      "bake", true,
      fmt::format("{}{}: {} photons from each of {} directions onto {} spheres with {} radii{}", anew ? "anew, " : "",
                  plan.task->caster.name, s.photons, s.directions, s.spheres, preset::word(s.radii),
                  plan.baked.size() == 1 ? ""
                                         : fmt::format(", for {} of the {} shapes that its states' weights are between",
                                                       missing, plan.baked.size()))};
}

plan::Decision colours_decision(const BakeTask& task) {
  return {"colours", task.coloured,
          task.coloured ? "each photon has one wavelength of white light"
                        : "all wavelengths go the same way and lose alike: one channel"};
}

/// The code omissions that concern photons on their way through the object.
std::vector<plan::Decision> code_decisions(const preset::Preset& preset, const BakeTask& task) {
  static constexpr std::array<std::string_view, 4> names{"mirrors", "bending", "attenuation", "smooth normals"};
  std::vector<plan::Decision> decisions =
      tracing::code_omissions(tracing::LeaveOut{.all = preset.leave_out}, task.caster.scene,
                              task.tables.wavelengths.takes_light)
          .decisions;
  std::erase_if(decisions, [](const plan::Decision& decision) { return !std::ranges::count(names, decision.name); });
  return decisions;
}

/// Rows that say whether caustics are visible at all, and by which light.
std::vector<plan::Decision> view_decisions(const preset::Preset& preset, const RenderTask* render) {
  const Settings& s = settings(preset);
  if (!render) return {{"view", false, "the scene has no light: only the spheres are shown"}};
  const std::size_t lights = render->segmentation.lights.size();
  const bool sky = render->cube.size > 0;
  std::vector<plan::Decision> decisions;
  const bool even = is_cut_evenly(preset, render->cube);
  decisions.push_back(
      {"segments", sky && !even,
       !sky   ? "there is no environment, only lamps"
       : even ? fmt::format("the environment has one colour all around: {} equal lights", lights)
              : fmt::format("the environment is cut into {} lights by {}", lights, preset::word(s.segmentation))});
  decisions.push_back(
      {"occlusion", sky && render->has_surroundings,
       !sky ? "there is no environment"
       : render->has_surroundings
           ? fmt::format("{} rays a light from {}", samples_per_light(lights),
                         s.occlusion == Settings::Occlusion::thesis ? "the object's middle" : "all over the object")
           : "nothing stands around the object"});
  const bool receivers = tracing::count_objects(*render->scene).diffuse > 0;
  decisions.push_back({"cast", receivers && s.cast,
                       !s.cast     ? "environment.cast is false"
                       : receivers ? "caustics on diffuse surfaces, where a path ends"
                                   : "no surface is diffuse"});
  decisions.push_back({"volume", render->has_medium,
                       render->has_medium ? "caustics in the air: 128 steps a path"
                                          : "there is no medium: environment.extinction or albedo is 0"});
  decisions.push_back({"colours of the view", render->coloured,
                       render->coloured ? "glass is looked through in three colours"
                                        : "all wavelengths go the same way and lose alike"});
  return decisions;
}

/// Rows that say whether photons join, and how.
std::vector<plan::Decision> photon_decisions(const Settings& s, const photons::RunPlan* photons) {
  const char* const field = "/environment/refine";
  if (!s.refine)
    return {{"photons", false, "environment.refine is false: spheres alone, as in the thesis", field, true}};
  const auto row = [&](std::string_view name) {
    return *std::ranges::find(photons->decisions, name, &plan::Decision::name);
  };
  if (!s.cast) return {{"photons", false, "environment.cast is false"}};
  const plan::Decision sent = row("photons");
  if (!sent.runs) return {{"photons", false, sent.reason}};
  const plan::Decision kept = row("light on receivers");
  return {{"photons", true, sent.reason + ", in the place of the spheres as soon as they have a whole picture", field,
           true},
          {kept.name, kept.runs, kept.reason}};
}

std::vector<plan::PlannedBuffer> view_buffers(const RenderTask& render, const BakeTask& bake, std::size_t bakes) {
  const scene::Scene& s = *render.scene;
  const std::uint64_t sky = s.environment ? tracing::bytes_of(s.environment->rgb) : 0;
  std::uint64_t whole = 0;
  for (const plan::PlannedBuffer& buffer : tracing::planned_buffers(s, *render.bvh, render.tables))
    whole += buffer.bytes;
  return {{"caustic spheres", bakes * bake.bytes()},
          {"whole scene", whole},
          {"environment", sky},
          {"receivers", Renderer::receiver_bytes()},
          {"paths of the view", Renderer::bytes_a_pixel(render) * s.camera.pixels()},
          {"medium", render.has_medium ? Renderer::medium_bytes(bake.empty_bake()) : 0},
          {"environment (host)", 2 * sky + tracing::bytes_of(render.cube.flux), true}};
}

std::vector<plan::PlannedBuffer> buffers_of(const EnvironmentPlan& plan, const scene::Scene& scene) {
  const BakeTask& task = *plan.task;
  const std::uint64_t sums = task.film_bytes() / task.radii.size(), object = tracing::mesh_bytes(task.caster.scene),
                      bakes = plan.baked.size(), several = bakes > 1 ? 1 : 0;
  // Of several bakes one is copied when it is read or written. The object as it stands is none of theirs.
  std::vector<plan::PlannedBuffer> list{
      {"scene (host)", tracing::mesh_bytes(scene) + (bakes + several) * (object + tracing::tree_bytes(task.bvh)), true},
      {"caustic spheres (host)", (bakes + several) * task.bytes(), true},
      {"pictures of spheres (host)", picture_bytes(task), true}};
  if (!plan.bakes) return list;
  list.push_back({"one sphere's sums (host)", sums, true});
  std::ranges::move(tracing::planned_buffers(task.caster.scene, task.bvh, task.tables), std::back_inserter(list));
  list.push_back({"spheres of one direction", task.film_bytes()});
  return list;
}

/// Without keys and files. own: the task of the object as it stands.
std::vector<PlannedBake> planned_bakes(const preset::Preset& preset, const std::shared_ptr<const BakeTask>& own) {
  const std::vector<BakedShape> shapes = baked_shapes(preset);
  std::vector<PlannedBake> bakes(shapes.size());
  bakes.front().task = own;
  if (bakes.size() == 1) return bakes;
  for (std::size_t i = 0; i < bakes.size(); ++i) try {
      bakes[i].task = std::make_shared<const BakeTask>(make_task(shapes[i].preset));
      bakes[i].weight = shapes[i].weight;
    } catch (const Error& error) {
      throw error.noting(
          fmt::format("this is so at a step of a state's weight, where the object is baked: there are {} "
                      "from 0 to 1 (environment.weight_steps)",
                      settings(preset).weight_steps));
    }
  return bakes;
}

} // namespace

EnvironmentPlan make_plan(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh) {
  const Settings& s = settings(preset);
  EnvironmentPlan plan;
  plan.task = std::make_shared<const BakeTask>(make_task(preset));
  const BakeTask& task = *plan.task;
  if (has_light(scene))
    plan.render = std::make_shared<const RenderTask>(make_render_task(preset, scene, bvh, task.caster));
  if (plan.render && s.refine) plan.photons = plan_photons(preset, *plan.render->scene, *plan.render->bvh);
  plan.mixes_frames = plan.photons && plan.photons->mixes_frames && !plan.render->has_medium;
  plan.engine = "environment";
  plan.baked = planned_bakes(preset, plan.task);
  std::vector<std::string> damaged;
  for (PlannedBake& bake : plan.baked) {
    bake.key = bake_key(preset, bake.task->caster);
    bake.file = bake_path(bake.key);
    const std::optional<std::string> fault = bake_file_fault(bake.file, {bake.key, 0});
    bake.reads = !fault;
    if (fault && !fault->empty())
      damaged.push_back(fmt::format("{}: {}; it is baked again", bake.file.string(), *fault));
  }
  plan.bakes = !std::ranges::all_of(plan.baked, &PlannedBake::reads);
  plan.decisions = {bake_decision(plan, s, !damaged.empty()), colours_decision(task)};
  const auto append = [](auto more, auto& list) { std::ranges::move(more, std::back_inserter(list)); };
  append(view_decisions(preset, plan.render.get()), plan.decisions);
  if (plan.render && scene.environment && !scene.environment->about.empty())
    plan.decisions.push_back({"sky", true, scene.environment->about, "/scene/environment", true});
  if (plan.render) append(photon_decisions(s, plan.photons ? &*plan.photons : nullptr), plan.decisions);
  append(code_decisions(preset, task), plan.decisions);
  plan.buffers = buffers_of(plan, scene);
  if (plan.render) append(view_buffers(*plan.render, task, plan.baked.size()), plan.buffers);
  if (plan.photons && plan.photons->layers > 0)
    for (const bool on_host : {false, true}) {
      plan::PlannedBuffer all{on_host ? "photons (host)" : "photons", 0, on_host};
      for (const plan::PlannedBuffer& buffer : plan.photons->buffers)
        if (buffer.on_host == on_host) all.bytes += buffer.bytes;
      plan.buffers.push_back(std::move(all));
    }
  plan.defines = task.defines;
  plan.layers = plan.render ? Renderer::layers(*plan.render) : 1;
  plan.smaller = "choose a smaller scene.camera.resolution, fewer environment.directions or environment.spheres, or a "
                 "smaller environment.resolution";
  plan.notes = scene.warnings;
  append(std::move(damaged), plan.notes);
  if (!plan.render && (scene.environment || !scene.lights.empty()))
    plan.notes.push_back("the scene's lights are black: the picture is a sheet of the baked spheres");
  if (plan.render && plan.render->cube.size > 0 && plan.render->segmentation.lights.empty())
    plan.notes.push_back(fmt::format(
        "no part of the environment is above environment.threshold {}, so its light makes no caustics", s.threshold));
  if (const double depth = s.extinction * task.radii.back(); plan.render && plan.render->has_medium && depth > 2)
    plan.notes.push_back(fmt::format(
        "environment.extinction {}: the largest sphere has a radius of {:.3g} extinction lengths; caustics in the air "
        "are right in a thin medium, of less than 2, and fade in a thicker one",
        s.extinction, depth));
  if (!task.caster.extent.middle_inside)
    plan.notes.push_back(fmt::format(
        "{}: its middle, about which the spheres stand, is outside of it; the smallest sphere has the radius "
        "{:.4g}, as the surface is {:.4g} from there",
        task.caster.name, task.radii.front(), task.caster.extent.nearest));
  if (any_material(scene, scatter::is_rough) && std::ranges::any_of(scene.lights, std::not_fn(scene::is_environment)))
    plan.notes.push_back("lamps make no highlights on rough surfaces in this engine");
  if (any_material(scene, scatter::is_coated))
    plan.notes.push_back("what a coating reflects to the camera has one colour in this engine, that of green light");
  if (std::ranges::any_of(scene.lights, scene::has_disc))
    plan.notes.push_back("caustics of a sun, or of another disc, are those of its middle in this engine's own light");
  if (any_material(scene, [](const scatter::Material& m) { return is_matt(m.type) && is_textured(m); }))
    plan.notes.push_back("textures multiply red, green and blue of this engine's own light; its photons have spectra");
  for (const scene::Object& object : task.caster.scene.objects)
    if (!object.closed && is_body(material_of(task.caster.scene, object)))
      plan.notes.push_back(
          fmt::format("object '{}': its mesh is open: light that comes in by its surface and leaves by a hole marks "
                      "spheres only on its last way",
                      object.name));
  return plan;
}

} // namespace nephroid::environment
