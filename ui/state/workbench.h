// SPDX-License-Identifier: Apache-2.0
// The state behind the window, put together: each part owns a subject and carries out its commands. Knows nothing of
// Dear ImGui. Panels read a Context of it; commands change it; update() runs once a frame and never waits for a device;
// of files it reads the preset alone, when that was changed.
#pragma once
#include "ui/state/comparing.h"
#include "ui/state/context.h"
#include "ui/state/file_watch.h"
#include "ui/state/file_writer.h"
#include "ui/state/questions.h"
#include "ui/state/session.h"
#include "ui/state/window_setup.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::ui {

class Workbench {
public:
  using Clock = std::chrono::steady_clock;

  /// source outlives the workbench.
  explicit Workbench(RunSource& source) : run_(source, services_.messages) {}

  /// Carries out commands in their order. Whatever goes wrong becomes a message; nothing is thrown.
  void apply(const Commands& commands);
  /// Opens a preset with overrides (--set). False, with a message, where it cannot be read.
  bool open(const std::string& name, const preset::Overrides& overrides = {});
  /// As a session was; `folder` holds its pinned runs, which are read in the background. The run starts.
  void restore(Session session, const std::filesystem::path& folder);
  /// Once a frame: takes the newest snapshot, starts the run that edits ask for, collects what finished in the
  /// background.
  void update(Clock::time_point now = Clock::now());

  /// For one frame; what is asked for goes to `commands`.
  Context context(Commands& commands) {
    return {edits(),         run_,   comparing_, view_state_, setup_.settings(), has_earlier_session_, commands,
            files_.recent(), sweep_, tasks()};
  }
  /// Both are null before a preset is opened.
  const preset::Preset* preset() const { return document_.preset(); }
  const UndoStack* edits() const { return document_.edits(); }
  const RunInHand& run() const { return run_; }
  const Comparing& comparing() const { return comparing_; }
  const SweepQueue& sweep() const { return sweep_; }
  const ViewState& view_state() const { return view_state_; }
  const std::vector<Message>& messages() const { return services_.messages.all(); }
  TaskQueue& tasks() { return services_.tasks; }
  Questions& questions() { return questions_; }
  const Questions& questions() const { return questions_; }
  WindowSetup& setup() { return setup_; }
  const WindowSetup& setup() const { return setup_; }
  /// From now on presets that are opened or saved are remembered there.
  void remember(RecentFiles recent) { files_.remember(std::move(recent)); }
  /// Whether there is an earlier session to reopen.
  void offer_earlier(bool there_is) { has_earlier_session_ = there_is; }
  /// Waits until the tasks of this key are done and delivered.
  void finish(const TaskKey& key) { services_.tasks.wait(key, services_.messages); }
  /// Whether a file is being read or written in the background: its pin or its message is to come.
  bool works_on_files() const { return files_.busy() || comparing_.reads_pins() || document_.reads_mesh(); }
  /// Before the end: waits until what is being written is, and has a message of what could not be.
  void finish_files() { services_.tasks.finish(services_.messages); }
  /// One more line for notes(), from the program itself.
  void add_note(std::string line) { program_notes_.push_back(std::move(line)); }
  /// What is worth knowing and needs no answer: the program's notes, then those of the newest plan.
  std::vector<std::string> notes() const;

  /// What a file is decides which part takes it. May throw, unlike apply().
  void carry_out(const command::Open& c);
  void carry_out(const command::New& c);

private:
  void carry_out_with_follow_ups(const Command& command);
  void carry_out_follow_ups();
  void begin(preset::WithSweep preset);
  void let_go();

  Services services_; ///< first: the others use it
  RunInHand run_;
  Comparing comparing_{run_, services_};
  ViewState view_state_;
  Document document_{run_, view_state_, services_};
  SweepQueue sweep_{document_, run_, comparing_};
  DocumentFiles document_files_{document_, run_, sweep_, services_.messages};
  Questions questions_{document_, services_.follow_ups};
  FileWriter files_{document_, run_, comparing_, view_state_, questions_, services_};
  WindowSetup setup_{document_};
  std::uint64_t last_before_commands_ = 0; ///< newer messages are about the commands that are being carried out
  std::vector<std::string> program_notes_;
  bool has_earlier_session_ = false;
};

} // namespace nephroid::ui
