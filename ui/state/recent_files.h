// SPDX-License-Identifier: Apache-2.0
// The preset files that were opened lately, over many sessions, and where presets' thumbnails are. The list is one
// small JSON file. Where it is missing, cut or written by another program, the list is empty, and one note says so.
#pragma once
#include "image/display.h"
#include "job/job.h"

namespace nephroid::ui {

struct RecentFile {
  std::string file;        ///< an absolute path
  std::int64_t opened = 0; ///< when, in seconds since 1970
  bool operator==(const RecentFile&) const = default;
};

class RecentFiles {
public:
  static constexpr std::size_t limit = 30; ///< the most files kept

  /// Remembers nothing beyond the session.
  RecentFiles() = default;
  /// list: the file of the list; its folder is made when needed. thumbnails: the folder of thumbnails. Either may be
  /// empty.
  RecentFiles(std::filesystem::path list, std::filesystem::path thumbnails);

  /// The files, the newest first.
  const std::vector<RecentFile>& all() const { return files_; }
  /// Returns once why the list is empty; empty where nothing went wrong.
  std::string take_note() { return std::exchange(note_, {}); }
  void add(const std::filesystem::path& file, std::int64_t now);
  /// Returns a function that writes the list as it is now. It throws failed.
  std::function<void()> writer() const;
  /// The folder of thumbnails; empty: none are kept.
  const std::filesystem::path& thumbnails() const { return thumbnails_; }

private:
  std::filesystem::path list_, thumbnails_;
  std::vector<RecentFile> files_;
  std::string note_;
};

/// The thumbnail of a preset's file: presets/thumbnails/NAME.jpg for a shipped one, else a path in this folder of
/// thumbnails, where a file need not exist. Empty where there can be none.
std::filesystem::path thumbnail_of(const std::filesystem::path& preset, const std::filesystem::path& thumbnails);

/// Writes a small copy of the picture at this exposure as PNG; makes the folder. Throws failed.
void write_thumbnail(const std::filesystem::path& file, const job::Picture& picture, const image::Display& display,
                     double exposure_stops);

/// The largest size of a thumbnail in pixels.
inline constexpr int thumbnail_width = 128, thumbnail_height = 96;

} // namespace nephroid::ui
