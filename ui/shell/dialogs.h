// SPDX-License-Identifier: Apache-2.0
// The dialogs: which file to open or to save, and what to do with unsaved changes. Which one is open is the workbench's
// question().
#pragma once
#include "preset/read.h"
#include "ui/state/commands.h"
#include "ui/state/tasks.h"
#include "ui/widgets/widgets.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace nephroid::ui {

/// The files of a folder to choose from: folders first, then those of the wanted kinds. A folder is read away from the
/// window's thread, because its disk may be slow or gone.
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

class Workbench;

class Dialogs : public Placed {
public:
  void draw(Workbench& workbench, Commands& commands);
  const FileList& files() const { return files_; }

private:
  void begin(Workbench& workbench);
  bool pick_file();
  void draw_open(Commands& commands);
  void draw_open_file(Commands& commands);
  void draw_save(Commands& commands);
  void draw_unsaved(const Workbench& workbench, Commands& commands);

  Question shown_ = Question::none;
  std::string name_;                           ///< what the text field holds
  std::vector<preset::ShippedPreset> shipped_; ///< read when the dialog opens
  FileList files_;
  std::string parent_; ///< that a saved preset may keep; empty: none
  bool keep_parent_ = true;
};

} // namespace nephroid::ui
