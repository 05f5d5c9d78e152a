// SPDX-License-Identifier: Apache-2.0
// What is known of a run beyond its history and its picture: what it was made of and how far it came. A run that this
// window made, or one whose folder was read, can be written to a folder again, as `nephroid run` writes one, and a
// report over such runs, as `nephroid report`.
#pragma once
#include "job/job.h"
#include "ui/state/comparing.h"
#include "ui/state/pinned_runs.h"
#include "ui/state/run_in_hand.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace nephroid::ui {

struct RunRecord {
  std::string engine;                           ///< empty: not known
  std::string steps_name;                       ///< "passes"
  std::optional<std::int64_t> steps;            ///< completed
  std::optional<double> work_seconds;           ///< without start-up and measuring
  bool finished = false;                        ///< it came to its own stop
  std::shared_ptr<const preset::Preset> preset; ///< null where it is not known
  /// Of a run of this window; the snapshot without the picture, which the PinnedRun has, and without files such as
  /// meshes.
  std::optional<RunOrigin> origin;
  std::shared_ptr<const job::Snapshot> snapshot;
  /// Of a run that was read: its folder, and run.json, plan.json and preset.json as they were, by name.
  std::filesystem::path folder;
  std::map<std::string, std::string> texts;
};

/// The run in hand as it is now, named as it is pinned; its history is never null. It has a snapshot.
PinnedRun run_now(const RunInHand& run);
/// The same for a look: without what its folder would be written from.
PinnedRun look_at_run(const RunInHand& run);
/// What a report is over: the pinned runs (no opened pictures), then the run in hand, where it has a picture that is
/// none of theirs.
std::vector<PinnedRun> runs_of_table(const Comparing& comparing, const RunInHand& run);
/// Of a run's folder: what can be read of its run.json and preset.json. Null where it has no run.json.
std::shared_ptr<const RunRecord> read_record(const std::filesystem::path& folder);

/// A run's error where it knows one.
struct KnownError {
  double value = 0;
  std::string metric; ///< "lab_mean"
  bool is_estimate = false;
};
/// The newest value of what the run is judged by; else, where a table does not say, of lab_mean, against a reference
/// rather than estimated. Nothing where there is none, or where it is no number.
std::optional<KnownError> known_error(const job::History& history);

/// Why a run's folder cannot be written so that a report takes it: a part of a sentence ("it is not finished"); else
/// empty.
std::string why_no_folder(const PinnedRun& run);
/// What there is of a run as its folder, made where it is missing; a report takes it where why_no_folder is empty.
/// name: what the run is called in its files; empty: as it was. further: with the pictures beside the one that is
/// shown. Throws as run::write_run.
void write_run_folder(const std::filesystem::path& folder, const PinnedRun& run, const std::string& name, bool further);

/// Writes the page over the runs, in their order. Runs that were read from folders which are still the same are taken
/// from there; the others are written to numbered folders in a new folder FILE-runs beside the page, which stays, as
/// `nephroid report` can use it again. Says what was written, and which runs are left out and why. Throws bad_input at
/// `file` where its name does not end in .html or no run is left, and as report::report_html and run::write_run; the
/// folders are removed again then. Takes as long as the disk does.
std::string write_report(const std::filesystem::path& file, std::span<const PinnedRun> runs);

} // namespace nephroid::ui
