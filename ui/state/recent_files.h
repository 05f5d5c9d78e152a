// SPDX-License-Identifier: Apache-2.0
// The preset files that were opened lately, over many sessions, and where the small pictures of presets are. The list
// is one small JSON file, which may be missing, cut or somebody else's: then it is empty, and one note says so.
#pragma once
#include "job/job.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::ui {

struct RecentFile {
  std::string file;        ///< an absolute path
  std::int64_t opened = 0; ///< when, in seconds since 1970
  bool operator==(const RecentFile&) const = default;
};

class RecentFiles {
public:
  static constexpr std::size_t limit = 30; ///< files kept

  /// Nothing is remembered beyond the session.
  RecentFiles() = default;
  /// list: the file of the list, in a folder that is made when needed. thumbnails: the folder of pictures; either may
  /// be empty.
  RecentFiles(std::filesystem::path list, std::filesystem::path thumbnails);

  /// The newest first.
  const std::vector<RecentFile>& all() const { return files_; }
  /// Why the list is empty; empty where nothing went wrong. Once.
  std::string take_note() { return std::exchange(note_, {}); }
  /// Puts a file first.
  void add(const std::filesystem::path& file, std::int64_t now);
  /// Writes the list as it is now. Throws failed.
  std::function<void()> writer() const;
  /// The folder of pictures; empty: none are kept.
  const std::filesystem::path& thumbnails() const { return thumbnails_; }

private:
  std::filesystem::path list_, thumbnails_;
  std::vector<RecentFile> files_;
  std::string note_;
};

/// The picture of a preset's file: presets/thumbnails/NAME.jpg of a shipped one, else one in this folder of thumbnails,
/// which need not be there. Empty where there is none for it.
std::filesystem::path thumbnail_of(const std::filesystem::path& preset, const std::filesystem::path& thumbnails);

/// Writes a small copy of the picture, as it is shown with this exposure, as PNG; makes the folder. Throws failed.
void write_thumbnail(const std::filesystem::path& file, const job::Picture& picture, double exposure_stops);

/// The most that a thumbnail measures, in pixels.
inline constexpr int thumbnail_width = 128, thumbnail_height = 96;

} // namespace nephroid::ui
