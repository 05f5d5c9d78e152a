// SPDX-License-Identifier: Apache-2.0
#include "ui/state/session_keeper.h"

#include "base/files.h"
#include "measure/run_files.h"
#include "ui/state/run_record.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <fcntl.h>

#include <algorithm>
#include <ctime>

namespace nephroid::ui {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

constexpr auto period = 1s;         ///< between two writes
constexpr auto after_failure = 10s; ///< a full disk is not tried every second
constexpr std::size_t most_earlier = 10;
constexpr std::uintmax_t most_bytes = 64u << 20; ///< of a session: a person may have put another file there
constexpr const char *session_name = "session.json", *settings_name = "settings.json", *lock_name = "lock";

/// Locks the file; null where it is locked, or cannot be made.
FileLock lock_file(const fs::path& file) {
  return lock_open_file(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600));
}

std::string read_limited(const fs::path& file) {
  std::error_code ignored;
  if (fs::file_size(file, ignored) > most_bytes && !ignored)
    throw bad_input(file.string(), "the file is larger than any that a window writes");
  return read_file(file);
}

/// The header of the session's file. One that cannot be read counts as a killed window's: the rest deserves a message.
SessionHeader header_of(const fs::path& file) {
  try {
    return parse_session_header(read_limited(file), file.string());
  } catch (const std::exception&) {
    return {.closed = false, .has_preset = true};
  }
}

/// Writes the folder whole or not at all: a folder that exists counts as kept.
void write_pin(const fs::path& folder, const PinnedRun& run) {
  try {
    write_run_folder(folder, run, {}, false);
    if (!is_there(folder / "history.csv")) write_file_whole(folder / "history.csv", measure::to_csv(*run.history));
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    throw;
  }
}

} // namespace

/// The files of this window's session, whose lock it holds.
struct SessionKeeper::Writer {
  fs::path folder; ///< the folder of all sessions
  fs::path own;    ///< the folder of this window's session
  FileLock lock;
  SessionText text;

  /// Called on any thread, one call at a time. Returns an error's text; empty where all was written.
  std::string write(const Work& work);
};

SessionKeeper::SessionKeeper(fs::path folder) : folder_(std::move(folder)) {
  if (folder_.empty()) return;
  writer_ = std::make_shared<Writer>();
  writer_->folder = folder_;
  fs::path& own = writer_->own;
  const fs::path sessions = folder_ / "sessions";
  const std::string name = fmt::format("{:%Y%m%d-%H%M%S}-{}", fmt::localtime(std::time(nullptr)), ::getpid());
  std::error_code error;
  fs::create_directories(sessions, error);
  for (int number = 1; !error; ++number) {
    own = sessions / (number == 1 ? name : fmt::format("{}-{}", name, number));
    if (fs::create_directory(own, error)) break; // a new one
  }
  if (!error) writer_->lock = lock_file(own / lock_name);
  if (!writer_->lock) {
    const std::string reason = error ? error.message() : "its lock cannot be made";
    folder_.clear();
    throw failed(own.string(), "the window's session cannot be kept here: " + reason, "",
                 "set XDG_STATE_HOME to a folder that can be written to");
  }
  find_earlier();
}

void SessionKeeper::find_earlier() {
  std::error_code error;
  std::vector<fs::path> folders;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_ / "sessions", error))
    if (entry.path() != writer_->own && entry.path().extension() != ".unreadable") folders.push_back(entry.path());
  for (const fs::path& folder : folders) {
    FileLock held = lock_file(folder / lock_name);
    if (!held) continue; // its window is still open
    const fs::file_time_type kept = fs::last_write_time(folder / session_name, error);
    const SessionHeader header = error ? SessionHeader{} : header_of(folder / session_name);
    if (header.has_preset)
      earlier_.push_back({folder, header.closed, kept, std::move(held)});
    else
      fs::remove_all(folder, error); // no preset was ever opened
  }
  std::sort(earlier_.begin(), earlier_.end(),
            [](const Earlier& a, const Earlier& b) { return a.closed != b.closed ? b.closed : a.kept > b.kept; });
  // The newest of the closed windows' sessions is enough.
  std::size_t closed = 0;
  std::erase_if(earlier_, [&](const Earlier& one) {
    const bool old = one.closed && closed++ > 0;
    if (old) fs::remove_all(one.folder, error);
    return old;
  });
  for (; earlier_.size() > most_earlier; earlier_.pop_back()) fs::remove_all(earlier_.back().folder, error);
  for (Earlier& earlier : earlier_) earlier.lock.reset(); // so that another window can offer them, too
}

void SessionKeeper::load_settings(Workbench& workbench) const {
  const fs::path file = folder_ / settings_name;
  if (folder_.empty() || !is_there(file)) return;
  try {
    workbench.setup().set_settings(parse_settings(read_limited(file), file.string()));
  } catch (const std::exception& error) {
    workbench.apply({command::Report{error.what()}});
  }
}

std::string SessionKeeper::killed_session() const {
  if (earlier_.empty() || earlier_.front().closed) return {};
  const auto age = fs::file_time_type::clock::now() - earlier_.front().kept;
  const auto at = std::chrono::system_clock::now() - std::chrono::duration_cast<std::chrono::seconds>(age);
  return fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::localtime(std::chrono::system_clock::to_time_t(at)));
}

void SessionKeeper::reopen(Workbench& workbench) {
  if (earlier_.empty()) return;
  const fs::path folder = earlier_.front().folder;
  earlier_.erase(earlier_.begin());
  FileLock held = lock_file(folder / lock_name);
  if (!held) return workbench.apply({command::Report{"the earlier session was opened in another window"}});
  try {
    workbench.restore(parse_session(read_limited(folder / session_name), (folder / session_name).string()), folder);
    taken_over_ = folder;
    taken_over_lock_ = std::move(held);
  } catch (const std::exception& error) {
    std::error_code ignored;
    const fs::path kept = folder.string() + ".unreadable";
    fs::rename(folder, kept, ignored);
    workbench.apply({command::Report{fmt::format("{}; what there is of it lies in {}", error.what(), kept.string())}});
  }
}

SessionKeeper::Work SessionKeeper::work_of(const Workbench& workbench) const {
  Work work;
  if (workbench.edits()) work.session.edits = workbench.edits()->state();
  work.session.view_state = workbench.view_state();
  work.pins = workbench.comparing().pinned().all();
  for (const PinnedRun& run : work.pins)
    work.session.pins.push_back(
        {run.is_run() ? fmt::format("pin-{}", run.id) : run.file.string(), run.name, run.colour, run.shown});
  work.settings = workbench.setup().settings();
  if (workbench.works_on_files()) return work; // the pins of the earlier session may still be being read
  work.replaces = taken_over_;
  work.lock = taken_over_lock_;
  return work;
}

bool SessionKeeper::is_kept(const Work& work) const {
  return newest_ && newest_->replaces == work.replaces && newest_->session == work.session &&
         newest_->settings == work.settings;
}

std::string SessionKeeper::Writer::write(const Work& work) {
  try {
    for (std::size_t i = 0; i < work.pins.size(); ++i)
      if (const fs::path pin = own / work.session.pins[i].folder;
          work.pins[i].is_run() && !is_there(pin / "history.csv"))
        write_pin(pin, work.pins[i]);
    write_file_whole(own / session_name, text.of(work.session));
    if (const std::string settings = to_json(work.settings);
        !is_there(folder / settings_name) || read_file(folder / settings_name) != settings)
      write_file_whole(folder / settings_name, settings);
    std::error_code ignored;
    if (!work.replaces.empty()) fs::remove_all(work.replaces, ignored);
    return {};
  } catch (const std::exception& error) {
    return error.what();
  }
}

void SessionKeeper::say_once(Workbench& workbench, const std::string& error) {
  if (error == std::exchange(last_error_, error)) return;
  workbench.apply({command::Report{
      error + "; the window goes on, but would lose its edits if it ended now: save the preset elsewhere"}});
}

void SessionKeeper::written(Workbench& workbench, const std::string& error) {
  if (error.empty()) {
    last_error_.clear();
    if (!newest_->replaces.empty()) {
      taken_over_.clear();
      taken_over_lock_.reset();
      newest_->lock.reset();
    }
    return;
  }
  newest_.reset();
  next_ = Clock::now() + after_failure;
  say_once(workbench, error);
}

void SessionKeeper::update(Workbench& workbench, Clock::time_point now) {
  if (folder_.empty() || now < next_ || workbench.tasks().busy(writes_)) return;
  next_ = now + period;
  Work work = work_of(workbench);
  if (is_kept(work)) return;
  newest_ = std::move(work);
  workbench.tasks().start(
      writes_, {"keeping the session", TaskKind::write},
      [writer = writer_, work = *newest_] { return writer->write(work); },
      [this, &workbench](const std::string& error) { written(workbench, error); });
}

void SessionKeeper::close(Workbench& workbench) {
  if (folder_.empty()) return;
  workbench.finish(writes_);
  Work work = work_of(workbench);
  work.session.closed = true;
  if (const std::string error = writer_->write(work); !error.empty()) say_once(workbench, error);
}

} // namespace nephroid::ui
