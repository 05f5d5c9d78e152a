// SPDX-License-Identifier: Apache-2.0
#include "scene/texture.h"

#include "base/counted.h"
#include "image/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nephroid::scene {
namespace {

std::uint16_t texel(double value) {
  return static_cast<std::uint16_t>(std::lround(65535 * std::clamp(value, 0.0, 1.0)));
}

void read_texels(const std::filesystem::path& file, const std::string& name, Texture& texture,
                 std::vector<std::string>& warnings) {
  const image::Image picture = image::read_image(file);
  const std::size_t texels = picture.data.size() / picture.channels.size();
  if (texels > most_texture_texels)
    throw bad_input(file.string(), fmt::format("has {} x {} texels", picture.width, picture.height),
                    fmt::format("expected at most {} in all", most_texture_texels), "make it smaller");
  const auto warn = [&](const std::string& what) {
    warnings.push_back(fmt::format("material '{}': texture {}: {}", name, file.filename().string(), what));
  };
  for (const std::string& note : picture.notes) warn(note);
  const image::Rgb colours = image::rgb_of(picture, file.string());
  if (std::ranges::any_of(colours.alpha, [](float alpha) { return alpha < 1; }))
    warn("has transparent texels, which are taken as opaque");
  texture.width = picture.width;
  texture.height = picture.height;
  texture.rgb.reserve(3 * texels);
  std::size_t clipped = 0;
  for (std::size_t i = 0; i < 3 * texels; ++i) {
    const float value = colours.values[i];
    if (!std::isfinite(value))
      throw bad_input(file.string(), fmt::format("texel {} has a value that is not finite", i / 3));
    clipped += value < 0 || value > 1;
    texture.rgb.push_back(texel(value));
  }
  if (clipped > 0) warn(counted(clipped, "value is", "values are") + " outside of 0 to 1, and clipped");
}

} // namespace

Texture make_texture(const preset::Texture& texture, const FileFinder& finder, const Location& where,
                     const std::string& name, std::vector<std::string>& warnings) {
  Texture result;
  const double angle = texture.rotate_deg * std::numbers::pi / 180;
  const glm::dmat2 turn(std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle));
  result.linear = turn * glm::dmat2(texture.scale[0], 0, 0, texture.scale[1]);
  result.offset = {texture.offset[0], texture.offset[1]};
  if (texture.type == preset::Texture::Type::file) {
    result.wrap = texture.wrap;
    read_texels(finder.find(texture.file, where / "file"), name, result, warnings);
    return result;
  }
  result.width = result.height = 2;
  result.nearest = true;
  for (const preset::Vec3* colour : {&texture.colour1, &texture.colour0, &texture.colour0, &texture.colour1})
    for (const double value : *colour) result.rgb.push_back(texel(value));
  return result;
}

} // namespace nephroid::scene
