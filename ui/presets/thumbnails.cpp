// SPDX-License-Identifier: Apache-2.0
#include "ui/presets/thumbnails.h"

#include "image/image.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <system_error>
#include <utility>

namespace nephroid::ui {
namespace {

constexpr std::size_t most_bytes = 1 << 20; ///< of a file
constexpr int most_pixels = 512;            ///< of its edge

} // namespace

void Thumbnails::take(const std::vector<Pixels>& pictures)
{
  for (const Pixels& pixels : pictures) {
    std::unique_ptr<PictureTexture>& picture = pictures_[pixels.file];
    if (pixels.width == 0) {
      picture.reset();
      continue;
    }
    if (!picture) picture = std::make_unique<PictureTexture>();
    std::copy(pixels.rgba8.begin(), pixels.rgba8.end(), picture->edit(pixels.width, pixels.height).begin());
  }
}

void Thumbnails::update(TaskQueue& tasks)
{
  if (tasks.busy(reading_)) return;
  if (std::exchange(stale_, false))
    for (const auto& [file, picture] : pictures_) wanted_.push_back(file);
  if (wanted_.empty()) return;
  const auto read_all = [files = std::exchange(wanted_, {})] {
    std::vector<Pixels> pictures;
    for (const std::string& file : files) pictures.push_back(read(file));
    return pictures;
  };
  tasks.start(reading_, {"reading small pictures"}, read_all, [this](const std::vector<Pixels>& pictures) { take(pictures); });
}

const PictureTexture* Thumbnails::of(const std::filesystem::path& file)
{
  if (file.empty()) return nullptr;
  const auto [found, is_new] = pictures_.try_emplace(file.string());
  if (is_new) wanted_.push_back(file.string());
  return found->second.get();
}

Thumbnails::Pixels Thumbnails::read(const std::string& file)
{
  Pixels pixels{file, 0, 0, {}};
  try {
    std::error_code error;
    if (const auto size = std::filesystem::file_size(file, error); error || size > most_bytes) return pixels;
    const image::Image picture = image::read_image(file);
    if (picture.width < 1 || picture.height < 1 || picture.width > most_pixels || picture.height > most_pixels) return pixels;
    for (std::size_t i = 0; const float value : image::rgb_of(picture, file).values) {
      pixels.rgba8.push_back(static_cast<unsigned char>(std::lround(255 * std::clamp(value, 0.0f, 1.0f))));
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
