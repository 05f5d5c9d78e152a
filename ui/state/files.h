// SPDX-License-Identifier: Apache-2.0
// Which files a person may open, drop and save, and the reading and writing that takes too long for a frame.
#pragma once
#include "job/job.h"
#include "preset/preset.h"
#include "ui/state/commands.h"
#include "ui/state/difference.h"
#include "ui/state/messages.h"
#include "ui/state/pinned_runs.h"

#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::ui {

/// What a file is by the ending of its name.
enum class FileKind {
  other,      ///< a preset, perhaps
  dispersion, ///< YAML of refractiveindex.info
  scene,      ///< glTF: a whole scene, which becomes a preset
  mesh,
  map,     ///< a picture of surroundings, which has a range that no screen has
  picture, ///< as screens show it
  kernel
};
FileKind kind_of(const std::filesystem::path& file);

/// Throws bad_input in one line where `name` is a file of a kind that is no preset: a mesh, dispersion data, a picture, a kernel,
/// anything that does not begin as a JSON object. Presets, broken ones too, and names of no file pass: reading them says the rest.
void refuse_other_kinds(const std::string& name);
/// Where "save" writes without asking: the file that was opened, unless it is one of the shipped presets. Empty: ask. preset may be null.
std::filesystem::path save_target(const preset::Preset* preset);
/// What a saved preset may be written over, as preset::file_text takes it: the parent that its file names, or the shipped preset that it
/// is. Empty: it has none.
std::string parent_to_keep(const preset::Preset& preset);
/// A proposal for a file's name in the current folder: the preset's own with another ending.
std::string proposed_name(const preset::Preset* preset, const std::string& ending);

/// The path, or where something is there already, may be edited since, the first of PATH-2, PATH-3, ... where nothing is.
std::filesystem::path free_name(const std::filesystem::path& path);

/// The View's picture, for a file.
struct PictureToSave {
  HeldPicture picture;
  std::shared_ptr<const ShownDifference> map; ///< in place of the picture; null: none
  Look look;
  double white = 1;    ///< preset::Preset::white
  std::string why_not; ///< there is none: a sentence without a full stop
};

/// Files that are read and written away from the window's thread.
class FileWork {
public:
  /// By the extension of file: .png as shown, .exr the run's picture, linear with every layer.
  void save_picture(const std::filesystem::path& file, std::shared_ptr<const job::Picture> picture, PictureToSave shown);
  /// write_thumbnail(), of which nothing is said unless it fails.
  void save_thumbnail(const std::filesystem::path& file, std::shared_ptr<const job::Picture> picture, double exposure_stops);
  /// The files of a run, into a new folder, the free_name() of this one. open: the file to be opened then.
  void save_files(const std::filesystem::path& folder, std::shared_ptr<const job::Snapshot> of, const std::string& open);
  /// write_report() of run_report.h.
  void save_report(const std::filesystem::path& file, std::vector<PinnedRun> runs);
  /// Makes a preset of a glTF file, in a folder of its own beside it, and then opens that.
  void import_scene(const std::filesystem::path& file);
  /// read_pin() of a path; as `like` in name, colour and whether it is shown, where that is given.
  void pin(const std::filesystem::path& path, const std::optional<PinnedRun>& like = {});
  bool busy() const { return !background_.empty() || !pins_.empty(); }
  /// Until all of it is done.
  void wait() const;
  /// Once a frame: says what is done, and hands over the files to be opened and the runs that were read, in the order of pin().
  void collect(Messages& messages, const std::function<void(PinnedRun)>& take_pin,
               const std::function<void(const std::filesystem::path&)>& open);

private:
  struct Done {
    std::string note;                   ///< empty where there is nothing to say
    std::optional<PinnedRun> pin = {};  ///< that was read
    std::filesystem::path to_open = {}; ///< empty: nothing
  };
  std::vector<std::future<Done>> background_, pins_; ///< what is thrown there becomes a message
};

} // namespace nephroid::ui
