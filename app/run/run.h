// SPDX-License-Identifier: Apache-2.0
// From a preset to a running engine and to the files of a finished run: the one place that knows all engines.
// The command line and the window both come through here.
#pragma once
#include "base/file_lock.h"
#include "base/watch.h"
#include "compute/compute.h"
#include "image/image.h"
#include "job/job.h"
#include "measure/measured_job.h"
#include "plan/plan.h"
#include "preset/preset.h"
#include "scene/bvh.h"
#include "scene/scene.h"
#include "communicator/rank_context.h"

#include <nlohmann/json_fwd.hpp>

#include <functional>
#include <stop_token>

namespace nephroid::run {

// What a run is made of. Checkpoints, finished runs and references are bound to it.

/// The files that a preset names, each once, in its order, and what they hold now. known: of presets in the same folder; its files are not
/// read again.
std::vector<plan::Input> read_inputs(const preset::Preset& preset, const std::vector<plan::Input>& known = {});

/// "the file 'a.obj' has changed since the run began", of the first that holds something else `now`, by its name; empty where none does.
std::string changed_input(const std::vector<plan::Input>& before, const std::vector<plan::Input>& now);
/// The same since the run in the folder began, by its plan.json; empty also where that is damaged.
std::string changed_input(const std::filesystem::path& folder, const std::vector<plan::Input>& now);

/// Of the engine, its state's version, the settings that a picture's sums depend on (not: names, descriptions, stop, reference, mask) and
/// the contents of the files that they name, whatever these are called. inputs: has them all.
std::uint64_t content_hash(const preset::Preset& preset, const std::vector<plan::Input>& inputs);

/// A loaded scene with its tree: what stays the same while only the camera, the light or the engine's settings change.
struct LoadedScene {
  scene::Scene scene;
  std::shared_ptr<const scene::Bvh> bvh; ///< never null; shared by scenes with the same triangles
};

/// A preset made ready: files read, plan made, nothing on a device yet.
struct Prepared {
  preset::Preset preset;
  std::shared_ptr<const LoadedScene> loaded;
  std::shared_ptr<const plan::Plan> plan; ///< never null
};

/// Reads what the preset names and makes the plan. `previous`, if given, lends its scene where only the camera or the engine's
/// settings differ (files are not read again then), and its tree where the triangles are the same. Throws bad_input as the loaders do, and
/// interrupted where `watch` asks for it.
Prepared prepare(const preset::Preset& preset, const Prepared* previous = nullptr, const Watch& watch = {});

/// Throws failed where the device or this machine has not enough memory for the run. make_job asks this first.
void require_memory(const Prepared& prepared, const compute::Context& context);

/// What the program itself needs at most to make a picture of width x height pixels, measure it and write its files.
plan::PlannedBuffer picture_and_files(const plan::Plan& plan, int width, int height);

/// What the system says can be allocated without swapping, in bytes; empty where it does not say.
std::optional<std::uint64_t> available_memory_bytes();

/// Throws failed, saying what is needed and what there is, where the plan's buffers exceed the device's memory, one of them the
/// device's largest buffer, or what this machine has to hold (for a cpu device its buffers too) exceeds `available` bytes. width, height:
/// of the picture, for the message.
void require_memory(const plan::Plan& plan, int width, int height, const compute::DeviceInfo& device,
                    std::optional<std::uint64_t> available);

/// Builds the engine's job on a device. Its preset's white is a number. Throws as require_memory, before anything is allocated, BuildError
/// for a kernel that does not compile, and bad_input for what the engine cannot render.
std::unique_ptr<job::Job> make_job(const Prepared& prepared, const mpi::RankContext& context);

/// The white that shows a picture, which was made with a white of 1, well: half of it, but for its caustics, is darker than .5. A pixel
/// counts by the root of its luminance. Caustics count where all else is less than an eighth as bright. Two digits; 1 of a black picture.
double white_for(const job::Picture& picture);

/// The same of the preset's first whole picture, at most 256 pixels wide and high, whatever the preset's white is: what stands for "auto".
/// 1 where white changes nothing of the engine's pictures. Throws as prepare and make_job do, and interrupted where `watch` asks for it.
double fitted_white(const Prepared& prepared, const compute::Context& context, const Watch& watch = {});

/// The white of the run in the folder, by its preset.json; nothing where that is missing or damaged, or says "auto".
std::optional<double> white_of_run(const std::filesystem::path& folder);

/// What a folder may hold that is to be written into.
struct FolderContent {
  std::string whose = "a run";                                ///< for messages
  std::vector<std::string> files{"plan.json", "preset.json"}; ///< that each of those has
};

/// A folder that this process writes into, as long as this lives. One that was made for it and is still empty then is removed.
class ClaimedFolder {
public:
  /// Makes the folder if it is missing and shows that it can be written to, before anything is rendered. alone: else other processes may
  /// claim it so, too. Throws bad_input where it is a file, holds anything else, or is another process'; failed where it cannot be written
  /// to. On NFS only processes of the same node are seen.
  explicit ClaimedFolder(const std::filesystem::path& folder, bool alone = true, const FolderContent& content = {});
  ClaimedFolder(const ClaimedFolder&) = delete;
  ClaimedFolder& operator=(const ClaimedFolder&) = delete;

private:
  void claim(bool alone, const FolderContent& content);

  FileLock lock_;
  struct Made {
    std::filesystem::path path;
    bool is_new = false;
    ~Made(); ///< removes a new folder if it is empty
  } folder_;
};

/// A new run in a claimed folder: removes an older run's results and writes preset.json and plan.json. This and all writing below
/// throws failed with the system's reason.
void begin_run(const std::filesystem::path& folder, const Prepared& prepared);
/// Names of the pictures, curves and further files in the folder that are the engine's, by run.json; none where that is missing or damaged.
std::vector<std::string> engine_files(const std::filesystem::path& folder);
/// preset.json and plan.json alone: what begin_run and write_run write, and a resumed run whose stop differs.
void write_settings(const std::filesystem::path& folder, const Prepared& prepared);
struct FinishedRun {
  job::Progress progress; ///< its units are `words`
  std::shared_ptr<const std::vector<std::string>> words;
  std::string changed; ///< changed_input() of its files since: then it is no longer the preset's
};
/// The run in the folder, if it is the finished run of exactly this preset; else nothing, also where run.json is damaged. known: as
/// read_inputs takes it.
std::optional<FinishedRun> finished_run(const std::filesystem::path& folder, const preset::Preset& preset,
                                        const std::vector<plan::Input>& known = {});

/// Writes image.exr, image.png, history.csv (where the snapshot has a history), preset.json, plan.json and run.json into folder (made if
/// missing), each whole; no image where the snapshot's stands in for one. reference: what the run was measured against, or null.
void write_run(const std::filesystem::path& folder, const Prepared& prepared, const compute::DeviceInfo& device,
               const job::Snapshot& snapshot, const measure::Reference* reference, bool finished);
// A job's picture as files hold it: the last one, and those at chosen times of work, at-0010s.png and .exr, with pictures.json, which says
// what error each has.

/// Channels R, G, B (the sum), then NAME.R, NAME.G, NAME.B of each layer; no attributes yet.
image::Image with_layers(const job::Picture& picture);

/// STEM.exr with its layers, and as attributes the preset, its seed, the device and the program's version; and STEM.png as shown.
void write_picture(const std::filesystem::path& stem, const preset::Preset& preset, const compute::DeviceInfo& device,
                   const job::Picture& picture);

inline constexpr const char* pictures_file = "pictures.json";

/// Errors by the names of a history's columns; what is undefined is null.
nlohmann::ordered_json by_column(const std::vector<std::string>& columns, const std::vector<double>& values);

/// The list in the folder's pictures.json, of {"seconds": as asked for, "work_seconds": when it was made, "picture": its file,
/// "errors": by column}; empty where there is none.
nlohmann::ordered_json pictures_at(const std::filesystem::path& folder);

/// Writes both pictures and adds them to the list. Returns what it added. The errors are those of the newest row of the history where
/// that is of `seconds` or later. Throws failed as write_run does.
nlohmann::ordered_json write_picture_at(const std::filesystem::path& folder, double seconds, const Prepared& prepared,
                                        const compute::DeviceInfo& device, const job::Snapshot& snapshot);

/// Removes those of later than work_seconds: of work that a resumed run does again, or all (-1).
void remove_pictures_after(const std::filesystem::path& folder, double work_seconds);

/// report.html of a run whose other files are written. Throws as report::report_html does.
void write_report(const std::filesystem::path& folder);
/// history.csv alone, while the run goes on.
void write_history(const std::filesystem::path& folder, const job::History& history);

/// checkpoint.bin in folder: written whole; bound to the engine and its state's version, to the settings and file contents that its sums
/// depend on, and to the device, the kernels and the program's version, each of which may round in its own way.
void write_checkpoint(const std::filesystem::path& folder, const Prepared& prepared, const compute::Context& context, job::Job& job);
/// What another process has to have alike so that it computes the same bits, each with a name for a message.
std::vector<std::pair<std::string, std::string>> bit_dependencies(const Prepared& prepared, const compute::Context& context);
/// Loads it into a job that was just made. False where there is none. Throws bad_input where it is bound to something else, which it
/// names, or is cut.
bool load_checkpoint(const std::filesystem::path& folder, const Prepared& prepared, const compute::Context& context, job::Job& job);

/// Null where the preset has none, and where it is a recipe that is not in the cache or damaged there. Reads the mask of preset.measure
/// too. Throws bad_input where a file cannot be read or has another size than the run's picture.
std::shared_ptr<const measure::Reference> find_reference(const Prepared& prepared, const compute::Context& context);

/// How making one goes on: 0..1, and the seconds of work so far.
using ReferenceProgress = std::function<void(double fraction, double seconds)>;

/// Renders the recipe with both of its seeds and puts their mean into the cache. Throws failed where it cannot be made: memory, a time
/// above reference.seconds (known after the first passes), a cache that cannot be written to; interrupted where `stop` asks for it.
/// Only for presets whose reference is a recipe.
std::shared_ptr<const measure::Reference> make_reference(const Prepared& prepared, const compute::Context& context,
                                                         const std::stop_token& stop, const ReferenceProgress& progress);

// An animation in its folder: frame_0003.png and frame_0003.exr of each frame, the run that made it in frames/0003, figures of all frames
// in frames.csv, the video animation.mp4.

/// frames/0003 in the animation's folder: the folder of the frame's own run.
std::filesystem::path frame_folder(const std::filesystem::path& folder, int frame);
/// frame_0003.png in the animation's folder; beside it lies frame_0003.exr.
std::filesystem::path frame_picture(const std::filesystem::path& folder, int frame);

/// Puts the pictures of the frame's run beside those of the other frames: as links, which take no room, or as copies where the file system
/// has no links. Throws failed with the system's reason.
void show_frame(const std::filesystem::path& folder, int frame);
/// Takes them away again, and animation.mp4 with them: before the frame is rendered another time.
void hide_frame(const std::filesystem::path& folder, int frame);

/// The frame's run, if it is the finished run of exactly this preset and its pictures can be read.
std::optional<FinishedRun> finished_frame(const std::filesystem::path& folder, int frame, const preset::Preset& preset);
/// The frames of the preset's animation whose runs are finished and of the files as they are, in order.
std::vector<int> finished_frames(const std::filesystem::path& folder, const preset::Preset& preset);

/// Removes frames from `first` on, each with its run, and then frames.csv and animation.mp4, which were of them too.
void remove_frames(const std::filesystem::path& folder, int first);

/// frames.csv: "frame,step,work,work_seconds,error", a row for each of these frames; the error is that of run.json's error_column, and
/// empty where nothing measured it. Throws failed as all writing does, and bad_input where a run.json is damaged.
void write_frame_figures(const std::filesystem::path& folder, const std::vector<int>& frames);

/// Makes animation.mp4 (H.264, 4:2:0, edge lengths made even) of frame_0000.png to the last of so many frames in the folder, by the program
/// ffmpeg. Returns nothing where it is written, else why it is not: there is no ffmpeg on the PATH, or what ffmpeg says.
std::optional<std::string> make_video(const std::filesystem::path& folder, int frames, double fps);

} // namespace nephroid::run
