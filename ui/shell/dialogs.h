// SPDX-License-Identifier: Apache-2.0
// The dialogs: which file to open or to save, and what to do with unsaved changes. Which one is open is the workbench's question().
#pragma once
#include "preset/read.h"
#include "ui/shell/file_list.h"
#include "ui/state/commands.h"
#include "ui/widgets/widgets.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::ui {

class Workbench;

class Dialogs {
public:
  void draw(Workbench& workbench, Commands& commands);
  const FileList& files() const { return files_; }
  /// For tests: the middle of a widget on the screen.
  std::optional<std::array<double, 2>> place_of(const std::string& widget) const { return places_.of(widget); }

private:
  void begin(Workbench& workbench);
  void begin_files(Workbench& workbench);
  bool pick_file();
  void draw_open(Commands& commands);
  void draw_open_history(Commands& commands);
  void draw_save(Commands& commands);
  void draw_unsaved(const Workbench& workbench, Commands& commands);

  Question shown_ = Question::none;
  std::string name_;                           ///< what the text field holds
  std::vector<preset::ShippedPreset> shipped_; ///< read when the dialog opens
  FileList files_;
  std::string parent_; ///< that a saved preset may keep; empty: none
  bool keep_parent_ = true;
  WidgetPlaces places_;
};

} // namespace nephroid::ui
