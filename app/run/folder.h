// SPDX-License-Identifier: Apache-2.0
// The folder of a run, before and while it runs.
#pragma once
#include "base/files.h"
#include "job/job.h"
#include "run/prepare.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::run {

/// What a folder may hold that is to be written into.
struct FolderContent {
  std::string whose = "a run";                                ///< for messages
  std::vector<std::string> files{"plan.json", "preset.json"}; ///< that each of those has
};

/// A folder that this process writes into, as long as this lives. A new one that is still empty then is removed.
class ClaimedFolder {
public:
  /// Makes the folder if it is missing and shows that it can be written to, before anything is rendered. alone: else
  /// other processes may claim it so, too. Throws bad_input where it is a file, holds anything else, or is another
  /// process'; failed where it cannot be written to. On NFS only processes of the same node are seen.
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

/// Removes an older run's results and writes preset.json and plan.json. Writing throws failed with the system's reason.
void begin_run(const std::filesystem::path& folder, const Prepared& prepared);
/// The engine's files in the folder, by run.json; none where that is missing or damaged.
std::vector<std::string> engine_files(const std::filesystem::path& folder);
/// preset.json and plan.json alone.
void write_settings(const std::filesystem::path& folder, const Prepared& prepared);
struct FinishedRun {
  job::Progress progress; ///< its units are `words`
  std::shared_ptr<const std::vector<std::string>> words;
  std::string changed;             ///< changed_input() of its files since: then it is no longer the preset's
  bool is_shown_otherwise = false; ///< its preset has another `display`: show_anew() (write_run.h) is to follow
};
/// The run in the folder, if it is the finished run of exactly this preset but for its `display`; else nothing, also
/// where run.json is damaged. known: as read_inputs takes it.
std::optional<FinishedRun> finished_run(const std::filesystem::path& folder, const preset::Preset& preset,
                                        const std::vector<plan::Input>& known = {});

/// The white of the run in the folder, by its preset.json; nothing where that is missing or damaged, or says "auto".
std::optional<double> white_of_run(const std::filesystem::path& folder);

} // namespace nephroid::run
