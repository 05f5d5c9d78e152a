// SPDX-License-Identifier: Apache-2.0
// Keeps a run's folder up to date while the run is driven, and writes what it came to.
#pragma once
#include "job/observer.h"
#include "run/ready.h"

#include <nlohmann/json_fwd.hpp>

#include <vector>

namespace nephroid::run {

struct RecorderOptions {
  std::filesystem::path folder;         ///< that of the run (ReadyOptions::folder)
  double checkpoint_seconds = 10;       ///< work from one checkpoint to the next
  std::vector<double> pictures_at = {}; ///< seconds of work, in order, each once
  bool is_frame = false; ///< finished, it has no checkpoint and no report: those of all frames would fill the disk
};

/// While the run goes on: history.csv, pictures at times, a checkpoint now and then. Where these cannot be written the
/// run goes on: the disk may have room when it ends. At the end: the picture, then a checkpoint, then a report of a
/// finished run that was measured; throws as write_run and write_checkpoint do.
class Recorder : public job::Observer {
public:
  /// run: is ready, has a folder, and outlives this.
  Recorder(const ReadyRun& run, RecorderOptions options) : run_(run), options_(std::move(options)) {}

  void begun(job::Job& job) override;
  void advanced(job::Job& job) override;
  void ended(job::Job& job) override;

  /// The last snapshot, without its picture, once the run has ended.
  const job::Snapshot& last() const { return last_; }
  /// Whether it ended where its preset says, with a picture.
  bool is_finished() const { return is_finished_; }

protected:
  /// What somebody who waits for the run may want to know, a sentence each.
  virtual void note(const std::string&) {}
  /// The same of what could not be written.
  virtual void warn(const std::string&) {}
  /// entry: of pictures.json. error_column: of the error that counts, in its "errors"; empty where nothing is measured.
  virtual void picture_written(const nlohmann::ordered_json& /*entry*/, const std::string& /*error_column*/) {}

private:
  template <class Write>
  void try_to(Write write);
  void write_new_history(const job::Job& job);
  bool write_due_pictures(job::Job& job);
  void write_last_report();
  void write_for_next_frame();

  const ReadyRun& run_;
  RecorderOptions options_;
  double saved_at_ = 0;          ///< seconds of work at the newest checkpoint
  std::size_t rows_written_ = 0; ///< the history's
  std::size_t next_picture_ = 0; ///< index in RecorderOptions::pictures_at
  bool has_warned_ = false, is_finished_ = false;
  job::Snapshot last_;
};

} // namespace nephroid::run
