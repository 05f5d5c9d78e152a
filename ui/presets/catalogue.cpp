// SPDX-License-Identifier: Apache-2.0
#include "ui/presets/catalogue.h"

#include "base/counted.h"
#include "base/error.h"
#include "base/files.h"
#include "image/image.h"
#include "preset/choices.h"
#include "preset/differences.h"
#include "preset/read.h"
#include "scatter/spectra.h"
#include "ui/widgets/widgets.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <system_error>

namespace nephroid::ui {
namespace fs = std::filesystem;
namespace {

/// Seconds since 1970; 0 where nobody can tell.
std::int64_t time_of(const fs::path& file) {
  struct stat status {};
  return ::stat(file.c_str(), &status) == 0 ? status.st_mtime : 0;
}

std::vector<RequiredFile> needs_of(const preset::Preset& preset) {
  const FileFinder finder(fs::path(preset.source).parent_path());
  std::vector<RequiredFile> needs;
  for (const auto& [pointer, name] : preset::file_names(preset)) {
    if (std::ranges::count(needs, name, &RequiredFile::name) > 0) continue;
    needs.push_back({name});
    try {
      scatter::find_dispersion(name, finder, preset.source);
    } catch (const Error&) {
      needs.back().there = false;
    }
  }
  return needs;
}

std::string stop_of(const preset::Preset& preset) {
  const preset::Stop& stop = preset.stop;
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : " or ") + part; };
  if (stop.passes) add(counted(static_cast<std::size_t>(*stop.passes), "pass", "passes"));
  if (stop.seconds) add(fmt::format("{} s", *stop.seconds));
  if (stop.error) add(fmt::format("{} of {}", preset::word(stop.metric), *stop.error));
  return text.empty() ? fmt::format("{} passes", preset::default_passes) : text;
}

CatalogueEntry entry_of(const fs::path& file, std::string name, bool shipped, const fs::path& thumbnails) {
  CatalogueEntry entry{file, std::move(name), shipped, time_of(file), thumbnail_of(file, thumbnails)};
  try {
    const std::vector<preset::Preset> presets = preset::read_presets(file.string());
    const preset::Preset& first = presets.front();
    entry.title = first.name;
    entry.description = first.description;
    entry.engine = first.settings.engine();
    entry.resolution = first.scene.camera.resolution;
    entry.stop = stop_of(first);
    entry.runs = presets.size();
    if (first.animation) entry.frames = static_cast<std::size_t>(first.animation->frames);
    entry.needs = needs_of(first);
  } catch (const std::exception& error) {
    entry.problem = error.what();
  }
  return entry;
}

/// thumbnails: their folder.
std::vector<CatalogueEntry> read(const std::vector<RecentFile>& opened, const fs::path& thumbnails,
                                 TaskControl& control) {
  std::vector<CatalogueEntry> entries;
  try {
    const std::vector<preset::ShippedPreset> all_shipped = preset::shipped_presets();
    for (const preset::ShippedPreset& shipped : all_shipped) {
      entries.push_back(entry_of(shipped.file, shipped.name, true, thumbnails));
      control.progress(static_cast<double>(entries.size()) / static_cast<double>(all_shipped.size() + opened.size()));
    }
  } catch (const Error&) {
    // No presets are shipped with this program: recent files are all there is.
  }
  for (const RecentFile& file : opened) {
    const std::string shipped = preset::shipped_name(file.file);
    const auto same =
        std::ranges::find_if(entries, [&](const CatalogueEntry& e) { return e.shipped && e.name == shipped; });
    CatalogueEntry& entry =
        !shipped.empty() && same != entries.end()
            ? *same
            : entries.emplace_back(entry_of(file.file, fs::path(file.file).filename().string(), false, thumbnails));
    entry.time = std::max(entry.time, file.opened);
  }
  return entries;
}

constexpr std::size_t most_bytes = 1 << 20; ///< the largest file that is read
constexpr int most_pixels = 512;            ///< the longest edge

} // namespace

std::vector<std::size_t> matches(const std::vector<CatalogueEntry>& entries, const CatalogueFilter& filter) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const CatalogueEntry& e = entries[i];
    const std::string text = fmt::format("{}\n{}\n{}\n{}", e.name, e.title, e.description, e.engine);
    if ((filter.engine.empty() || e.engine == filter.engine) && has_words(text, filter.words)) indices.push_back(i);
  }
  std::stable_sort(indices.begin(), indices.end(), [&](std::size_t a, std::size_t b) {
    if (filter.newest_first && entries[a].time != entries[b].time) return entries[a].time > entries[b].time;
    return entries[a].name < entries[b].name;
  });
  return indices;
}

void Catalogue::follow(const RecentFiles& recent, TaskQueue& tasks) {
  if (tasks.busy(reading_) || (!stale_ && recent.all() == recent_)) return;
  stale_ = false;
  recent_ = recent.all();
  tasks.start(
      reading_, {"reading the presets"},
      [opened = recent_, thumbnails = recent.thumbnails()](TaskControl& control) {
        return read(opened, thumbnails, control);
      },
      [this](std::vector<CatalogueEntry> entries) {
        entries_ = std::move(entries);
        ++readings_;
      });
}

void Thumbnails::update(TaskQueue& tasks) {
  if (tasks.busy(reading_)) return;
  if (std::exchange(stale_, false))
    for (const auto& [file, picture] : pictures_) wanted_.push_back(file);
  if (wanted_.empty()) return;
  const auto read_all = [files = std::exchange(wanted_, {})] {
    std::vector<Pixels> pictures;
    for (const std::string& file : files) pictures.push_back(read(file));
    return pictures;
  };
  tasks.start(reading_, {"reading small pictures"}, read_all, [this](const std::vector<Pixels>& pictures) {
    for (const Pixels& pixels : pictures) {
      std::unique_ptr<PictureTexture>& picture = pictures_[pixels.file];
      if (pixels.width == 0) {
        picture.reset();
        continue;
      }
      if (!picture) picture = std::make_unique<PictureTexture>();
      std::copy(pixels.rgba8.begin(), pixels.rgba8.end(), picture->edit(pixels.width, pixels.height).begin());
    }
  });
}

const PictureTexture* Thumbnails::of(const std::filesystem::path& file) {
  if (file.empty()) return nullptr;
  const auto [found, is_new] = pictures_.try_emplace(file.string());
  if (is_new) wanted_.push_back(file.string());
  return found->second.get();
}

Thumbnails::Pixels Thumbnails::read(const std::string& file) {
  Pixels pixels{file, 0, 0, {}};
  try {
    std::error_code error;
    if (const auto size = std::filesystem::file_size(file, error); error || size > most_bytes) return pixels;
    const image::Image picture = image::read_image(file);
    if (picture.width < 1 || picture.height < 1 || picture.width > most_pixels || picture.height > most_pixels)
      return pixels;
    for (std::size_t i = 0; const float value : image::rgb_of(picture, file).values) {
      pixels.rgba8.push_back(image::shown(value));
      if (++i % 3 == 0) pixels.rgba8.push_back(255);
    }
    pixels.width = picture.width;
    pixels.height = picture.height;
  } catch (const std::exception&) {
    pixels.width = pixels.height = 0; // a placeholder is drawn in its place
  }
  return pixels;
}

} // namespace nephroid::ui
