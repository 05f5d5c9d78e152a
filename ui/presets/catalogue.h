// SPDX-License-Identifier: Apache-2.0
// What the panel "Presets" lists: every shipped preset and the files that were opened lately, read away from the
// window's thread; which of them a search finds, and in which order; and their small pictures.
#pragma once
#include "ui/state/recent_files.h"
#include "ui/state/tasks.h"
#include "ui/widgets/picture_texture.h"

namespace nephroid::ui {

struct RequiredFile {
  std::string name;
  bool there = true;
};

struct CatalogueEntry {
  std::filesystem::path file;
  std::string name; ///< a shipped preset's, else the file's
  bool shipped = true;
  std::int64_t time = 0;           ///< when it was opened last, else when the file was written; seconds since 1970
  std::filesystem::path thumbnail; ///< need not be there
  std::string problem = {};        ///< why it cannot be read; then there is nothing of what follows
  std::string title = {}, description = {}, engine = {};
  std::array<int, 2> resolution{0, 0};
  std::string stop = {}; ///< "64 passes"
  std::size_t runs = 1, frames = 1;
  std::vector<RequiredFile> needs = {};
};

struct CatalogueFilter {
  std::string words;  ///< each has to be in name, title, description or engine, in whatever case
  std::string engine; ///< empty: all
  bool newest_first = false;
};

/// Indices of the entries that pass, in their order.
std::vector<std::size_t> matches(const std::vector<CatalogueEntry>& entries, const CatalogueFilter& filter);

class Catalogue {
public:
  /// Once a frame, returns at once. Reads again where other files were opened lately.
  void follow(const RecentFiles& recent, TaskQueue& tasks);
  /// Reads again with the next follow(): files may have changed.
  void read_again() { stale_ = true; }
  const std::vector<CatalogueEntry>& entries() const { return entries_; }
  /// Rises with every reading.
  std::size_t readings() const { return readings_; }

private:
  bool stale_ = true;
  std::vector<RecentFile> recent_; ///< when the newest reading began
  std::vector<CatalogueEntry> entries_;
  std::size_t readings_ = 0;
  TaskKey reading_;
};

/// Small pictures of presets, read away from the window's thread when they come into sight. One that is missing or
/// broken is known as such and not read again.
class Thumbnails {
public:
  /// Once a frame: reads what was asked for.
  void update(TaskQueue& tasks);
  /// Null where there is no picture, or none yet: then it is asked for.
  const PictureTexture* of(const std::filesystem::path& file);
  /// Reads every file again that is asked for: they may have changed.
  void read_again() { stale_ = true; }
  bool busy(const TaskQueue& tasks) const { return tasks.busy(reading_) || !wanted_.empty(); }

private:
  struct Pixels {
    std::string file;
    int width = 0, height = 0; ///< 0: there is no such picture
    std::vector<unsigned char> rgba8;
  };
  static Pixels read(const std::string& file);

  bool stale_ = false;
  std::map<std::string, std::unique_ptr<PictureTexture>> pictures_; ///< null: there is none
  std::vector<std::string> wanted_;
  TaskKey reading_;
};

} // namespace nephroid::ui
