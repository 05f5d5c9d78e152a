// SPDX-License-Identifier: Apache-2.0
// The files of a folder to choose from: folders first, then those of the wanted kinds. A folder is read away from the
// window's thread, because its disk may be slow or gone.
#pragma once
#include "ui/state/tasks.h"
#include "ui/widgets/widgets.h"

namespace nephroid::ui {

class FileList : public Placed {
public:
  struct Entry {
    std::filesystem::path path;
    bool is_folder = false;
    std::uintmax_t bytes = 0;
  };
  enum class Picked { nothing, file, opened }; ///< one click on a file; a double click on it, or Enter

  /// endings: of files, with their dots, lower case; empty: all files. tasks: outlives the list.
  void begin(std::filesystem::path folder, std::vector<std::string> endings, TaskQueue& tasks);
  /// The folder's name, and its entries in an area of this size.
  Picked draw(float width, float height);
  /// What was picked last.
  const std::filesystem::path& picked() const { return picked_; }
  const std::filesystem::path& folder() const { return folder_; }
  /// What was read; for tests.
  const std::vector<Entry>& entries() const { return entries_; }
  /// Why there is nothing, or that there is more; empty: neither.
  const std::string& note() const { return note_; }

private:
  struct Read {
    std::vector<Entry> entries;
    std::string error;
    bool cut = false; ///< there are more
  };
  static Read read(const std::filesystem::path& folder, const std::vector<std::string>& endings);
  void go(std::filesystem::path folder);

  std::filesystem::path folder_, picked_;
  std::vector<std::string> endings_;
  std::vector<Entry> entries_;
  std::string note_;
  TaskQueue* tasks_ = nullptr;
  TaskKey reading_;
};

} // namespace nephroid::ui
