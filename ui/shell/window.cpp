// SPDX-License-Identifier: Apache-2.0
#include "ui/shell/window.h"

#include "base/error.h"
#include "base/files.h"
#include "base/lower_case.h"
#include "image/image.h"
#include "job/pace.h"
#include "preset/read.h"
#include "ui/shell/glfw_window.h"
#include "ui/shell/status_line.h"
#include "ui/shell/workspace.h"
#include "ui/state/device_runs.h"
#include "ui/state/session_keeper.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fstream>

namespace nephroid::ui {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int frames_before_screenshot = 60;
constexpr std::chrono::milliseconds hands_rest{500}; ///< after the last touch the display's rate is kept this long

std::string title(const Workbench& workbench) {
  const preset::Preset* preset = workbench.preset();
  if (!preset) return "Nephroid";
  const std::string name = preset->name.empty() ? preset->source : preset->name;
  return fmt::format("{}{} - Nephroid", workbench.edits()->modified() ? "* " : "", name);
}

bool is_over(job::State state) {
  return state == job::State::finished || state == job::State::cancelled || state == job::State::failed ||
         state == job::State::idle;
}

/// Pins the histories and opens the first preset that can be opened, or a run's where there are only runs. Behind it
/// only runs and pictures are expected: what is none leaves its message.
void open_first(Workbench& workbench, const Options& options) {
  bool opened = false;
  if (!options.files.empty() && std::ranges::all_of(options.files, is_history))
    if (const std::string preset_file = preset_of_run(options.files.front()); !preset_file.empty())
      opened = workbench.open(preset_file, options.overrides);
  for (const std::string& file : options.files)
    if (opened || is_history(file))
      workbench.apply({command::PinFile{file}});
    else if (kind_of(file) != FileKind::scene)
      opened = workbench.open(file, options.overrides);
    else if (options.overrides.empty())
      workbench.apply({command::Open{file}});
    else // it becomes a preset in the background: --set cannot wait
      workbench.apply({command::Report{
          bad_input(file, "--set cannot change a scene", "a preset", "import it first: nephroid import").line()}});
}

/// An unattended window keeps nothing and begins as a new one.
bool keeps_sessions(const Options& options) { return options.screenshot.empty(); }

std::unique_ptr<SessionKeeper> make_keeper(const Options& options, Workbench& workbench) {
  try {
    return std::make_unique<SessionKeeper>(keeps_sessions(options) ? state_folder() : std::filesystem::path());
  } catch (const std::exception& error) {
    workbench.apply({command::Report{error.what()}});
    return std::make_unique<SessionKeeper>(std::filesystem::path());
  }
}

/// A window that was killed is shown as it was, unless there is something else to show.
void begin_session(Workbench& workbench, SessionKeeper& keeper, const Options& options) {
  const std::string killed = keeper.killed_session();
  if (killed.empty()) return;
  if (options.files.empty()) {
    keeper.reopen(workbench);
    if (workbench.preset())
      workbench.apply({command::Report{"the last window was not closed: this is how it was at " + killed, false}});
  } else
    workbench.apply({command::Report{
        "a window that was not closed left a session of " + killed + ": File, Reopen the last session", false}});
}

bool changes_preset(const Command& command) {
  return std::holds_alternative<command::Edit>(command) || std::holds_alternative<command::Undo>(command) ||
         std::holds_alternative<command::Redo>(command);
}

/// What this thread has computed so far: time in which another had its core does not count.
Clock::duration computed() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

double milliseconds(Clock::duration time) { return std::chrono::duration<double, std::milli>(time).count(); }

/// When the next frame is drawn, and how long frames took.
class FrameClock {
public:
  /// Somebody moves the mouse: the display's rate. A run goes on: often enough for its snapshots. Else: seldom.
  enum class Pace { hands_on, running, idle };

  /// keep: every frame's time, for summary(); else frames are only counted. file: CSV with the line
  /// frame,draw_ms,own_ms,own_cpu_ms,period_ms,edits,run,state,fraction of a frame as soon as it has been drawn, so
  /// that who reads along knows what the window is at; empty: none. Throws failed where it cannot be written.
  FrameClock(bool keep, const std::filesystem::path& file) : keep_(keep), file_(file) {
    if (file.empty()) return;
    lines_.open(file, std::ios::binary);
    write("frame,draw_ms,own_ms,own_cpu_ms,period_ms,edits,run,state,fraction\n");
  }
  bool keeps() const { return keep_; }
  std::size_t frames() const { return frames_; }

  void begin() {
    previous_ = std::exchange(began_, Clock::now());
    computed_before_ = computed();
  }

  /// What follows, until own() again, is OpenGL's work and not ours.
  void driver() {
    driver_began_ = Clock::now();
    driver_computed_before_ = computed();
  }
  void own() {
    driver_ += Clock::now() - driver_began_;
    driver_computed_ += computed() - driver_computed_before_;
  }
  /// edits: how many there were. Throws failed where the file cannot be written any more.
  void end(const job::Status& run, std::size_t edits) {
    const double draw_ms = milliseconds(Clock::now() - began_);
    last_draw_s_ = draw_ms / 1000;
    if (keep_) draw_ms_.push_back(draw_ms);
    if (!file_.empty()) {
      const double period_ms = frames_ == 0 ? 0 : milliseconds(began_ - previous_); // what a person sees
      write(fmt::format("{},{:.3f},{:.3f},{:.3f},{:.3f},{},{},{},{:.4f}\n", frames_, draw_ms,
                        draw_ms - milliseconds(driver_), milliseconds(computed() - computed_before_ - driver_computed_),
                        period_ms, edits, run.generation, name_of(run.state), run.progress.fraction));
    }
    driver_ = driver_computed_ = {};
    ++frames_;
  }

  /// Seconds to sleep before the next frame. The device may be the processor that draws, too: while nobody touches the
  /// window it takes at most a quarter of the time, so that drawing without need does not slow the run.
  double rest(Pace pace) const {
    double period_s = 1.0 / 60;
    if (pace == Pace::running) period_s = std::max(1.0 / 30, 4 * last_draw_s_);
    if (pace == Pace::idle) period_s = 1.0 / 4;
    return std::max(0.0, period_s - milliseconds(Clock::now() - began_) / 1000);
  }

  /// "N frames, draw median A ms, 99 % B ms, most C ms" over what was drawn so far: at least a frame.
  std::string summary() const {
    std::vector<double> sorted = draw_ms_;
    std::sort(sorted.begin(), sorted.end());
    const auto at = [&](double part) {
      return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
    };
    return fmt::format("{} frames, draw median {:.1f} ms, 99 % {:.1f} ms, most {:.1f} ms", sorted.size(), at(0.5),
                       at(0.99), sorted.back());
  }

private:
  void write(const std::string& line) {
    lines_ << line << std::flush;
    if (!lines_) throw failed(file_.string(), "cannot be written", "", "choose another file for --frame-times");
  }

  bool keep_ = false;
  std::size_t frames_ = 0;
  double last_draw_s_ = 0;
  Clock::time_point began_{}, previous_{}, driver_began_{};
  Clock::duration driver_{}, driver_computed_{}, computed_before_{}, driver_computed_before_{}; ///< this frame's
  std::vector<double> draw_ms_; ///< each frame's, from its first event to its end: what the window itself costs
  std::filesystem::path file_;
  std::ofstream lines_;
};

/// The loop of one window, from its first frame to its last.
class Loop {
public:
  Loop(const Options& options, GlfwWindow& window, Workbench& workbench, Workspace& workspace, SessionKeeper& keeper)
      : options_(options), window_(window), workbench_(workbench), workspace_(workspace), keeper_(keeper),
        clock_(options.frames > 0 || !options.frame_times.empty(), options.frame_times) {
    limit_ = options.frames > 0 ? options.frames : options.screenshot.empty() ? 0 : frames_before_screenshot;
  }

  void run() {
    while (!done_) {
      frame();
      if (!done_) rest();
    }
    if (clock_.keeps()) fmt::print(stderr, "window: {}; {}\n", clock_.summary(), window_.renderer());
  }

private:
  void frame() {
    clock_.begin();
    window_.set_appearance(workbench_.setup().settings().theme, workbench_.setup().settings().text_size);
    window_.begin_frame();
    if (window_.take_activity()) last_touch_ = Clock::now();
    workbench_.update();
    Commands commands = workspace_.draw(workbench_);
    for (const std::string& file : window_.take_dropped()) commands.push_back(workspace_.dropped(file));
    if (window_.take_close_request()) commands.push_back(command::Quit{});
    window_.end_frame();
    workbench_.apply(commands); // before OpenGL draws, which may take longer than all else: an edit's run begins now
    done_ = workbench_.questions().quitting() || is_last_frame();
    clock_.driver();
    window_.draw_frame();
    clock_.own();
    int width = 0, height = 0;
    std::vector<unsigned char> screen;
    if (done_ && !options_.screenshot.empty()) screen = window_.read_back(width, height);
    clock_.driver();
    window_.present();
    clock_.own();
    edits_ += static_cast<std::size_t>(std::count_if(commands.begin(), commands.end(), changes_preset));
    if (workbench_.questions().take_reopen()) keeper_.reopen(workbench_);
    workbench_.offer_earlier(keeper_.has_earlier());
    keeper_.update(workbench_);
    window_.set_title(title(workbench_));
    clock_.end(workbench_.run().status(), edits_);
    if (!screen.empty()) image::write_png_bytes(options_.screenshot, width, height, screen);
  }

  bool is_last_frame() const {
    if (limit_ == 0 || clock_.frames() + 1 < static_cast<std::size_t>(limit_)) return false;
    if (workbench_.works_on_files()) return false; // runs to pin, from the command line
    const job::Status& status = workbench_.run().status();
    if (options_.until <= 0) return true;
    return is_over(status.state) || (options_.until < 1 && status.progress.fraction >= options_.until);
  }

  void rest() {
    const job::State state = workbench_.run().status().state;
    FrameClock::Pace pace = FrameClock::Pace::idle;
    if (Clock::now() - last_touch_ < hands_rest)
      pace = FrameClock::Pace::hands_on;
    else if ((!is_over(state) && state != job::State::paused) || !workbench_.tasks().empty() ||
             workbench_.balls().works())
      pace = FrameClock::Pace::running;
    if (const double seconds = clock_.rest(pace); seconds > 0) window_.wait(seconds);
  }

  const Options& options_;
  GlfwWindow& window_;
  Workbench& workbench_;
  Workspace& workspace_;
  SessionKeeper& keeper_;
  FrameClock clock_;
  Clock::time_point last_touch_{};
  std::size_t edits_ = 0; ///< so far, undo and redo too
  int limit_ = 0;         ///< frames to draw before closing; 0: until a person closes it
  bool done_ = false;
};

/// Returns the exit code of the first error, where nobody was there to read it in the window.
int report_errors(const Workbench& workbench, bool unattended) {
  int exit_code = 0;
  for (const Message& message : workbench.messages()) {
    if (!message.error) continue;
    fmt::print(stderr, "nephroid: {}\n", message.line);
    if (unattended && exit_code == 0) exit_code = static_cast<int>(message.kind);
  }
  return exit_code;
}

/// Where there is no display, a preset that cannot be read is said first: with one there, it would be the next thing in
/// the way.
std::unique_ptr<GlfwWindow> open_display(const Options& options) {
  try {
    return std::make_unique<GlfwWindow>("Nephroid", options.size);
  } catch (const Error&) {
    if (!options.files.empty() && !is_history(options.files.front()) &&
        kind_of(options.files.front()) != FileKind::scene) {
      refuse_other_kinds(options.files.front());
      preset::read_with_sweep(options.files.front(), options.overrides);
    }
    throw;
  }
}

} // namespace

int open_window(const Options& options) {
  check_layout(options.layout);
  if (const std::string ending = options.screenshot.extension().string();
      !options.screenshot.empty() && lower_case(ending) != ".png")
    throw bad_input("--screenshot", "a picture of the window cannot be written as \"" + ending + "\"",
                    "expected a file .png");
  const std::string cache_note = compute::prepare_kernel_cache(); // before OpenGL's and our own threads start
  if (!cache_note.empty()) fmt::print(stderr, "note: {}\n", cache_note);
  const std::unique_ptr<GlfwWindow> window = open_display(options);
  compute::DeviceOptions device;
  device.selector = options.device;
  device.kernels = options.kernels;
  DeviceRuns runs(device, take_facts);
  Workbench workbench(runs);
  if (!cache_note.empty()) workbench.add_note(cache_note);
  if (const std::filesystem::path folder = state_folder(); keeps_sessions(options) && !folder.empty())
    workbench.remember({folder / "recent.json", cache_folder("thumbnails")});
  const std::unique_ptr<SessionKeeper> keeper = make_keeper(options, workbench);
  keeper->load_settings(workbench);
  open_first(workbench, options);
  begin_session(workbench, *keeper, options);
  {
    Workspace workspace(options.layout);
    Loop(options, *window, workbench, workspace, *keeper).run();
    keeper->close(workbench);
    workbench.finish_files();
    window->shut_down_back_ends(); // before the panels: their textures belong to the renderer
  }
  return report_errors(workbench, !options.screenshot.empty());
}

} // namespace nephroid::ui
