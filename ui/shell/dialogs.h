// SPDX-License-Identifier: Apache-2.0
// The dialogs: which file to open or to save, and what to do with unsaved changes. Which one is open is the workbench's
// question().
#pragma once
#include "preset/read.h"
#include "ui/widgets/file_list.h"

namespace nephroid::ui {

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
  void draw_record(Commands& commands);
  void draw_unsaved(const Workbench& workbench, Commands& commands);

  Question shown_ = Question::none;
  std::string name_;                           ///< what the text field holds
  std::vector<preset::ShippedPreset> shipped_; ///< read when the dialog opens
  FileList files_;
  std::string parent_; ///< that a saved preset may keep; empty: none
  bool keep_parent_ = true;
  std::uint64_t said_before_ = 0; ///< Message::said of the last one before the dialog was opened
};

} // namespace nephroid::ui
