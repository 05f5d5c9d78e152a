// SPDX-License-Identifier: Apache-2.0
#include "scatter/texture.h"

#include "base/counted.h"
#include "image/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <list>
#include <memory>
#include <mutex>
#include <numbers>
#include <system_error>
#include <utility>

namespace nephroid::scatter {
namespace {

std::uint16_t texel(double value) {
  return static_cast<std::uint16_t>(std::lround(65535 * std::clamp(value, 0.0, 1.0)));
}

} // namespace

image::Image read_texels(const std::filesystem::path& file) {
  constexpr std::size_t most_texels = std::size_t{1} << 26;
  image::Image picture = image::read_image(file);
  if (picture.data.size() / picture.channels.size() > most_texels)
    throw bad_input(file.string(), fmt::format("has {} x {} texels", picture.width, picture.height),
                    fmt::format("expected at most {} in all", most_texels), "make it smaller");
  return picture;
}

namespace {

/// A picture's texels, and what is to be said of them.
struct Picture {
  int width = 0, height = 0;
  bool grey = false;
  std::shared_ptr<const std::vector<std::uint16_t>> rgb;
  std::vector<std::string> notes;
};

Picture read_picture(const std::filesystem::path& file, Texels texels) {
  image::Image picture = read_texels(file);
  if (texels == Texels::numbers) {
    picture.integers = false;
    picture.chromaticities.reset();
  }
  const image::Rgb colours = image::rgb_of(picture, file.string());
  Picture result{picture.width, picture.height, colours.grey, {}, picture.notes};
  if (std::ranges::any_of(colours.alpha, [](float alpha) { return alpha < 1; }))
    result.notes.push_back("has transparent texels, which are taken as opaque");
  std::vector<std::uint16_t> rgb;
  rgb.reserve(colours.values.size());
  std::size_t clipped = 0;
  for (std::size_t i = 0; i < colours.values.size(); ++i) {
    const float value = colours.values[i];
    if (!std::isfinite(value))
      throw bad_input(file.string(), fmt::format("texel {} has a value that is not finite", i / 3));
    clipped += value < 0 || value > 1;
    rgb.push_back(texel(value));
  }
  result.rgb = std::make_shared<const std::vector<std::uint16_t>>(std::move(rgb));
  if (clipped > 0)
    result.notes.push_back(counted(clipped, "value is", "values are") + " outside of 0 to 1, and clipped");
  return result;
}

struct KeptPicture {
  std::filesystem::path file;
  Texels texels = Texels::colours;
  std::uintmax_t bytes = 0;
  std::filesystem::file_time_type written;
  std::shared_ptr<const Picture> picture;
};

/// The same, but a file that is as it was is not read again, as far as the last pictures take no more than 256 MiB
/// together: each edit loads its scene again. Safe from several threads.
std::shared_ptr<const Picture> read_picture_once(const std::filesystem::path& file, Texels texels) {
  constexpr std::size_t most_bytes = std::size_t{256} << 20;
  static std::mutex mutex;
  static std::list<KeptPicture> all; // the last used first
  const std::lock_guard lock(mutex);
  std::error_code ignored;
  KeptPicture wanted{file, texels, std::filesystem::file_size(file, ignored),
                     std::filesystem::last_write_time(file, ignored), nullptr};
  const auto kept =
      std::ranges::find_if(all, [&](const KeptPicture& one) { return one.file == file && one.texels == texels; });
  if (kept != all.end() && kept->bytes == wanted.bytes && kept->written == wanted.written)
    all.splice(all.begin(), all, kept);
  else {
    if (kept != all.end()) all.erase(kept);
    wanted.picture = std::make_shared<const Picture>(read_picture(file, texels));
    all.push_front(std::move(wanted));
  }
  const std::shared_ptr<const Picture> result = all.front().picture;
  std::size_t sum = 0;
  all.remove_if([&](const KeptPicture& one) { return (sum += 2 * one.picture->rgb->size()) > most_bytes; });
  return result;
}

} // namespace

Texture make_texture(const preset::Texture& texture, Texels texels, const FileFinder& finder, const Location& where,
                     const std::string& owner, std::vector<std::string>& warnings) {
  Texture result;
  const double angle = texture.rotate_deg * std::numbers::pi / 180;
  const glm::dmat2 turn(std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle));
  result.linear = turn * glm::dmat2(texture.scale[0], 0, 0, texture.scale[1]);
  result.offset = {texture.offset[0], texture.offset[1]};
  if (texture.type == preset::Texture::Type::file) {
    result.wrap = texture.wrap;
    const std::filesystem::path file = finder.find(texture.file, where / "file");
    const std::shared_ptr<const Picture> picture = read_picture_once(file, texels);
    for (const std::string& note : picture->notes)
      warnings.push_back(fmt::format("{}: texture {}: {}", owner, file.filename().string(), note));
    result.width = picture->width;
    result.height = picture->height;
    result.grey = picture->grey;
    result.rgb = picture->rgb;
    return result;
  }
  result.width = result.height = 2;
  result.nearest = true;
  std::vector<std::uint16_t> rgb;
  for (const preset::Vec3* colour : {&texture.colour1, &texture.colour0, &texture.colour0, &texture.colour1})
    for (const double value : *colour) rgb.push_back(texel(value));
  result.rgb = std::make_shared<const std::vector<std::uint16_t>>(std::move(rgb));
  return result;
}

Texture make_normal_map(const preset::Texture& texture, double scale, const FileFinder& finder, const Location& where,
                        const std::string& owner, std::vector<std::string>& warnings) {
  Texture map = make_texture(texture, Texels::numbers, finder, where, owner, warnings);
  if (map.grey)
    throw bad_input(where, "is a grey picture", "expected a map of normals, which is mostly light blue",
                    "make one of a map of heights in another program");
  if (scale == 1) return map;
  // Kernels mix texels before they make the normal's length 1, so z may be shortened for x and y that are lengthened.
  const double longer = std::max(std::abs(scale), 1.0);
  std::vector<std::uint16_t> rgb(*map.rgb);
  for (std::size_t i = 0; i < rgb.size(); ++i)
    rgb[i] = texel(0.5 + (rgb[i] / 65535.0 - 0.5) * (i % 3 < 2 ? scale : 1) / longer);
  map.rgb = std::make_shared<const std::vector<std::uint16_t>>(std::move(rgb));
  return map;
}

} // namespace nephroid::scatter
