// SPDX-License-Identifier: Apache-2.0
#include "ui/state/workbench.h"

#include "base/error.h"
#include "base/files.h"
#include "spectral/relight/only_relit.h"
#include "ui/dispersion/edits.h"
#include "ui/state/file_kind.h"
#include "ui/state/save.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <mutex>

namespace nephroid::ui {
namespace {

using namespace std::chrono_literals;
constexpr auto note_lifetime = 6s; ///< notes go by themselves, errors stay until they are dismissed

/// "Ball lens: distance of the camera": the preset and the newest edit.
std::string name_of(const UndoStack& history)
{
  const preset::Preset& preset = history.current();
  const std::string name = preset.name.empty() ? std::filesystem::path(preset.source).stem().string() : preset.name;
  const std::string edit = history.undo_label();
  return edit.empty() ? name : name + ": " + edit;
}

bool is_shipped(const std::filesystem::path& file)
{
  std::error_code unknown;
  try {
    const std::filesystem::path inside = std::filesystem::relative(file, presets_folder(), unknown);
    return !unknown && !inside.empty() && *inside.begin() != "..";
  } catch (const Error&) {
    return false; // there is no folder of shipped presets
  }
}

} // namespace

/// Filled on the worker's thread when a run was made ready.
struct Workbench::Arrival {
  std::mutex mutex;
  std::shared_ptr<const plan::Plan> plan; ///< null: not yet
  std::shared_ptr<const measure::Reference> reference;
  std::shared_ptr<const SeenByGlass> seen;
  std::shared_ptr<const preset::Preset> preset; ///< that it was made of
};

void Workbench::apply(const Commands& commands)
{
  last_before_commands_ = last_message_;
  for (const Command& command : commands) {
    try {
      std::visit([this](const auto& c) { carry_out(c); }, command);
    } catch (const std::exception& error) {
      say(error);
    }
  }
}

bool Workbench::open(const std::string& name, const preset::Overrides& overrides)
{
  try {
    refuse_other_kinds(name);
    history_.emplace(preset::read_preset(name, overrides));
  } catch (const std::exception& error) {
    say(error);
    return false;
  }
  std::erase_if(messages_, [&](const Message& m) { return m.error && m.id <= last_before_commands_; });
  plan_.reset();
  reference_.reset();
  seen_.reset();
  difference_.forget();
  look_ = Look{};
  snapshot_.reset(); // another preset's picture would be mistaken for this one's
  question_ = Question::none;
  waiting_.reset();
  start();
  return true;
}

void Workbench::ask_first(Command command)
{
  waiting_ = std::move(command);
  question_ = Question::unsaved;
}

void Workbench::carry_out(const command::Open& c)
{
  if (is_history(c.name)) {
    carry_out(command::PinFile{c.name});
    return;
  }
  if (history_ && is_dispersion_file(c.name)) {
    carry_out(command::LoadDispersion{c.name});
    return;
  }
  if (c.sure || !unsaved()) {
    open(c.name);
    return;
  }
  refuse_other_kinds(c.name);
  preset::read_preset(c.name); // what cannot be opened is said at once, and nothing is asked
  ask_first(command::Open{c.name, true});
}

void Workbench::carry_out(const command::Edit& c)
{
  if (!history_) return;
  preset::Preset edited = c.preset;
  edited.provenance = {}; // what is wrong from now on is what was typed here, not what the file or an option gave
  history_->push(c.label, std::move(edited), c.gesture);
  restart_wanted_ = true;
  gesture_lasts_ = c.live;
  snapshot_is_current_ = false;
}

void Workbench::carry_out(const command::EndGesture&) { gesture_lasts_ = false; }

void Workbench::carry_out(const command::Undo&)
{
  if (history_ && history_->undo()) adopt_or_start();
}

void Workbench::carry_out(const command::Redo&)
{
  if (history_ && history_->redo()) adopt_or_start();
}

void Workbench::carry_out(const command::Restart&)
{
  if (history_) start();
}

void Workbench::carry_out(const command::Cancel&)
{
  restart_wanted_ = false;
  worker_.cancel();
}

void Workbench::carry_out(const command::Pause& c) { worker_.pause(c.on); }

void Workbench::carry_out(const command::SetLook& c)
{
  look_ = c.look;
  look_.exposure_stops = std::clamp(look_.exposure_stops, -20.0, 20.0);
}

void Workbench::carry_out(const command::Ask& c)
{
  question_ = c.question;
  if (question_ == Question::none) waiting_.reset(); // answered by "no"
}

void Workbench::carry_out(const command::SavePreset& c)
{
  if (!history_) return;
  write_file_whole(c.file, preset::to_json(history_->current()));
  history_->mark_saved(c.file.string());
  question_ = Question::none;
  say(false, "saved " + c.file.string());
  if (const auto command = std::exchange(waiting_, std::nullopt)) std::visit([this](const auto& next) { carry_out(next); }, *command);
}

void Workbench::carry_out(const command::SavePicture& c)
{
  if (!snapshot_) return;
  question_ = Question::none;
  background_.push_back(std::async(std::launch::async, [file = c.file, snapshot = snapshot_, stops = look_.exposure_stops] {
    Finished done;
    try {
      save_picture(file, *snapshot->picture, stops);
      done.message.error = false;
      done.message.line = "saved " + file.string();
    } catch (const std::exception& error) {
      done.message.line = error.what();
    }
    return done;
  }));
}

void Workbench::carry_out(const command::Dismiss& c)
{
  std::erase_if(messages_, [&](const Message& m) { return m.id == c.message; });
}

void Workbench::carry_out(const command::ShowHelp& c) { help_shown_ = c.on; }

void Workbench::carry_out(const command::ResetLayout&) { layout_reset_ = true; }

void Workbench::carry_out(const command::Report& c) { say(c.error, c.line); }

void Workbench::carry_out(const command::Quit& c)
{
  if (c.sure || !unsaved())
    quitting_ = true;
  else
    ask_first(command::Quit{true});
}

void Workbench::say(const std::exception& error)
{
  const auto* known = dynamic_cast<const Error*>(&error);
  say(true, error.what(), known ? known->kind() : ErrorKind::failed);
}

void Workbench::say(bool error, std::string line, ErrorKind kind)
{
  // The same thing again (a panel that fails every frame) is one message.
  for (const Message& m : messages_)
    if (m.line == line && m.error == error) return;
  messages_.push_back({++last_message_, error, std::move(line), Clock::now(), kind});
}

/// Makes a run of the preset as it is now, on the worker's thread.
std::function<std::unique_ptr<job::Job>()> Workbench::maker() const
{
  return [&source = source_, preset = run_preset_, arrival = arrival_] {
    NewRun run = source.make(*preset);
    const std::lock_guard lock(arrival->mutex);
    arrival->plan = std::move(run.plan);
    arrival->reference = std::move(run.reference);
    arrival->seen = std::move(run.seen);
    arrival->preset = preset;
    return std::move(run.job);
  };
}

void Workbench::start()
{
  restart_wanted_ = gesture_lasts_ = kernels_changed_ = false;
  snapshot_is_current_ = shown_since_start_ = false;
  std::erase_if(messages_, [&](const Message& m) { return m.id == failure_message_; });
  before_start_ = worker_.snapshot();
  run_name_ = name_of(*history_);
  run_preset_ = std::make_shared<const preset::Preset>(history_->current());
  arrival_ = std::make_shared<Arrival>();
  worker_.start(maker());
}

/// Where only the light differs, the run in hand takes it on and goes on converging. What it was measured against is of the old light.
void Workbench::adopt_or_start()
{
  if (kernels_changed_ || !run_preset_ || !spectral::only_relit(*run_preset_, history_->current())) {
    start();
    return;
  }
  restart_wanted_ = snapshot_is_current_ = false;
  std::erase_if(messages_, [&](const Message& m) { return m.id == failure_message_; });
  run_name_ = name_of(*history_);
  run_preset_ = std::make_shared<const preset::Preset>(history_->current());
  reference_.reset();
  adoption_ = worker_.adopt(run_preset_, maker());
}

void Workbench::take_arrival()
{
  if (!arrival_) return;
  const std::lock_guard lock(arrival_->mutex);
  if (!arrival_->plan) return;
  plan_ = std::exchange(arrival_->plan, nullptr);
  reference_ = std::exchange(arrival_->reference, nullptr);
  seen_ = std::exchange(arrival_->seen, nullptr);
  if (arrival_->preset != run_preset_) reference_.reset(); // it is of another light
}

std::vector<std::string> Workbench::notes() const
{
  std::vector<std::string> all = program_notes_;
  if (plan_) all.insert(all.end(), plan_->notes.begin(), plan_->notes.end());
  return all;
}

void Workbench::take_snapshot()
{
  std::shared_ptr<const job::Snapshot> newest = worker_.snapshot();
  if (!newest || !newest->picture || newest == before_start_ || newest == snapshot_) return;
  snapshot_ = std::move(newest);
  snapshot_name_ = run_name_;
  shown_since_start_ = true;
  snapshot_is_current_ = !restart_wanted_ && snapshot_->adoption >= adoption_;
}

void Workbench::collect_messages(Clock::time_point now)
{
  if (status_.state == job::State::failed && status_.failures != reported_failure_) {
    reported_failure_ = status_.failures;
    say(*status_.error);
    failure_message_ = last_message_;
  }
  std::erase_if(messages_, [&](const Message& m) { return !m.error && now - m.since > note_lifetime; });
}

void Workbench::collect_background()
{
  for (std::future<Finished>& future : background_)
    if (future.wait_for(0s) == std::future_status::ready) {
      Finished done = future.get();
      if (!done.message.line.empty()) say(done.message.error, done.message.line, done.message.kind);
      if (done.pin) pinned_.add(std::move(*done.pin));
    }
  std::erase_if(background_, [](const std::future<Finished>& f) { return !f.valid(); });
}

void Workbench::update(Clock::time_point now)
{
  // In this order: the worker makes a run's last snapshot before it says that the run is over.
  status_ = worker_.status();
  take_snapshot();
  take_arrival();
  collect_background();
  collect_messages(now);
  make_difference(now);
  if (source_.take_changed() && history_) {
    restart_wanted_ = kernels_changed_ = true;
    snapshot_is_current_ = false;
  }
  // An edit replaces the run at once. While a gesture lasts, the run in hand may first show a picture: on a slow device every move of
  // the mouse would otherwise throw away a run that has not shown anything yet, and nothing would be seen until the mouse rests.
  const bool working = status_.state == job::State::preparing || status_.state == job::State::running;
  if (restart_wanted_ && (!gesture_lasts_ || !working || shown_since_start_)) adopt_or_start();
}

std::filesystem::path Workbench::save_target() const
{
  if (!history_ || history_->current().source.empty()) return {};
  const std::filesystem::path source = history_->current().source;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(source, ignored) || is_shipped(source)) return {};
  return source;
}

std::string Workbench::proposed_name(Question question) const
{
  if (!history_) return {};
  const std::filesystem::path source = history_->current().source;
  const std::string stem = source.empty() ? "untitled" : source.stem().string();
  return question == Question::save_picture ? stem + ".png" : stem + "-edited.json";
}

} // namespace nephroid::ui
