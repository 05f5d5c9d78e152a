// SPDX-License-Identifier: Apache-2.0
// What the window shows after an edit, without its window. Kernels were compiled before.
//
//     nephroid_after_edit SECONDS TRUTH FOLDER PRESET EDIT [SET...]
//     nephroid_after_edit EDITS - - PRESET EDIT [SET...]
//
// EDIT and SET: as of --set; SET holds before the edit, too. The first lets the run work for a second, edits and prints
// a line of CSV for each time up to SECONDS: the picture that is shown then against TRUTH, a picture of the edited
// preset. "previous": it is still the one before the edit. FOLDER gets a PNG of each. The second makes so many edits,
// EDIT and back, .3 to .9 s of work apart, and prints the seconds from an edit to its first picture: the median and the
// most. tests/experiments/after_edits.py makes tables of both.
#include "base/memory.h"
#include "image/image.h"
#include "measure/read_picture.h"
#include "ui/state/device_runs.h"
#include "ui/state/run_in_hand.h"
#include "ui/state/undo.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <thread>

namespace {

using namespace nephroid;
using Clock = std::chrono::steady_clock;

constexpr double times[] = {0.1, 0.15, 0.25, 0.35, 0.5, 0.7, 1, 1.5, 2, 3, 5, 7, 10, 15, 20, 30};
constexpr double before_the_edit = 2, between_edits = 0.3; ///< seconds of work
constexpr std::chrono::milliseconds a_look{2};

struct Shown {
  double seconds;
  bool previous;
  std::shared_ptr<const job::Snapshot> snapshot;
};

/// A window's run of a preset, which is edited.
class EditedRun {
public:
  EditedRun(const std::string& name, const std::string& edit, preset::Overrides sets) {
    sets.emplace_back(R"(stop={"seconds": 100000})");
    original_ = preset::read_preset(name, sets);
    sets.push_back(edit);
    edited_ = preset::read_preset(name, sets);
    edits_.emplace(original_);
    run_.start(*edits_);
    work(before_the_edit);
  }

  /// Until the run in hand has worked so many seconds.
  void work(double seconds) {
    while (!run_.snapshot_is_current() || run_.status().progress.work_seconds < seconds) look();
  }

  /// The edit, or its undoing.
  void edit() {
    begin_ = Clock::now();
    edits_->push("edit", is_edited_ ? original_ : edited_);
    is_edited_ = !is_edited_;
    run_.follow_edit(*edits_);
    run_.start_if_wanted(*edits_);
  }

  double since_edit() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

  /// Seconds from the edit to its first picture.
  double first_picture() {
    while (!run_.snapshot_is_current()) look();
    return since_edit();
  }

  std::vector<Shown> pictures(double seconds) {
    std::vector<Shown> shown;
    for (const double time : times) {
      if (time > seconds) break;
      while (since_edit() < time) look();
      shown.push_back({time, !run_.snapshot_is_current(), run_.snapshot()});
    }
    return shown;
  }

private:
  void look() {
    std::this_thread::sleep_for(a_look);
    run_.update(&*edits_);
    if (run_.status().state == job::State::failed) throw std::runtime_error(run_.status().error->line());
  }

  ui::DeviceRuns runs_{{}};
  ui::Messages messages_;
  ui::RunInHand run_{runs_, messages_};
  preset::Preset original_, edited_;
  std::optional<ui::UndoStack> edits_;
  bool is_edited_ = false;
  Clock::time_point begin_;
};

void print_first_pictures(EditedRun& run, int edits) {
  std::vector<double> seconds;
  for (int i = 0; i < edits; ++i) {
    run.work(between_edits * (i % 3 + 1));
    run.edit();
    seconds.push_back(run.first_picture());
  }
  std::ranges::sort(seconds);
  fmt::print("{:.4f},{:.4f}\n", seconds[seconds.size() / 2], seconds.back());
}

/// own_: of the run's own picture, without the light that it keeps.
void print_errors(const std::vector<Shown>& shown, const measure::LinearPicture& truth, const std::string& folder) {
  fmt::print("seconds,previous,lab_mean,rel_l2,flip,own_lab_mean,own_rel_l2\n");
  for (const Shown& s : shown) {
    const job::Picture &own = *s.snapshot->picture, &picture = s.snapshot->in_view ? *s.snapshot->in_view : own;
    const auto compared = [&](const job::Picture& of) {
      return measure::compare({of.width, of.height, of.rgb, "the run"}, truth.pixels());
    };
    const measure::Metrics m = compared(picture), without = compared(own);
    fmt::print("{},{},{:.3f},{:.4f},{:.4f},{:.3f},{:.4f}\n", s.seconds, s.previous ? "previous" : "", m.lab_mean,
               m.rel_l2, m.flip.value_or(NAN), without.lab_mean, without.rel_l2);
    image::write_png(fmt::format("{}/{:05.2f}.png", folder, s.seconds), picture.width, picture.height, picture.rgb);
  }
}

} // namespace

int main(int count, char** arguments) {
  if (count < 6) return fmt::print(stderr, "nephroid_after_edit NUMBER TRUTH FOLDER PRESET EDIT [SET...]\n"), 2;
  nephroid::keep_freed_memory();
  try {
    const double number = std::atof(arguments[1]);
    const std::string truth_file = arguments[2];
    EditedRun run(arguments[4], arguments[5], {arguments + 6, arguments + count});
    if (truth_file == "-") {
      print_first_pictures(run, static_cast<int>(number));
    } else {
      for (int i = 0; i < 2; ++i) { // the edit and back, so that its kernels are compiled
        run.edit();
        run.first_picture();
      }
      run.work(1);
      run.edit();
      print_errors(run.pictures(number), measure::read_linear_rgb(truth_file), arguments[3]);
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "nephroid_after_edit: {}\n", error.what());
    return 1;
  }
}
