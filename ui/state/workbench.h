// SPDX-License-Identifier: Apache-2.0
// The state behind the window, put together: the preset with its history, the run in hand, what it is compared with, files, messages. Knows
// nothing of Dear ImGui. Panels read a Context of it; commands change it; update() runs once a frame and never waits for a device; of files
// it reads the preset alone, when that was changed.
#pragma once
#include "preset/read.h"
#include "ui/state/context.h"
#include "ui/state/file_watch.h"
#include "ui/state/files.h"
#include "ui/state/session.h"
#include "ui/state/tasks.h"

namespace nephroid::ui {

class Workbench {
public:
  using Clock = std::chrono::steady_clock;

  /// source outlives the workbench.
  explicit Workbench(RunSource& source) : run_(source, messages_) {}

  /// Carries out commands in their order. Whatever goes wrong becomes a message; nothing is thrown.
  void apply(const Commands& commands);
  /// Opens a preset with overrides (--set). False, with a message, where it cannot be read.
  bool open(const std::string& name, const preset::Overrides& overrides = {});
  /// From now on presets that are opened or saved are remembered there.
  void remember(RecentFiles recent) { recent_ = std::move(recent); }
  /// As a session was; `folder` holds its pinned runs, which are read in the background. The run starts.
  void restore(Session session, const std::filesystem::path& folder);
  /// True once after ReopenSession.
  bool take_reopen() { return std::exchange(reopen_, false); }
  /// Whether there is an earlier session to reopen.
  void offer_earlier(bool there_is) { has_earlier_session_ = there_is; }
  /// One more line for notes(), from the program itself.
  void add_note(std::string line) { program_notes_.push_back(std::move(line)); }
  /// Once a frame: takes the newest snapshot, starts the run that edits ask for, collects what finished in the background.
  void update(Clock::time_point now = Clock::now());

  /// For one frame; what is asked for goes to `commands`.
  Context context(Commands& commands)
  {
    return {edits(), run_, comparing_, view_state_, settings_, has_earlier_session_, commands, recent_, sweep_, tasks_};
  }
  /// Null before a preset is opened.
  const preset::Preset* preset() const { return edits_ ? &edits_->current() : nullptr; }
  const UndoStack* edits() const { return edits_ ? &*edits_ : nullptr; }
  const RunInHand& run() const { return run_; }
  const Comparing& comparing() const { return comparing_; }
  const SweepQueue& sweep() const { return sweep_; }
  const ViewState& view_state() const { return view_state_; }
  const RecentFiles& recent() const { return recent_; }
  const std::vector<Message>& messages() const { return messages_.all(); }
  TaskQueue& tasks() { return tasks_; }
  /// Waits until the tasks of this key are done and delivered.
  void finish(const TaskKey& key) { tasks_.wait(key, messages_); }
  /// Whether a file is being read or written in the background: its pin or its message is to come.
  bool works_on_files() const { return tasks_.busy(writes_) || tasks_.busy(pins_) || tasks_.busy(meshes_); }
  /// Before the end: waits until what is being written is, and has a message of what could not be.
  void finish_files() { tasks_.finish(messages_); }
  /// What is worth knowing and needs no answer: the program's notes, then those of the newest plan.
  std::vector<std::string> notes() const;
  Question question() const { return question_; }
  /// With Question::unsaved: what waits for the answer, an Open, a New, a ReopenSession or a Quit that asks no more. Else null.
  const Command* waiting() const { return waiting_ ? &*waiting_ : nullptr; }
  bool help_shown() const { return help_shown_; }
  bool quitting() const { return quitting_; }
  const Settings& settings() const { return settings_; }
  /// As they were kept; before the first frame.
  void set_settings(Settings settings) { settings_ = std::move(settings); }
  /// True once after ResetLayout.
  bool take_layout_reset() { return std::exchange(layout_reset_, false); }
  /// Once after ShowPanel the panel to be brought to the front; else empty.
  std::string take_panel_to_front() { return std::exchange(panel_to_front_, {}); }

private:
  void carry_out(const command::Open& c);
  void carry_out(const command::OpenMap& c);
  void carry_out(const command::New& c);
  void carry_out(const command::Edit& c);
  void carry_out(const command::SetSweep& c);
  void carry_out(const command::StartSweep&);
  void carry_out(const command::StopSweep&) { sweep_.stop(run_, edits()); }
  void carry_out(const command::EndGesture&) { run_.end_gesture(); }
  void carry_out(const command::Undo&) { step_in_edits(&UndoStack::undo); }
  void carry_out(const command::Redo&) { step_in_edits(&UndoStack::redo); }
  void carry_out(const command::Restart&)
  {
    if (edits_) run_.start(*edits_);
  }
  void carry_out(const command::Cancel&);
  void carry_out(const command::Pause& c) { run_.pause(c.on); }
  void carry_out(const command::SetViewSettings& c);
  void carry_out(const command::InspectPixel& c);
  void carry_out(const command::SelectRegion& c);
  void carry_out(const command::ShowLines& c) { view_state_.lines = c.lines; }
  void carry_out(const command::PinFile& c)
  {
    close_question();
    pin(c.path, {}, c.show);
  }
  void carry_out(const command::ChooseMetric& c) { view_state_.error_metric = c.metric; }
  void carry_out(const command::ChooseMaterial& c) { view_state_.material = c.material; }
  void carry_out(const command::LoadDispersion& c);
  void carry_out(const command::Select& c);
  void carry_out(const command::SetHandles& c) { view_state_.handles = c.handles; }
  void carry_out(const command::Nudged& c) { view_state_.nudged = c; }
  void carry_out(const command::SetBookmarks& c) { view_state_.bookmarks = c.bookmarks; }
  void carry_out(const command::Ask& c);
  void carry_out(const command::SavePreset& c);
  void carry_out(const command::SavePicture& c);
  void carry_out(const command::OpenResult& c);
  void carry_out(const command::WriteReport& c);
  void carry_out(const command::Dismiss& c) { messages_.dismiss(c.message); }
  void carry_out(const command::ToggleHelp&) { help_shown_ = !help_shown_; }
  void carry_out(const command::ReopenSession& c) { reopen_ |= !asks_first(c); }
  void carry_out(const command::ReloadPreset&)
  {
    if (!take_over_file()) messages_.note("the file has what is shown");
  }
  void carry_out(const command::ResetLayout&);
  void carry_out(const command::KeepLayout& c) { settings_.engines[c.engine].ini = c.ini; }
  void carry_out(const command::ShowPanel& c);
  void note_left_out(const preset::Preset& before, std::string_view engine);
  void carry_out(const command::SetAppearance& c);
  void carry_out(const command::Report& c) { c.error ? messages_.error(c.line) : messages_.note(c.line); }
  void carry_out(const command::Quit& c) { quitting_ |= !asks_first(c); }
  /// What holds runs against each other is the business of Comparing.
  template <class C>
  void carry_out(const C& c)
  {
    comparing_.carry_out(c);
  }
  /// Whether the command waits for what becomes of unsaved changes. Then it asks no more.
  template <class C>
  bool asks_first(C c)
  {
    if (std::exchange(c.sure, true) || !edits_ || !edits_->modified()) return false;
    waiting_ = std::move(c);
    question_ = Question::unsaved;
    return true;
  }
  void look_at_files();
  void look_at_own_file();
  /// What the preset's file has now becomes an edit that counts as saved. False where it is what is there already.
  bool take_over_file();
  /// What the View shows now.
  PictureToSave shown_picture() const;
  /// Writes a file in the background, after those before it; what write() answers becomes a note.
  void save(const std::filesystem::path& file, std::function<std::string()> write);
  /// Reads an earlier run or a picture and pins it; as `like` in name, colour and whether it is shown, where that is given. show: a
  /// picture is shown in the View.
  void pin(const std::filesystem::path& path, const std::optional<Session::Pin>& like = {}, bool show = false);
  void import_scene(const std::filesystem::path& file);
  void read_mesh(const std::filesystem::path& file);
  void add_recent(const std::filesystem::path& file);
  void add_object(const DroppedMesh& mesh);
  /// As the engine of the preset in hand does, which takes pictures.
  void take_picture(const std::string& file);
  void begin(preset::Preset preset, preset::Sweep sweep = {});
  void let_go();
  void close_question();
  void step_in_edits(bool (UndoStack::*step)());
  EngineLayout& engine_layout();

  std::optional<UndoStack> edits_;
  Messages messages_;
  std::uint64_t last_before_commands_ = 0; ///< newer messages are about the commands that are being carried out
  std::uint64_t refused_edit_ = 0;         ///< what was said of the last one that was not done
  RunInHand run_;
  TaskQueue tasks_;
  TaskKey writes_, pins_, meshes_, recent_writes_;
  Comparing comparing_{run_, tasks_};
  SweepQueue sweep_;
  ViewState view_state_;
  FileWatch watch_;
  std::shared_ptr<const preset::Preset> watched_, watched_from_; ///< whose files are watched, and as it was opened
  RecentFiles recent_;
  std::vector<std::string> program_notes_;
  Settings settings_;
  std::string panel_to_front_;

  Question question_ = Question::none;
  std::optional<Command> waiting_;
  bool help_shown_ = false, quitting_ = false, layout_reset_ = false, reopen_ = false, has_earlier_session_ = false;
};

} // namespace nephroid::ui
