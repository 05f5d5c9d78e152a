// SPDX-License-Identifier: Apache-2.0
// What an engine is to the rest of the program: everything that run/, cli/ and ui/ know of it. An engine is a folder
// beside this one, with one constant `engine`, and a line in app/engines.cpp.
#pragma once
#include "check/check.h"
#include "compute/compute.h"
#include "job/job.h"
#include "mpi/rank_context.h"
#include "plan/plan.h"
#include "preset/preset.h"
#include "scene/bvh.h"
#include "scene/scene.h"

namespace nephroid::engine {

/// A shipped preset to begin with.
struct ShippedExample {
  const char* preset = nullptr; ///< its name: "first-light"
  const char* title = "";       ///< title of the engine's card on the window's start page
  const char* sentence = "";    ///< what the engine does, on that card
  const char* run = "";         ///< what `nephroid run PRESET` makes, in the help
};

/// A small, complete scene to begin with, which is in no file.
struct NewScene {
  const char* preset = nullptr; ///< as JSON
  const char* what = "";        ///< "A glass sphere under a sky"
};

/// A finished run's result as a preset among its own files (job::ExtraFile). The window offers to save and to open it.
struct ResultView {
  const char* file = nullptr; ///< its name: "view.json"
  const char* action = "";    ///< words of the offer: "Show as glass"
  const char* what = "";      ///< what is opened: "as lit glass over its receivers"
};

/// An engine's texts and its look in lists. Defaults are not shown.
struct Introduction {
  ShippedExample example = {};
  NewScene new_scene = {};
  ResultView result = {};
  std::array<unsigned char, 3> badge{80, 80, 80}; ///< sRGB behind the engine's name in lists, for white letters
};

/// How a preset took a file.
struct PictureEdit {
  std::string edit; ///< the edit's name in the history: "cast face.png"
  std::string note; ///< a sentence without a full stop
};

struct Engine {
  /// The settings' name is the word in a preset's "engine" and the folder in kernels/ with the engine's own kernels. A
  /// run is bound to the contents of files that they name (preset::Text::file).
  const preset::SettingsType& (*settings)();

  /// The version of the jobs' saved state. Change it with the format: only a state of this version is loaded.
  std::uint32_t state_version;

  /// What runs, what is left out and why. It may hold results for the job. Throws bad_input for what it cannot render.
  std::unique_ptr<plan::Plan> (*plan)(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh);

  /// The job on a device. plan: what `plan` gave for the same preset and scene. The scene and tree need not outlive the
  /// call. Throws failed if the device has too little memory, and BuildError for a kernel that does not compile.
  std::unique_ptr<job::Job> (*job)(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh,
                                   const plan::Plan& plan, const mpi::RankContext& context);

  /// The settings of a reference of `preset` with `passes` passes: the recipe's own, else the preset's, made exact.
  preset::Settings (*reference)(const preset::Preset& preset, int passes);

  /// The engine's closed forms through its real kernels, for `nephroid check`.
  std::vector<check::Check> (*checks)();

  /// Whether a job of `before` can adopt `now` (job::Job::adopt); both are of this engine. Null: never.
  bool (*adoptable)(const preset::Preset& before, const preset::Preset& now) = nullptr;

  /// Whether the scene has objects to select and to move; false: a camera alone.
  bool has_scene = true;

  /// The camera of the window's picture, which may be another one if the preset gives none. Null: the preset's.
  preset::Camera (*camera)(const preset::Preset& preset) = nullptr;

  /// Puts a picture file, dropped on the window, into the preset. Throws bad_input if it has no place. Null: none.
  PictureEdit (*take_picture)(preset::Preset& preset, const std::filesystem::path& file) = nullptr;

  Introduction introduction = {};
};

/// Every engine: one line each in app/engines.cpp. A default-constructed preset has the first one.
const std::vector<const Engine*>& engines();

/// All checks: those of what engines share, then each engine's own. They take under 30 s on two cores.
const std::vector<check::Check>& checks();

const Engine& engine_of(const preset::Preset& preset);

/// Throws bad_input at FILE#/engine if the preset is of another engine. lacks: what that one does, "casts no pictures".
void require_engine(const preset::Preset& preset, const Engine& engine, std::string_view lacks);

/// The camera of a preset's picture in the window.
preset::Camera camera_of(const preset::Preset& preset);

/// The word in a preset's "engine".
std::string_view name_of(const Engine& engine);

/// Whether a job of `before` can adopt `now`; engines may differ. A white yet to be fitted needs a new run.
bool adoptable(const preset::Preset& before, const preset::Preset& now);

} // namespace nephroid::engine
