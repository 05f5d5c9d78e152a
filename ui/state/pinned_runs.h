// SPDX-License-Identifier: Apache-2.0
// Pinned runs, for comparison: their history and, where there is one, their picture. An opened picture, of any program,
// is pinned too. Pins do not depend on the run in hand; the session restores them after the window was closed.
#pragma once
#include "job/job.h"

namespace nephroid::ui {

struct RunRecord;

struct PinnedRun {
  std::uint64_t id = 0; ///< from 1
  std::string name;
  std::uint32_t colour = 0;                     ///< IM_COL32
  bool shown = true;                            ///< the plot shows it
  std::shared_ptr<const job::History> history;  ///< never null
  std::shared_ptr<const job::Picture> picture;  ///< null where only a table was read
  std::shared_ptr<const RunRecord> record = {}; ///< further facts (run_record.h); null where only a table was read
  std::filesystem::path file = {}; ///< an opened picture's absolute path (it has no history); empty for a run
  std::string read_as = {};        ///< how the values were read: "floats, linear"

  bool is_run() const { return file.empty(); }
};

class PinnedRuns {
public:
  const std::vector<PinnedRun>& all() const { return runs_; }
  /// The pins without the opened pictures.
  std::vector<PinnedRun> runs() const;
  /// The pin with this id; null where there is none.
  const PinnedRun* find(std::uint64_t id) const;
  /// Gives the run an id, a colour where it has none (an unused one while there are any) and a unique name ("glass",
  /// "glass (2)").
  const PinnedRun& add(PinnedRun run);
  /// An empty name keeps the name. Unknown ids are ignored, here and below.
  void change(std::uint64_t id, std::string name, std::uint32_t colour, bool shown);
  void remove(std::uint64_t id);

private:
  std::string own_name(const std::string& wanted, std::uint64_t id) const;
  std::uint32_t free_colour() const;

  std::vector<PinnedRun> runs_;
  std::uint64_t last_id_ = 0;
};

/// Whether read_pin can read the path as a history: a table (.csv), or a folder with a history.csv in it.
bool is_history(const std::filesystem::path& path);
/// The preset of a run's folder; empty where it has none.
std::string preset_of_run(const std::filesystem::path& folder);
/// Whether the path is a picture's, by its extension.
bool is_picture(const std::filesystem::path& path);
/// Reads a picture, named after its file; or an earlier run by its history.csv or its folder, named after the folder.
/// The image.exr beside it is read too, and the run.json for the noise floor. Throws bad_input as
/// measure::read_history, measure::read_run_history and open_picture do, and for any other kind of file.
PinnedRun read_pin(const std::filesystem::path& path);

} // namespace nephroid::ui
