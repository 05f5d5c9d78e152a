// SPDX-License-Identifier: Apache-2.0
#include "ui/state/run_in_hand.h"

#include "engine/engine.h"
#include "preset/read.h"
#include "run/exposure.h"

#include <fmt/format.h>

#include <tuple>

namespace nephroid::ui {
namespace {

/// Whether two presets have the same light. They may be called and shown otherwise.
bool has_same_light(const preset::Preset& a, const preset::Preset& b) {
  preset::Preset same = a;
  std::tie(same.display, same.name, same.description) = std::tie(b.display, b.name, b.description);
  return same == b;
}

} // namespace

/// The facts of a run, filled on the worker's thread when the run is prepared.
struct RunInHand::Arrival {
  std::mutex mutex;
  std::optional<NewRun> run;                    ///< nothing: not ready yet
  std::shared_ptr<const preset::Preset> preset; ///< the preset of that run
};

void RunInHand::forget() {
  newest_ = {};
  snapshot_.reset();
  snapshot_origin_ = {};
}

std::function<std::unique_ptr<job::Job>()> RunInHand::maker() {
  if (preparing_.stop_requested()) preparing_ = {};
  return [this, preset = preset_, arrival = arrival_, stop = preparing_.get_token()] {
    const auto tell = [this](const std::string& doing) {
      const std::lock_guard lock(preparation_mutex_);
      preparation_ = doing;
    };
    tell("");
    NewRun run = source_.make(*preset, {stop, tell});
    std::unique_ptr<job::Job> job = std::move(run.job);
    const std::lock_guard lock(arrival->mutex);
    arrival->run = std::move(run);
    arrival->preset = preset;
    return job;
  };
}

/// The common part of all changes to another preset.
void RunInHand::take_over(const UndoStack& edits) {
  restart_wanted_ = snapshot_is_current_ = false;
  messages_.dismiss(failure_message_);
  preset_ = std::make_shared<const preset::Preset>(edits.current());
  const std::string edit = edits.undo_label();
  name_ = preset_->name.empty() ? preset::stem_of(preset_->source) : preset_->name;
  if (preset_->animation) name_ += fmt::format(", frame {}", edits.frame());
  if (!edit.empty()) name_ += ": " + edit;
}

void RunInHand::start(const UndoStack& edits) {
  if (lent_) return; // take_back() starts the run
  take_over(edits);
  begin();
}

void RunInHand::lend(std::shared_ptr<const preset::Preset> preset, std::string name) {
  lent_ = true;
  restart_wanted_ = snapshot_is_current_ = false;
  messages_.dismiss(failure_message_);
  preset_ = std::move(preset);
  name_ = std::move(name);
  begin();
}

void RunInHand::take_back(const UndoStack* edits) {
  lent_ = false;
  if (edits) start(*edits);
}

/// Whether the next run can use what the run before has read or is still reading. If not, it does not wait for it.
bool RunInHand::loads_the_same() const {
  if (!arrival_) return false;
  const std::lock_guard lock(arrival_->mutex);
  const preset::Preset& before = *arrival_->preset;
  return before.source == preset_->source && before.scene.objects == preset_->scene.objects;
}

/// Starts the run of preset_.
void RunInHand::begin() {
  const bool ends_preparation = reads_anew_ || kernels_changed_ || !loads_the_same();
  std::stop_source preparing_before = preparing_;
  if (ends_preparation) preparing_ = {};
  gesture_lasts_ = kernels_changed_ = reads_anew_ = shown_since_start_ = false;
  parts_since_.reset();
  arrival_ = std::make_shared<Arrival>();
  arrival_->preset = preset_;
  before_start_ = worker_.start(maker());
  if (ends_preparation) preparing_before.request_stop(); // now, because the worker knows that it is replaced
  status_ = worker_.status();
}

/// Takes an edit that changes no light; false where it does.
bool RunInHand::take_same_light(const preset::Preset& now) {
  if (lent_ || restart_wanted_ || !preset_ || now == *preset_ || !has_same_light(now, *preset_)) return false;
  const bool is_shown = snapshot_origin_.preset == preset_;
  if (const std::string& before = preset_->name; now.name != before && !before.empty())
    for (std::string* name : {&name_, &snapshot_name_}) // which may go on with a frame and an edit
      if (name->starts_with(before)) name->replace(0, before.size(), now.name);
  preset_ = std::make_shared<const preset::Preset>(now);
  if (is_shown) snapshot_origin_.preset = preset_;
  return true;
}

void RunInHand::adopt_or_start(const UndoStack& edits) {
  if (lent_ || take_same_light(edits.current())) return;
  if (kernels_changed_ || !preset_ || !engine::adoptable(*preset_, edits.current())) return start(edits);
  take_over(edits);
  newest_.reference.reset(); // it belongs to the old light
  adoption_ = worker_.adopt(preset_, maker());
}

void RunInHand::follow_edit(const UndoStack& edits, bool live) {
  if (take_same_light(edits.current())) return;
  restart_wanted_ = true;
  gesture_lasts_ = live;
  snapshot_is_current_ = false;
}

void RunInHand::cancel() {
  restart_wanted_ = false;
  worker_.cancel();
  preparing_.request_stop();
}

std::string RunInHand::preparation() const {
  const std::lock_guard lock(preparation_mutex_);
  return status_.state == job::State::preparing ? preparation_ : std::string();
}

void RunInHand::take_arrival() {
  if (!arrival_) return;
  const std::lock_guard lock(arrival_->mutex);
  if (!arrival_->run) return;
  newest_ = *std::exchange(arrival_->run, std::nullopt);
  if (!has_same_light(*arrival_->preset, *preset_)) newest_.reference.reset(); // it belongs to another light
  if (!preset_->white && newest_.white) {
    preset::Preset fitted = *preset_;
    fitted.white = newest_.white;
    preset_ = std::make_shared<const preset::Preset>(std::move(fitted));
  }
}

/// Parts of a picture on black would hide the picture of the run before. They are shown only where there is none, or
/// where the run is slow.
bool RunInHand::is_worth_showing(const job::Snapshot& newest) {
  if (newest.progress.whole || !snapshot_ || shown_since_start_ || status_.state != job::State::running) return true;
  const auto now = std::chrono::steady_clock::now();
  if (!parts_since_) parts_since_ = now;
  return now - *parts_since_ > std::chrono::seconds(2);
}

/// Takes a newer snapshot; true where there is one.
bool RunInHand::take_snapshot() {
  std::shared_ptr<const job::Snapshot> newest = worker_.snapshot();
  if (!newest || !newest->picture || newest == before_start_ || newest == snapshot_ || !is_worth_showing(*newest))
    return false;
  snapshot_ = std::move(newest);
  snapshot_name_ = name_;
  shown_since_start_ = true;
  snapshot_is_current_ = !lent_ && !restart_wanted_ && snapshot_->adoption >= adoption_;
  return true;
}

void RunInHand::report_failure() {
  if (status_.state != job::State::failed || status_.failures == reported_failure_) return;
  reported_failure_ = status_.failures;
  source_.reopen_device(); // it may be lost; opening it takes a moment, and only after a failure
  messages_.error(*status_.error);
  failure_message_ = messages_.newest();
}

void RunInHand::update(const UndoStack* edits) {
  // In this order: the worker makes a run's last snapshot before it says that the run is over.
  status_ = worker_.status();
  spectrum_ = worker_.spectrum();
  const bool is_new = take_snapshot();
  take_arrival(); // the worker left it there before the run's first snapshot
  if (is_new) {
    const bool is_judged = snapshot_->progress.step >= 1 && !snapshot_->stands_in && preset_->white;
    exposure_ = is_judged ? run::exposure_note(*snapshot_->picture, *preset_, "white {}") : std::string();
  }
  if (is_new && snapshot_->adoption >= adoption_)
    snapshot_origin_ = {preset_, newest_.plan, newest_.reference, newest_.device};
  report_failure();
  if (!edits) return;
  if (source_.take_changed()) {
    restart_wanted_ = kernels_changed_ = true;
    ++readings_;
    snapshot_is_current_ = false;
  }
  start_if_wanted(*edits);
}

void RunInHand::start_if_wanted(const UndoStack& edits) {
  // An edit replaces the run at once. While a gesture lasts, the run in hand may first show a picture. Otherwise, on a
  // slow device, every move of the mouse would drop a run that has shown nothing yet, and no picture would appear until
  // the mouse rests.
  const bool working = status_.state == job::State::preparing || status_.state == job::State::running;
  if (restart_wanted_ && !lent_ && (!gesture_lasts_ || !working || shown_since_start_)) adopt_or_start(edits);
}

} // namespace nephroid::ui
