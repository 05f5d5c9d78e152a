// SPDX-License-Identifier: Apache-2.0
// The state behind the window: the preset with its history, the run it started, the newest snapshot, the runs that were pinned, the
// messages. Knows nothing of Dear ImGui. Panels read it; commands change it; update() runs once a frame and never waits for a device or a
// disk.
#pragma once
#include "base/error.h"
#include "job/worker.h"
#include "preset/preset.h"
#include "preset/read.h"
#include "ui/state/commands.h"
#include "ui/state/difference.h"
#include "ui/state/pinned_runs.h"
#include "ui/state/run_source.h"
#include "ui/state/undo.h"

#include <chrono>
#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::ui {

struct Message {
  std::uint64_t id = 0;
  bool error = true;
  std::string line;
  std::chrono::steady_clock::time_point since;
  ErrorKind kind = ErrorKind::failed; ///< of an error
};

class Workbench {
public:
  using Clock = std::chrono::steady_clock;

  /// source outlives the workbench.
  explicit Workbench(RunSource& source) : source_(source) {}

  /// Carries out commands in their order. Whatever goes wrong becomes a message; nothing is thrown.
  void apply(const Commands& commands);
  /// Opens a preset with overrides (--set). False, with a message, where it cannot be read.
  bool open(const std::string& name, const preset::Overrides& overrides = {});
  /// One more line for notes(), from the program itself.
  void add_note(std::string line) { program_notes_.push_back(std::move(line)); }
  /// Once a frame: takes the newest snapshot, starts the run that edits ask for, collects what finished in the background.
  void update(Clock::time_point now = Clock::now());

  /// Null before a preset is opened.
  const preset::Preset* preset() const { return history_ ? &history_->current() : nullptr; }
  const UndoStack* history() const { return history_ ? &*history_ : nullptr; }
  /// The newest picture there is, also of an earlier run until the present one has shown its first; null before the first of all.
  const std::shared_ptr<const job::Snapshot>& snapshot() const { return snapshot_; }
  /// Whether snapshot() is of the preset as it is now.
  bool snapshot_is_current() const { return snapshot_is_current_; }
  const job::Status& status() const { return status_; }
  /// Whether kernels are being compiled for the run in hand.
  bool compiling() const { return source_.compiling(); }
  /// What the run's error was so far, of snapshot(); null where nothing is measured.
  std::shared_ptr<const job::History> error_history() const { return snapshot_ ? snapshot_->history : nullptr; }
  /// Of the newest run that was made ready; null before the first of a preset. Another plan is another object.
  const std::shared_ptr<const plan::Plan>& plan() const { return plan_; }
  /// Of that run; null as above, and where the run's source did not look.
  const std::shared_ptr<const SeenByGlass>& seen_by_glass() const { return seen_; }
  /// What was chosen to be plotted; empty: the run's own. Not every run has it.
  const std::string& error_metric() const { return error_metric_; }
  /// The dielectric that was chosen to be shown; empty or none of the preset's: the first (shown_dielectric).
  const std::string& material() const { return material_; }
  const PinnedRuns& pinned() const { return pinned_; }
  /// Whether a file is being read or written in the background: its pin or its message is to come.
  bool works_on_files() const { return !background_.empty(); }
  const Comparison& comparison() const { return comparison_; }
  /// The reference, or the pinned run that comparison() names; its owner is null where why_not_comparable() is not empty.
  HeldPicture other_picture() const;
  /// Why the run's picture and the other one cannot be held against each other: a sentence without a full stop; else empty.
  std::string why_not_comparable() const;
  /// The newest map of differences that comparison() asked for; may be of an earlier snapshot. Null before the first.
  const std::shared_ptr<const ShownDifference>& difference() const { return difference_.newest(); }
  const std::vector<Message>& messages() const { return messages_; }
  const Look& look() const { return look_; }
  /// What is worth knowing and needs no answer: the program's notes, then those of the newest plan.
  std::vector<std::string> notes() const;
  Question question() const { return question_; }
  /// With Question::unsaved: what waits for the answer, an Open or a Quit that asks no more. Else null.
  const Command* waiting() const { return waiting_ ? &*waiting_ : nullptr; }
  bool help_shown() const { return help_shown_; }
  bool quitting() const { return quitting_; }
  /// True once after ResetLayout.
  bool take_layout_reset() { return std::exchange(layout_reset_, false); }
  /// Where "save" writes without asking: the file that was opened, unless it is one of the shipped presets. Empty: ask.
  std::filesystem::path save_target() const;
  /// A proposal for a dialog's file name, in the current folder.
  std::string proposed_name(Question question) const;

private:
  void carry_out(const command::Open& c);
  void carry_out(const command::Edit& c);
  void carry_out(const command::EndGesture&);
  void carry_out(const command::Undo&);
  void carry_out(const command::Redo&);
  void carry_out(const command::Restart&);
  void carry_out(const command::Cancel&);
  void carry_out(const command::Pause& c);
  void carry_out(const command::SetLook& c);
  void carry_out(const command::Flip& c);
  void carry_out(const command::CompareWith& c);
  void carry_out(const command::ShowDifference& c);
  void carry_out(const command::PinRun&);
  void carry_out(const command::PinFile& c);
  void carry_out(const command::ChangePin& c);
  void carry_out(const command::Unpin& c);
  void carry_out(const command::ChooseMetric& c);
  void carry_out(const command::ChooseMaterial& c);
  void carry_out(const command::LoadDispersion& c);
  void carry_out(const command::Ask& c);
  void carry_out(const command::SavePreset& c);
  void carry_out(const command::SavePicture& c);
  void carry_out(const command::Dismiss& c);
  void carry_out(const command::ShowHelp& c);
  void carry_out(const command::ResetLayout&);
  void carry_out(const command::Report& c);
  void carry_out(const command::Quit& c);

  bool unsaved() const { return history_ && history_->modified(); }
  void ask_first(Command command);
  void say(bool error, std::string line, ErrorKind kind = ErrorKind::failed);
  void say(const std::exception& error);
  void start();
  void adopt_or_start();
  std::function<std::unique_ptr<job::Job>()> maker() const;
  void take_snapshot();
  void take_arrival();
  void make_difference(Clock::time_point now);
  void collect_messages(Clock::time_point now);
  void collect_background();

  /// What comes back from a thread that reads or writes files.
  struct Finished {
    Message message; ///< none where its line is empty
    std::optional<PinnedRun> pin;
  };
  struct Arrival;

  RunSource& source_;
  std::optional<UndoStack> history_;
  Look look_;
  Question question_ = Question::none;
  std::optional<Command> waiting_;
  bool help_shown_ = false, quitting_ = false, layout_reset_ = false;

  bool restart_wanted_ = false;    ///< the preset changed since the last start
  bool kernels_changed_ = false;   ///< ... or the kernels
  bool gesture_lasts_ = false;     ///< ... by a gesture that goes on
  bool shown_since_start_ = false; ///< a snapshot of the run in hand has come
  bool snapshot_is_current_ = false;
  std::uint64_t reported_failure_ = 0;               ///< Status::failures when the newest one became a message
  std::uint64_t failure_message_ = 0;                ///< its message's id
  std::shared_ptr<const preset::Preset> run_preset_; ///< of the run in hand
  std::uint64_t adoption_ = 0;                       ///< of it by the run in hand: Snapshot::adoption of a picture of it is not less
  job::Status status_;
  std::shared_ptr<const job::Snapshot> snapshot_, before_start_;

  std::vector<std::string> program_notes_;
  std::shared_ptr<Arrival> arrival_; ///< where the run in hand leaves its plan and its reference
  std::shared_ptr<const plan::Plan> plan_;
  std::shared_ptr<const measure::Reference> reference_;
  std::shared_ptr<const SeenByGlass> seen_;
  std::string run_name_, snapshot_name_; ///< of the run in hand, and of the one that snapshot_ is of
  std::string error_metric_, material_;
  PinnedRuns pinned_;
  Comparison comparison_;
  DifferenceMaker difference_;

  std::uint64_t last_message_ = 0;
  std::uint64_t last_before_commands_ = 0; ///< newer messages are about the commands that are being carried out
  std::vector<Message> messages_;
  std::vector<std::future<Finished>> background_; ///< files being read and written
  job::Worker worker_;                            ///< last: its thread uses the source
};

} // namespace nephroid::ui
