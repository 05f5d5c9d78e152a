// SPDX-License-Identifier: Apache-2.0
// Combines the parts behind the window. Each part owns a subject and carries out its commands. The workbench knows
// nothing of Dear ImGui. Panels read a Context of it; commands change it. update() runs once a frame and never waits
// for a device; the only file that it reads is the preset, when that has changed.
#pragma once
#include "ui/state/context.h"
#include "ui/state/file_watch.h"
#include "ui/state/file_writer.h"
#include "ui/state/film_recording.h"
#include "ui/state/playback.h"
#include "ui/state/session.h"

namespace nephroid::ui {

class Workbench {
public:
  using Clock = std::chrono::steady_clock;

  /// source outlives the workbench.
  explicit Workbench(RunSource& source)
      : run_(source, services_.messages), balls_(source), film_(document_, run_, source, services_) {}

  /// Carries out commands in their order. Errors become messages; nothing is thrown.
  void apply(const Commands& commands);
  /// Opens a preset with overrides (--set). False, with a message, where it cannot be read.
  bool open(const std::string& name, const preset::Overrides& overrides = {});
  /// Restores a session and starts its run; `folder` holds its pinned runs, which are read in the background.
  void restore(Session session, const std::filesystem::path& folder);
  /// Called once a frame: takes the newest snapshot, starts the run that edits ask for, collects finished tasks.
  void update(Clock::time_point now = Clock::now());

  /// What panels read in one frame; their commands go to `commands`.
  Context context(Commands& commands) {
    return {edits(),
            run_,
            comparing_,
            view_state_,
            setup_.settings(),
            has_earlier_session_,
            commands,
            files_.recent(),
            sweep_,
            playback_,
            film_,
            tasks(),
            balls_};
  }
  /// Both are null before a preset is opened.
  const preset::Preset* preset() const { return document_.preset(); }
  const UndoStack* edits() const { return document_.edits(); }
  const RunInHand& run() const { return run_; }
  void look_at_meters(bool on) { run_.look_at_meters(on); }
  const Comparing& comparing() const { return comparing_; }
  const SweepQueue& sweep() const { return sweep_; }
  const Playback& playback() const { return playback_; }
  const FilmRecording& film() const { return film_; }
  const ViewState& view_state() const { return view_state_; }
  const std::vector<Message>& messages() const { return services_.messages.all(); }
  const MaterialBalls& balls() const { return balls_; }
  TaskQueue& tasks() { return services_.tasks; }
  Questions& questions() { return questions_; }
  const Questions& questions() const { return questions_; }
  WindowSetup& setup() { return setup_; }
  const WindowSetup& setup() const { return setup_; }
  /// Sets where presets that are opened or saved are remembered.
  void remember(RecentFiles recent) { files_.remember(std::move(recent)); }
  void offer_earlier(bool there_is) { has_earlier_session_ = there_is; }
  void finish(const TaskKey& key) { services_.tasks.wait(key, services_.messages); }
  /// Whether a file is being read or written in the background, so that a pin or a message is to come.
  bool works_on_files() const { return files_.busy() || comparing_.reads_pins() || document_.reads_mesh(); }
  /// Called before the end: waits for files that are being written, and makes messages of those that fail.
  void finish_files() { services_.tasks.finish(services_.messages); }
  void add_note(std::string line) { program_notes_.push_back(std::move(line)); }
  /// Notes that need no answer: the program's, then those of the newest plan.
  std::vector<std::string> notes() const;

  /// The kind of the file decides which part takes it. May throw, unlike apply().
  void carry_out(const command::Open& c);
  void carry_out(const command::New& c);

private:
  /// Makes the file a part of the open preset, or shows it beside it; false where neither goes.
  bool take(const std::string& file);
  void carry_out_with_follow_ups(const Command& command);
  void carry_out_follow_ups();
  void begin(preset::WithSweep preset);
  void let_go();

  Services services_; ///< first: the other members use it
  RunInHand run_;
  MaterialBalls balls_;
  Comparing comparing_{run_, services_};
  ViewState view_state_;
  Document document_{run_, view_state_, services_};
  SweepQueue sweep_{document_, run_, comparing_};
  Playback playback_{document_, run_, services_.messages};
  FilmRecording film_;
  DocumentFiles document_files_{document_, run_, sweep_, services_.messages};
  Questions questions_{document_, services_.follow_ups};
  FileWriter files_{document_, run_, comparing_, view_state_, questions_, services_};
  WindowSetup setup_{document_};
  std::uint64_t last_before_commands_ = 0; ///< newer messages belong to the commands that are being carried out
  std::vector<std::string> program_notes_;
  bool has_earlier_session_ = false;
};

} // namespace nephroid::ui
