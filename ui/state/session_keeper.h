// SPDX-License-Identifier: Apache-2.0
// Keeps the window's session and settings in files while it is open, so that a killed window loses a second at most;
// finds the sessions that earlier windows left. Each window has its own folder, which it holds locked: several windows
// may be open.
#pragma once
#include "base/files.h"
#include "ui/state/workbench.h"

namespace nephroid::ui {

class SessionKeeper {
public:
  using Clock = std::chrono::steady_clock;

  /// folder: state_folder(), or another for tests; empty: nothing is kept and nothing found. Throws failed where it
  /// cannot be made.
  explicit SessionKeeper(std::filesystem::path folder);

  /// Loads the settings that the last window kept. Where they cannot be read, the defaults and a message take their
  /// place.
  void load_settings(Workbench& workbench) const;
  /// When the session of a window that no person closed was last kept ("2026-11-22 03:12:05"); empty: there is none.
  std::string killed_session() const;
  /// Whether there is a session to reopen, of a closed or a killed window.
  bool has_earlier() const { return !earlier_.empty(); }
  /// Opens the newest earlier session, a killed window's first, and holds its lock until this window's own session has
  /// all of it. Where another window opened it meanwhile, a message says so. A session that cannot be read is kept
  /// under another name, also with a message.
  void reopen(Workbench& workbench);

  /// Called once a frame, returns at once: writes what changed, in the background, at most once a second.
  void update(Workbench& workbench, Clock::time_point now = Clock::now());
  /// Writes the session of a window that a person closes; waits for the disk.
  void close(Workbench& workbench);

private:
  struct Earlier {
    std::filesystem::path folder;
    bool closed = false;
    std::filesystem::file_time_type kept;
    FileLock lock = {}; ///< held while the sessions are looked for
  };
  struct Work {
    Session session;
    std::vector<PinnedRun> pins; ///< session.pins, in their order
    WindowSettings settings;
    std::filesystem::path replaces; ///< an earlier session, removed when this one is kept; empty: none
    FileLock lock;                  ///< that session's lock
  };
  struct Writer;
  void find_earlier();
  Work work_of(const Workbench& workbench) const;
  bool is_kept(const Work& work) const;
  /// error: empty where all of newest_ is kept.
  void written(Workbench& workbench, const std::string& error);
  void say_once(Workbench& workbench, const std::string& error);

  std::filesystem::path folder_;     ///< the folder of all sessions; empty: nothing is kept
  std::shared_ptr<Writer> writer_;   ///< shared with the writing task
  std::vector<Earlier> earlier_;     ///< the one to reopen first comes first
  std::filesystem::path taken_over_; ///< an earlier session, not needed once this one is kept
  FileLock taken_over_lock_;
  std::optional<Work> newest_; ///< what was written last, or is being written
  TaskKey writes_;
  std::string last_error_; ///< that a message said last
  Clock::time_point next_{};
};

} // namespace nephroid::ui
