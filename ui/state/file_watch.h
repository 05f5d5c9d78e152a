// SPDX-License-Identifier: Apache-2.0
// The preset's file and those that it names, where another program writes them: the preset or its run follows. A thread
// of its own looks for changes: no frame waits for a disk.
#pragma once
#include "preset/preset.h"
#include "ui/state/document.h"
#include "ui/state/sweep_queue.h"

#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

namespace nephroid::ui {

/// Tells which files of a preset were changed.
class FileWatch {
public:
  FileWatch();
  /// The files of this preset from now on; null: none. just_read: what was written until now is known, as they were all
  /// read; what is written from now on is not, however late the thread looks.
  void watch(std::shared_ptr<const preset::Preset> preset, bool just_read);
  /// Those that were changed since the last call, and are not being written any more. A file that is gone is none,
  /// until it is back.
  std::vector<std::filesystem::path> take_changed();

private:
  /// When a file was written, and its bytes; nothing where it is not there.
  using Stamp = std::optional<std::pair<std::filesystem::file_time_type, std::uintmax_t>>;
  struct Seen {
    Stamp known; ///< what nobody needs to be told of any more
    Stamp last;  ///< at the look before: a file that is being written differs from look to look
  };
  void poll(const std::stop_token& stop);
  static Stamp stamp_of(const std::filesystem::path& file);

  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::shared_ptr<const preset::Preset> preset_;           ///< the newest that was asked for,
  bool is_new_ = false;                                    ///< which the thread has not taken yet,
  std::optional<std::filesystem::file_time_type> read_at_; ///< and when its files were read, where they were
  std::vector<std::filesystem::path> found_;
  std::jthread thread_; ///< last: it uses the others
};

/// Takes over what was changed.
class DocumentFiles {
public:
  /// All outlive it.
  DocumentFiles(Document& document, RunInHand& run, const SweepQueue& sweep, Messages& messages)
      : document_(document), run_(run), sweep_(sweep), messages_(messages) {}
  /// Once a frame. Never waits for the disk but to read a preset that was changed.
  void update();
  void carry_out(const command::ReloadPreset&);

private:
  void follow_own_file();

  Document& document_;
  RunInHand& run_;
  const SweepQueue& sweep_;
  Messages& messages_;
  FileWatch watch_;
  std::shared_ptr<const preset::Preset> watched_, watched_from_; ///< whose files are watched, and as it was opened
};

} // namespace nephroid::ui
