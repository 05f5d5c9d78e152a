// SPDX-License-Identifier: Apache-2.0
#include "ui/state/recent_files.h"

#include "base/error.h"
#include "base/files.h"
#include "base/hashed_bytes.h"
#include "base/json_output.h"
#include "image/image.h"
#include "preset/differences.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <system_error>

namespace nephroid::ui {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t max_list_bytes = 1 << 20;

/// Reads an entry; nothing where it is invalid.
std::optional<RecentFile> entry_of(const Json& json) {
  if (!json.is_object() || !json.contains("file") || !json["file"].is_string()) return std::nullopt;
  RecentFile entry{json["file"].get<std::string>(), 0};
  const auto control = [](unsigned char c) { return c < 0x20 || c == 0x7f; };
  if (entry.file.size() > 4096 || !fs::path(entry.file).is_absolute() ||
      std::any_of(entry.file.begin(), entry.file.end(), control))
    return std::nullopt;
  const auto opened = json.find("opened");
  if (opened != json.end() && opened->is_number_integer())
    entry.opened = std::max<std::int64_t>(0, opened->get<std::int64_t>());
  return entry;
}

/// Throws Error where the file is no list.
std::vector<RecentFile> read_list(const fs::path& file) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return {};
  if (const auto size = fs::file_size(file, ignored); !ignored && size > max_list_bytes)
    throw bad_input(file.string(), fmt::format("is {} bytes long", size));
  const Json json = Json::parse(read_file(file), nullptr, false);
  if (!json.is_object() || !json.contains("recent") || !json["recent"].is_array())
    throw bad_input(file.string(), "is no list of recent files");
  std::vector<RecentFile> files;
  for (const Json& item : json["recent"]) {
    if (files.size() == RecentFiles::limit) break;
    if (auto entry = entry_of(item); entry && std::ranges::find(files, entry->file, &RecentFile::file) == files.end())
      files.push_back(*std::move(entry));
  }
  return files;
}

} // namespace

RecentFiles::RecentFiles(fs::path list, fs::path thumbnails)
    : list_(std::move(list)), thumbnails_(std::move(thumbnails)) {
  if (list_.empty()) return;
  try {
    files_ = read_list(list_);
  } catch (const Error& error) {
    note_ = error.line() + "; the list of recent files begins anew";
  }
}

void RecentFiles::add(const fs::path& file, std::int64_t now) {
  std::error_code error;
  const fs::path absolute = fs::absolute(file, error).lexically_normal();
  if (error) return;
  std::erase_if(files_, [&](const RecentFile& entry) { return entry.file == absolute.string(); });
  files_.insert(files_.begin(), {absolute.string(), now});
  if (files_.size() > limit) files_.resize(limit);
}

std::function<void()> RecentFiles::writer() const {
  return [list = list_, files = files_] {
    if (list.empty()) return;
    try {
      std::error_code error;
      fs::create_directories(list.parent_path(), error);
      Json recent = Json::array();
      for (const RecentFile& entry : files) recent.push_back({{"file", entry.file}, {"opened", entry.opened}});
      write_file_whole(list, json_text(Json{{"recent", recent}}) + "\n");
    } catch (const Error& error) {
      throw error.noting("recent files are not remembered");
    }
  };
}

fs::path thumbnail_of(const fs::path& preset, const fs::path& thumbnails) {
  if (const std::string name = preset::shipped_name(preset); !name.empty())
    return presets_folder() / "thumbnails" / (name + ".jpg");
  if (thumbnails.empty()) return {};
  std::error_code error;
  const fs::path absolute = fs::absolute(preset, error).lexically_normal();
  return thumbnails / fmt::format("{:016x}.png", hash_of(absolute.string()));
}

void write_thumbnail(const fs::path& file, const job::Picture& picture, const image::Display& display,
                     double exposure_stops) {
  const double shrink =
      std::min({1.0, double(thumbnail_width) / picture.width, double(thumbnail_height) / picture.height});
  const int width = std::max(1, static_cast<int>(std::lround(picture.width * shrink)));
  const int height = std::max(1, static_cast<int>(std::lround(picture.height * shrink)));
  const auto index = [](int wide, int x, int y) {
    return 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(wide) + static_cast<std::size_t>(x));
  };
  // Each pixel is the mean of the pixels that it covers.
  std::vector<float> rgb(index(width, 0, height));
  const auto first = [](int i, int small, int large) { return static_cast<int>(std::int64_t{i} * large / small); };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int x0 = first(x, width, picture.width), x1 = std::max(x0 + 1, first(x + 1, width, picture.width));
      const int y0 = first(y, height, picture.height), y1 = std::max(y0 + 1, first(y + 1, height, picture.height));
      for (std::size_t c = 0; c < 3; ++c) {
        double sum = 0;
        for (int v = y0; v < y1; ++v)
          for (int u = x0; u < x1; ++u) sum += double(picture.rgb[index(picture.width, u, v) + c]);
        rgb[index(width, x, y) + c] = static_cast<float>(sum / ((x1 - x0) * (y1 - y0)));
      }
    }
  std::error_code ignored;
  fs::create_directories(file.parent_path(), ignored);
  image::write_png(file, width, height, rgb, image::showing_of(display, exposure_stops, rgb));
}

} // namespace nephroid::ui
