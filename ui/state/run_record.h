// SPDX-License-Identifier: Apache-2.0
// What is known of a run beyond its history and its picture: its inputs and its progress. A run of this window, or one
// read from a folder, can be written to a folder again, as `nephroid run` writes one. A report over such runs is
// written as by `nephroid report`.
#pragma once
#include "job/job.h"
#include "ui/state/comparing.h"

namespace nephroid::ui {

struct RunRecord {
  std::string engine;                           ///< empty: unknown
  std::string steps_name;                       ///< "passes"
  std::optional<std::int64_t> steps;            ///< completed
  std::optional<double> work_seconds;           ///< without start-up and measuring
  bool finished = false;                        ///< it ended by its own stop criterion
  std::shared_ptr<const preset::Preset> preset; ///< null where unknown
  /// The inputs of a run of this window, and its snapshot without the picture, which the PinnedRun has, and without
  /// files such as meshes.
  std::optional<RunOrigin> origin;
  std::shared_ptr<const job::Snapshot> snapshot;
  /// The folder of a run that was read, and its run.json, plan.json and preset.json as they were, by name.
  std::filesystem::path folder;
  std::map<std::string, std::string> texts;
};

/// The run in hand as it is now, under the name for pins; its history is never null. There must be a snapshot.
PinnedRun run_now(const RunInHand& run);
/// The same for display only: without what is needed to write its folder.
PinnedRun look_at_run(const RunInHand& run);
/// The runs of a report: the pinned ones (no opened pictures), then the run in hand, where its picture is not among
/// theirs.
std::vector<PinnedRun> runs_of_table(const Comparing& comparing, const RunInHand& run);
/// Reads a run's folder: whatever run.json and preset.json give. Null where there is no run.json.
std::shared_ptr<const RunRecord> read_record(const std::filesystem::path& folder);

struct KnownError {
  double value = 0;
  std::string metric; ///< "lab_mean"
  bool is_estimate = false;
};
/// The newest value of the metric that judges the run; where a table does not say which, that of lab_mean, against a
/// reference rather than estimated. Nothing where there is none, or where it is not a number.
std::optional<KnownError> known_error(const job::History& history);

/// Why a run's folder cannot be written so that a report takes it: a part of a sentence ("it is not finished"); else
/// empty.
std::string why_no_folder(const PinnedRun& run);
/// Writes what is known of a run as its folder, which is made where missing; a report takes it where why_no_folder is
/// empty. name: the run's name in its files; empty: unchanged. further: also writes the pictures beside the shown one.
/// Throws as run::write_run.
void write_run_folder(const std::filesystem::path& folder, const PinnedRun& run, const std::string& name, bool further);

/// Writes the page over the runs, in their order. A run that was read from a folder is taken from there where that is
/// still the same. The others go to numbered folders in a new folder FILE-runs beside the page, which stays, so that
/// `nephroid report` can use it again. Returns what was written, and which runs are left out and why. Throws bad_input
/// at `file` where its name does not end in .html or no run is left, and as report::report_html and run::write_run; the
/// folders are removed again then. Takes as long as the disk does.
std::string write_report(const std::filesystem::path& file, std::span<const PinnedRun> runs);

} // namespace nephroid::ui
