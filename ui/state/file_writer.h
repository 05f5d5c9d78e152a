// SPDX-License-Identifier: Apache-2.0
// Writes the window's files, mostly in the background: presets, pictures, reports, results of runs, imported scenes,
// the list of recent files.
#pragma once
#include "ui/state/recent_files.h"
#include "ui/state/window_state.h"

namespace nephroid::ui {

class FileWriter {
public:
  /// All arguments outlive the object.
  FileWriter(Document& document, const RunInHand& run, const Comparing& comparing, const ViewState& view_state,
             Questions& questions, Services& services)
      : document_(document), run_(run), comparing_(comparing), view_state_(view_state), questions_(questions),
        services_(services) {}
  const RecentFiles& recent() const { return recent_; }
  /// Sets where presets that are opened or saved are remembered.
  void remember(RecentFiles recent) { recent_ = std::move(recent); }
  void add_recent(const std::filesystem::path& file);
  /// Imports another program's scene: makes a preset in a new folder beside it and opens that.
  void import_scene(const std::filesystem::path& file);
  bool busy() const { return services_.tasks.busy(writes_); }
  void update();

  void carry_out(const command::SavePreset& c);
  void carry_out(const command::SavePicture& c);
  void carry_out(const command::OpenResult& c);
  void carry_out(const command::WriteReport& c);

private:
  PictureToSave shown_picture() const;
  void save_thumbnail(const std::filesystem::path& preset);
  void save(const std::filesystem::path& file, std::function<std::string()> write);

  Document& document_;
  const RunInHand& run_;
  const Comparing& comparing_;
  const ViewState& view_state_;
  Questions& questions_;
  Services& services_;
  RecentFiles recent_;
  TaskKey writes_, recent_writes_;
};

} // namespace nephroid::ui
