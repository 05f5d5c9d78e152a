// SPDX-License-Identifier: Apache-2.0
// `nephroid export`: a scene with its caustics for Blender and whatever else reads glTF.
#include "formats/export/export.h"

#include "base/interrupts.h"
#include "cli/progress.h"
#include "cli/run_target.h"
#include "cli/verb.h"
#include "engine/engine.h"
#include "preset/animation.h"
#include "preset/origins.h"
#include "preset/read.h"
#include "preset/settings_type.h"
#include "run/exposure.h"
#include "run/folder.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>

namespace nephroid::cli {
namespace fs = std::filesystem;
namespace {

struct ExportOptions {
  RunOptions run;
  std::vector<std::string> receivers;
  int size = 1024;
  double seconds = 30;
};

/// The animation's first frame, or the preset itself.
preset::Preset still(preset::Preset preset) { return preset.animation ? preset::at_frame(preset, 0) : preset; }

/// Whether a run of the preset has light from wall to wall. `prepared` lends its scene.
bool has_indirect(const preset::Preset& preset, const run::Prepared& prepared, const Watch& watch) {
  const run::Prepared whole = run::prepare(still(preset), &prepared, watch);
  return std::ranges::any_of(whole.plan->decisions,
                             [](const plan::Decision& d) { return d.name == "indirect" && d.runs; });
}

/// The preset as one of engine 1 that splats photons on matt surfaces and does nothing else. The preset may be of any
/// engine.
preset::Preset caustics_only(const ExportOptions& options, const preset::Preset& asked) {
  preset::Overrides overrides = options.run.overrides;
  for (const char* more :
       {"engine=spectral", "spectral.direct=false", "spectral.background=false", "spectral.indirect=false",
        "spectral.caustic=true", "spectral.relight=false", "spectral.estimator=splat"})
    overrides.emplace_back(more);
  if (asked.settings.type().name != "spectral" && asked.scene.environment)
    overrides.emplace_back("scene.environment.lights=true");
  preset::Preset preset = still(preset::read_preset(options.run.preset, overrides));
  preset.white = 1; // even if an animation has another
  preset.reference.reset();
  preset.stop = {};
  preset.stop.seconds = options.seconds;
  return preset;
}

std::string name_of(const scene::Scene& scene, const formats::Receiver& receiver) {
  return scene.objects[static_cast<std::size_t>(receiver.object)].name;
}

/// The receivers asked for, or all.
std::vector<formats::Receiver> chosen(const ExportOptions& options, const scene::Scene& scene) {
  std::vector<formats::Receiver> all = formats::receivers_of(scene);
  std::vector<std::string> names;
  for (const formats::Receiver& receiver : all) names.push_back(name_of(scene, receiver));
  if (all.empty())
    throw bad_input(options.run.preset, "has no flat matt object", "expected one that a caustic can fall on");
  const std::vector<std::string>& wanted = options.receivers;
  for (const std::string& name : wanted)
    if (std::ranges::count(names, name) == 0)
      throw bad_input("--receiver", fmt::format("no flat matt object is called '{}'", name),
                      fmt::format("one of: {}", fmt::join(names, ", ")));
  if (!wanted.empty())
    std::erase_if(all, [&](const formats::Receiver& receiver) {
      return std::ranges::count(wanted, name_of(scene, receiver)) == 0;
    });
  return all;
}

/// Nothing if no light falls on the receiver.
std::optional<formats::Caustic> caustic_on(const ExportOptions& options, const run::Prepared& prepared,
                                           const formats::Receiver& receiver, const compute::Context& context,
                                           const std::stop_token& interrupted) {
  const std::string name = name_of(prepared.loaded->scene, receiver);
  const run::Prepared lit = run::with_scene(
      prepared, formats::irradiance_view(prepared.loaded->scene, receiver, options.size), "choose a smaller --size");
  ProgressDisplay display(progress_style(false), {name, prepared.preset.name}, {});
  const job::Snapshot last = run::render_picture(lit, context, [&](const job::Progress& progress) {
    if (interrupted.stop_requested())
      throw Error(ErrorKind::interrupted, "export", "was interrupted", "nothing is written");
    display.update(progress);
    return true;
  });
  display.finish(last.progress);
  formats::Caustic caustic(lit.loaded->scene, receiver, *last.picture);
  if (!(caustic.watts > 0)) return std::nullopt;
  return caustic;
}

void export_scene(const ExportOptions& options, const std::stop_token& interrupted) {
  const preset::Preset asked = still(preset::read_preset(options.run.preset, options.run.overrides));
  const engine::Engine& engine = engine::engine_of(asked);
  if (!engine.has_scene)
    throw bad_input(
        asked.source,
        fmt::format("is of the engine '{}', which makes its glass only when it runs", engine::name_of(engine)), {},
        fmt::format("run it first, then export {} of its folder", engine.introduction.result.file));
  const fs::path folder = options.run.folder.empty()
                              ? fs::path("out") / (preset::stem_of(options.run.preset) + "-export")
                              : options.run.folder;
  const preset::Preset preset = caustics_only(options, asked);
  preset::at_origins(preset, [&] {
    const Watch watch{interrupted, {}};
    const run::Prepared prepared = run::prepare(preset, nullptr, watch);
    const std::vector<formats::Receiver> receivers = chosen(options, prepared.loaded->scene);
    if (prepared.plan->layers == 0)
      throw bad_input(preset.source,
                      "has no caustic: " +
                          std::ranges::find(prepared.plan->decisions, "photons", &plan::Decision::name)->reason);
    run::DeviceOnDemand device(device_opener(options.run.device));
    const compute::Context& context = device.context();
    const run::ClaimedFolder claimed(folder, true, {"an export", {formats::list_file}});
    std::optional<run::Prepared> lender = prepared;
    const double white = asked.white ? *asked.white : run::fitted_white(asked, lender, device, watch);
    std::vector<formats::Caustic> caustics;
    std::vector<std::string> notes = prepared.plan->notes;
    for (const formats::Receiver& receiver : receivers)
      if (auto caustic = caustic_on(options, prepared, receiver, context, interrupted))
        caustics.push_back(std::move(*caustic));
      else
        notes.push_back(fmt::format("'{}' has no picture: no light comes to it through glass or from a mirror",
                                    name_of(prepared.loaded->scene, receiver)));
    std::ranges::move(formats::write_export(folder, prepared.loaded->scene, asked, caustics, white,
                                            has_indirect(asked, prepared, watch)),
                      std::back_inserter(notes));
    for (const std::string& note : notes) fmt::print(stderr, "note: {}\n", note);
    for (const formats::Caustic& caustic : caustics)
      fmt::print("{}: {:.4g} luminous watts on '{}'\n", (folder / caustic.file).string(), caustic.watts,
                 name_of(prepared.loaded->scene, caustic.receiver));
    fmt::print("{}\n", (folder / "scene.glb").string());
  });
}

} // namespace

void add_export(CLI::App& program, Session&) {
  const auto options = std::make_shared<ExportOptions>();
  Verb verb(
      program, "export", "A scene with its caustics for Blender and other renderers: glTF and pictures of irradiance",
      {{"nephroid export first-light --receiver floor --seconds 4", "writes out/first-light-export"}},
      "scene.glb holds meshes, materials, the camera, lamps, and each caustic as light that its receiver sends out.\n"
      "caustic-N-NAME.exr is what falls on a flat matt object through glass and by way of mirrors, in luminous W/m^2.\n"
      "blender.py puts all of it together: blender --python out/first-light-export/blender.py");
  verb.option("PRESET", options->run.preset,
              {.says = "A preset file or the name of a shipped preset", .required = true});
  verb.option("-o,--output", options->run.folder,
              {.type = "DIR", .says = "Folder for the files (default out/NAME-export)"});
  verb.overrides(options->run.overrides);
  verb.option(
      "--receiver", options->receivers,
      {.type = "NAME", .says = "Only this flat matt object's caustic; may be repeated (default: of all there are)"});
  verb.option("--size", options->size,
              {.type = "N", .says = "Pixels of a picture's longer edge (default 1024)", .from = 1, .to = 16384});
  verb.option("--seconds", options->seconds,
              {.type = "S", .says = "Work for each picture (default 30)", .from = 0.001, .to = 1e9});
  verb.option("--device", options->run.device.selector,
              {.type = "SEL", .says = "An index or part of a name (see nephroid devices)"});
  verb.work([options] {
    const Interrupts interrupts; // before OpenCL starts its threads
    export_scene(*options, interrupts.token());
  });
}

} // namespace nephroid::cli
