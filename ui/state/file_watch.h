// SPDX-License-Identifier: Apache-2.0
// Watches the preset's file and those that it names. When another program writes one, the preset or its run follows. A
// separate thread looks for changes, so no frame waits for a disk.
#pragma once
#include "preset/preset.h"
#include "ui/state/sweep_queue.h"

#include <condition_variable>
#include <thread>

namespace nephroid::ui {

class FileWatch {
public:
  FileWatch();
  /// Watches the files of this preset; null: none. just_read: all of them were just read, so changes until now are
  /// known; later changes are reported, however late the thread looks.
  void watch(std::shared_ptr<const preset::Preset> preset, bool just_read);
  /// The files that have changed since the last call and are not being written any more. A file that is gone counts
  /// once it is back.
  std::vector<std::filesystem::path> take_changed();

private:
  /// When a file was written, and its size in bytes; nothing where it does not exist.
  using Stamp = std::optional<std::pair<std::filesystem::file_time_type, std::uintmax_t>>;
  struct Seen {
    Stamp known; ///< the state that was reported or read
    Stamp last;  ///< the state at the check before: a file that is being written differs from check to check
  };
  void poll(const std::stop_token& stop);
  static Stamp stamp_of(const std::filesystem::path& file);

  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::shared_ptr<const preset::Preset> preset_;           ///< the newest preset to watch
  bool is_new_ = false;                                    ///< the thread has not taken preset_ yet
  std::optional<std::filesystem::file_time_type> read_at_; ///< when its files were read, where they were
  std::vector<std::filesystem::path> found_;
  std::jthread thread_; ///< last: it uses the other members
};

class DocumentFiles {
public:
  /// All outlive the object.
  DocumentFiles(Document& document, RunInHand& run, const SweepQueue& sweep, Messages& messages)
      : document_(document), run_(run), sweep_(sweep), messages_(messages) {}
  /// Called once a frame. Waits for the disk only to read a preset that has changed.
  void update();
  void carry_out(const command::ReloadPreset&);

private:
  void follow_own_file();

  Document& document_;
  RunInHand& run_;
  const SweepQueue& sweep_;
  Messages& messages_;
  FileWatch watch_;
  std::shared_ptr<const preset::Preset> watched_, opened_; ///< whose files are watched; the same as it was opened
};

} // namespace nephroid::ui
