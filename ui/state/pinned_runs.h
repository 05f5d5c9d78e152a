// SPDX-License-Identifier: Apache-2.0
// Pinned runs, which others are compared with: their history and, where there is one, their picture. An opened picture,
// of whatever program, is pinned too. All stay whatever becomes of the run in hand; the session brings them back after
// the window was closed.
#pragma once
#include "job/job.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace nephroid::ui {

struct RunRecord;

struct PinnedRun {
  std::uint64_t id = 0; ///< from 1
  std::string name;
  std::uint32_t colour = 0;                    ///< IM_COL32
  bool shown = true;                           ///< in the plot
  std::shared_ptr<const job::History> history; ///< never null
  std::shared_ptr<const job::Picture> picture; ///< null where only a table was read
  std::shared_ptr<const RunRecord> record =
      {};                          ///< what else is known of it (run_record.h); null where only a table was read
  std::filesystem::path file = {}; ///< of a picture that was opened, absolute: it has no history; empty: a run
  std::string read_as = {};        ///< how its values were read: "floats, linear"

  bool is_run() const { return file.empty(); }
};

class PinnedRuns {
public:
  const std::vector<PinnedRun>& all() const { return runs_; }
  /// All but the opened pictures.
  std::vector<PinnedRun> runs() const;
  /// Null where there is none of this id.
  const PinnedRun* find(std::uint64_t id) const;
  /// Gives it an id, where it has no colour one that no other has while there are such, and a name of its own ("glass",
  /// "glass (2)").
  const PinnedRun& add(PinnedRun run);
  /// An empty name leaves the name. Nothing where there is no such run, here and below.
  void change(std::uint64_t id, std::string name, std::uint32_t colour, bool shown);
  void remove(std::uint64_t id);

private:
  /// The wanted name, with a number where another run than this has it.
  std::string own_name(const std::string& wanted, std::uint64_t id) const;
  std::uint32_t free_colour() const;

  std::vector<PinnedRun> runs_;
  std::uint64_t last_id_ = 0;
};

/// Whether this names something that read_pin reads: a table (.csv), or a folder with a history.csv in it.
bool is_history(const std::filesystem::path& path);
/// Whether this names a picture, by its ending.
bool is_picture(const std::filesystem::path& path);
/// A picture, named after its file; or an earlier run by its history.csv or its folder; named after the folder. Its
/// image.exr and, for the noise floor, its run.json are read where they lie beside. Throws bad_input as
/// measure::read_history, measure::read_run_history and open_picture do, and for what is neither.
PinnedRun read_pin(const std::filesystem::path& path);

} // namespace nephroid::ui
