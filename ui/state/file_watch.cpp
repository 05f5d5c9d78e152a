// SPDX-License-Identifier: Apache-2.0
#include "ui/state/file_watch.h"

#include "preset/read.h"

namespace nephroid::ui {

FileWatch::FileWatch() : thread_([this](const std::stop_token& stop) { poll(stop); }) {}

void FileWatch::watch(std::shared_ptr<const preset::Preset> preset, bool just_read) {
  const std::lock_guard lock(mutex_);
  preset_ = std::move(preset);
  is_new_ = true;
  if (!just_read) return;
  read_at_ = std::filesystem::file_time_type::clock::now();
  found_.clear();
}

std::vector<std::filesystem::path> FileWatch::take_changed() {
  const std::lock_guard lock(mutex_);
  return std::exchange(found_, {});
}

FileWatch::Stamp FileWatch::stamp_of(const std::filesystem::path& file) {
  std::error_code error;
  const auto time = std::filesystem::last_write_time(file, error);
  if (error) return {};
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  if (error) return {};
  return std::pair{time, bytes};
}

void FileWatch::poll(const std::stop_token& stop) {
  constexpr std::chrono::milliseconds look_every{300};
  std::map<std::filesystem::path, Seen> seen;
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    const auto preset = preset_;
    const bool is_new = std::exchange(is_new_, false);
    const auto read_at = std::exchange(read_at_, std::nullopt);
    if (read_at) seen.clear();
    lock.unlock();
    if (is_new) {
      std::map<std::filesystem::path, Seen> now;
      if (preset)
        for (const auto& file : preset::files_of(*preset)) {
          const auto before = seen.find(file);
          const Stamp stamp = stamp_of(file);
          const bool is_newer = read_at && stamp && stamp->first > *read_at;
          now[file] = before == seen.end() ? Seen{is_newer ? Stamp{} : stamp, stamp} : before->second;
        }
      seen = std::move(now);
    }
    std::vector<std::filesystem::path> found;
    for (auto& [file, of_file] : seen) {
      const Stamp stamp = stamp_of(file);
      const bool rests = stamp == std::exchange(of_file.last, stamp);
      if (!stamp || !rests || stamp == of_file.known) continue;
      of_file.known = stamp;
      found.push_back(file);
    }
    lock.lock();
    found_.insert(found_.end(), found.begin(), found.end());
    changed_.wait_for(lock, stop, look_every, [] { return false; });
  }
}

void DocumentFiles::carry_out(const command::ReloadPreset&) {
  const preset::Preset* preset = document_.preset();
  if (!preset || !document_.take_over(preset::read_with_sweep(preset->source)))
    messages_.note("the file has what is shown");
}

/// Follows the preset's file, which another program wrote.
void DocumentFiles::follow_own_file() {
  const std::filesystem::path file = document_.preset()->source;
  try {
    preset::WithSweep read = preset::read_with_sweep(file.string());
    if (!document_.modified()) {
      if (document_.take_over(std::move(read)))
        messages_.note(file.filename().string() + " was changed on disk and is taken over");
    } else if (read.preset != *document_.edits()->in_file() || read.sweep != document_.edits()->sweep())
      messages_.error(file.string() + ": another program changed this file, and the preset has edits that are not "
                                      "saved; save them under another name, or take the preset from its file (File)");
  } catch (const std::exception& error) {
    messages_.error(error);
  }
}

void DocumentFiles::update() {
  const UndoStack* edits = document_.edits();
  if (const auto& now = edits ? edits->in_file() : nullptr; now != watched_) {
    watched_ = now;
    const auto opened = edits ? edits->state().opened : nullptr;
    watch_.watch(now, std::exchange(opened_, opened) != opened);
  }
  const std::vector<std::filesystem::path> changed = watch_.take_changed();
  if (changed.empty() || !edits) return;
  bool scene_changed = false;
  for (const std::filesystem::path& file : changed) {
    if (file == std::filesystem::path(document_.preset()->source)) {
      follow_own_file();
      continue;
    }
    scene_changed = true;
    messages_.note(file.filename().string() + " was changed on disk: the run begins again" +
                   (sweep_.active() ? " when the sweep is over" : ""));
  }
  if (scene_changed) run_.start_with_new_files(*edits);
}

} // namespace nephroid::ui
