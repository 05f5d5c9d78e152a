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
  const char* title = "";       ///< of the engine's card on the window's start page
  const char* sentence = "";    ///< what the engine does, on that card
  const char* run = "";         ///< what `nephroid run PRESET` makes, in the help
};

/// A scene to begin with: small, complete, and in no file.
struct NewScene {
  const char* preset = nullptr; ///< as JSON
  const char* what = "";        ///< "A glass sphere under a sky"
};

/// What a finished run found, as a preset among its own files (job::ExtraFile), which the window offers to save and to
/// open.
struct ResultView {
  const char* file = nullptr; ///< its name: "view.json"
  const char* action = "";    ///< of the offer: "Show as glass"
  const char* what = "";      ///< what is opened: "as lit glass over its receivers"
};

/// What people read and see of an engine beside its runs. A default is left out wherever it is shown.
struct Introduction {
  ShippedExample example = {};
  NewScene new_scene = {};
  ResultView result = {};
  std::array<unsigned char, 3> badge{80, 80,
                                     80}; ///< sRGB behind the engine's name in lists; dark enough for white letters
};

/// What became of a file that a preset took.
struct PictureEdit {
  std::string edit; ///< the edit's name in the history: "cast face.png"
  std::string note; ///< a sentence without a full stop
};

struct Engine {
  /// Their name is the word in a preset's "engine", and the folder in kernels/ that has the engine's own kernels. What
  /// their description calls a file (preset::Text::file) is read: a run is bound to what it held (run/content.h).
  const preset::SettingsType& (*settings)();

  /// Of what its jobs save: another number where they save it in another way. Only a state of this version is loaded
  /// again.
  std::uint32_t state_version;

  /// What runs, what is left out and why. The engine may add what it worked out on the way, for its job. Throws
  /// bad_input for what it cannot render.
  std::unique_ptr<plan::Plan> (*plan)(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh);

  /// The job on a device. plan: what `plan` gave for the same preset and scene. The scene and tree need not outlive the
  /// call. Throws failed where the device has not enough memory, BuildError for a kernel that does not compile.
  std::unique_ptr<job::Job> (*job)(const preset::Preset& preset, const scene::Scene& scene, const scene::Bvh& bvh,
                                   const plan::Plan& plan, const mpi::RankContext& context);

  /// The settings of a reference of `preset` with so many passes: the recipe's own, or else the preset's, made exact.
  /// They leave no bias but what the recipe asks for.
  preset::Settings (*reference)(const preset::Preset& preset, int passes);

  /// The engine's closed forms through its real kernels, for `nephroid check`.
  std::vector<check::Check> (*checks)();

  /// Whether a job of `before` may take on `now` (job::Job::adopt); both are of this engine. Null: never.
  bool (*adoptable)(const preset::Preset& before, const preset::Preset& now) = nullptr;

  /// Whether the scene of its presets has things to select and to move; false: a camera alone.
  bool has_scene = true;

  /// The camera that the window's picture is seen by, where that may be another than the preset's: where that says
  /// nothing. Null: the preset's.
  preset::Camera (*camera)(const preset::Preset& preset) = nullptr;

  /// Puts a picture's file, which is there and was dropped on the window, into the preset. Throws bad_input where that
  /// has no place for it. Null: its presets take no picture.
  PictureEdit (*take_picture)(preset::Preset& preset, const std::filesystem::path& file) = nullptr;

  Introduction introduction = {};
};

/// Every engine there is: app/engines.cpp, a line each. A default-constructed preset has the first one.
const std::vector<const Engine*>& engines();

/// All checks there are: first those of what engines share, then each engine's own. Under 30 s together on two
/// processor cores.
const std::vector<check::Check>& checks();

/// Of a preset.
const Engine& engine_of(const preset::Preset& preset);

/// Throws bad_input at FILE#/engine for a preset of another engine. lacks: what that one cannot, "casts no pictures".
void require_engine(const preset::Preset& preset, const Engine& engine, std::string_view lacks);

/// The camera that a preset's picture in the window is seen by.
preset::Camera camera_of(const preset::Preset& preset);

/// The word in a preset's "engine".
std::string_view name_of(const Engine& engine);

/// Whether a job of `before` may take on `now`, whatever engines they are of. A white that is to be fitted takes
/// another run.
bool adoptable(const preset::Preset& before, const preset::Preset& now);

} // namespace nephroid::engine
