// SPDX-License-Identifier: Apache-2.0
#include "run/recorder.h"

#include "run/afterimage.h"
#include "run/checkpoint.h"
#include "run/exposure.h"
#include "run/write_run.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <set>
#include <utility>

namespace nephroid::run {

/// A resumed run keeps the pictures that it made before. Others whose time is past it can no longer make.
void Recorder::begun(job::Job& job) {
  saved_at_ = job.progress().work_seconds;
  const std::vector<double>& times = options_.pictures_at;
  std::set<double> written;
  for (const auto& picture : pictures_at(options_.folder)) written.insert(picture["seconds"].get<double>());
  for (; next_picture_ < times.size() && times[next_picture_] <= saved_at_; ++next_picture_)
    if (saved_at_ > 0 && !written.contains(times[next_picture_]))
      note(fmt::format("{} s of work are past: no picture of then", times[next_picture_]));
}

void Recorder::advanced(job::Job& job) {
  write_new_history(job);
  const double work_seconds = job.progress().work_seconds;
  if (!write_due_pictures(job) || work_seconds - saved_at_ < options_.checkpoint_seconds) return;
  saved_at_ = work_seconds;
  try_to([&] { write_checkpoint(options_.folder, *run_.prepared, run_.device.opened(), job); });
}

void Recorder::ended(job::Job& job) {
  last_ = job.snapshot();
  is_finished_ = job.finished() && !last_.stands_in;
  if (run_.seen && is_finished_) write_for_next_frame();
  if (last_.picture && is_finished_ && !options_.is_frame)
    if (std::string note = exposure_note(*last_.picture, run_.prepared->preset); !note.empty())
      last_.warnings.push_back(std::move(note));
  write_run(options_.folder, *run_.prepared, run_.device.opened().device(), last_, run_.reference.get(), is_finished_);
  last_.picture.reset(); // the report reads the files
  last_.left.clear();
  if (options_.is_frame && is_finished_) {
    std::filesystem::remove(options_.folder / "checkpoint.bin");
    return;
  }
  write_checkpoint(options_.folder, *run_.prepared, run_.device.opened(), job);
  if (is_finished_ && last_.history) write_last_report();
}

template <class Write>
void Recorder::try_to(Write write) {
  try {
    write();
  } catch (const Error& error) {
    if (!std::exchange(has_warned_, true)) warn(error.line() + "; going on without checkpoints");
  }
}

void Recorder::write_new_history(const job::Job& job) {
  const auto history = job.history();
  if (!history || history->rows.size() == rows_written_) return;
  rows_written_ = history->rows.size();
  try_to([&] { write_history(options_.folder, *history); });
}

/// The pictures whose time has come, once their error is measured. False where that is the next step: a checkpoint in
/// between would be of a run that never takes them.
bool Recorder::write_due_pictures(job::Job& job) {
  const std::vector<double>& times = options_.pictures_at;
  const double work_seconds = job.progress().work_seconds;
  for (; next_picture_ < times.size() && times[next_picture_] <= work_seconds; ++next_picture_) {
    const double seconds = times[next_picture_];
    const auto history = job.history();
    if (history && !history->rows.empty() && history->rows.back().seconds < seconds) return false;
    try_to([&] {
      const job::Snapshot snapshot = job.snapshot();
      if (snapshot.stands_in) return note(fmt::format("no picture at {} s: the first one is not there yet", seconds));
      picture_written(
          write_picture_at(options_.folder, seconds, *run_.prepared, run_.device.opened().device(), snapshot),
          history ? history->error_column : "");
    });
  }
  return true;
}

void Recorder::write_for_next_frame() {
  try {
    write_afterimage(options_.folder, *run_.prepared, *run_.seen, last_.left);
  } catch (const Error& error) {
    warn("the next frame begins by itself: " + error.line());
  }
}

/// Where a report cannot be made there is one file less.
void Recorder::write_last_report() {
  try {
    write_report(options_.folder);
  } catch (const Error& error) {
    warn("there is no report.html: " + error.line());
  }
}

} // namespace nephroid::run
