// SPDX-License-Identifier: Apache-2.0
// Keeps the window's session and settings in files while it is open, so that a window that was killed loses a second at
// most; finds the sessions that earlier windows left. Each window has a folder of its own, which it holds locked:
// several windows may be open.
#pragma once
#include "base/file_lock.h"
#include "ui/state/session.h"
#include "ui/state/workbench.h"

namespace nephroid::ui {

class SessionKeeper {
public:
  using Clock = std::chrono::steady_clock;

  /// folder: state_folder(), or another for tests; empty: nothing is kept and nothing found. Throws failed where it
  /// cannot be made.
  explicit SessionKeeper(std::filesystem::path folder);

  /// The settings that the last window kept; where they cannot be read, those a window begins with and a message.
  void load_settings(Workbench& workbench) const;
  /// Whether an earlier window was not closed by a person, and when its session was last kept ("2026-11-22 03:12:05");
  /// empty: none.
  std::string killed_session() const;
  /// Whether there is a session to go back to, of a window that was closed or not.
  bool has_earlier() const { return !earlier_.empty(); }
  /// Opens the newest earlier session, of a killed window first, and holds its lock until this window's own session has
  /// all of it. What another window opened meanwhile becomes a message; so does what cannot be read, which is kept
  /// under another name.
  void reopen(Workbench& workbench);

  /// Once a frame, returns at once: at most once a second writes what changed, in the background.
  void update(Workbench& workbench, Clock::time_point now = Clock::now());
  /// The last word of a window that a person closes; waits for the disk.
  void close(Workbench& workbench);

private:
  struct Earlier {
    std::filesystem::path folder;
    bool closed = false;
    std::filesystem::file_time_type kept;
    FileLock lock = {}; ///< while they are looked for
  };
  /// What there is to write.
  struct Work {
    Session session;
    std::vector<PinnedRun> pins; ///< of session.pins, in their order
    Settings settings;
    std::filesystem::path replaces; ///< an earlier session that is removed when this one is kept; empty: none
    FileLock lock;                  ///< its
  };
  struct Writer;
  void find_earlier();
  Work work_of(const Workbench& workbench) const;
  bool is_kept(const Work& work) const;
  /// error: empty where all of newest_ is kept.
  void written(Workbench& workbench, const std::string& error);
  void say_once(Workbench& workbench, const std::string& error);

  std::filesystem::path folder_;     ///< of all sessions; empty: nothing is kept
  std::shared_ptr<Writer> writer_;   ///< shared with the task that writes
  std::vector<Earlier> earlier_;     ///< the one to go back to first comes first
  std::filesystem::path taken_over_; ///< an earlier session that is not needed once this one is kept
  FileLock taken_over_lock_;         ///< its
  std::optional<Work> newest_;       ///< what was written last, or is being written
  TaskKey writes_;
  std::string last_error_; ///< the error that was said last
  Clock::time_point next_{};
};

} // namespace nephroid::ui
