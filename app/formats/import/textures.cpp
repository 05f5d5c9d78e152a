// SPDX-License-Identifier: Apache-2.0
#include "formats/import/textures.h"

#include "base/files.h"

#include <algorithm>
#include <cmath>

namespace nephroid::formats {

TextureMap upside_down(const TextureMap& map) {
  const glm::dmat2 flip(1, 0, 0, -1);
  const glm::dvec2 top(0, 1);
  return {flip * map.linear * flip, flip * (map.linear * top + map.offset) + top};
}

void turn_upside_down(scene::Mesh& mesh) {
  for (scene::Texcoords& corners : mesh.texcoords)
    for (glm::vec2& corner : corners) corner.y = 1 - corner.y;
}

preset::Texture placed(preset::Texture texture, const TextureMap& map, const Location& where, Description& into) {
  const glm::dvec2 u = map.linear[0], v = map.linear[1];
  const double width = glm::length(u);
  const glm::dvec2 along = width > 0 ? u / width : glm::dvec2(1, 0), across(-along.y, along.x);
  if (std::abs(glm::dot(v, along)) > 1e-6 * glm::length(v)) {
    into.note(where, "how the texture is sheared is left out");
    return texture;
  }
  texture.scale = {width, glm::dot(v, across)};
  texture.rotate_deg = glm::degrees(std::atan2(along.y, along.x));
  texture.offset = {map.offset.x, map.offset.y};
  for (auto* numbers : {&texture.scale, &texture.offset})
    for (double& number : *numbers) number = std::clamp(number, -1e6, 1e6);
  return texture;
}

std::optional<preset::Texture> picture(const std::filesystem::path& file, preset::Texture::Wrap wrap,
                                       const TextureMap& map, const Location& where, Description& into) {
  if (!is_there(file)) {
    into.note(where, "the picture " + file.string() + " is not there and left out");
    return std::nullopt;
  }
  preset::Texture texture;
  texture.file = std::filesystem::absolute(file).lexically_normal().string();
  texture.wrap = wrap;
  return placed(texture, map, where, into);
}

} // namespace nephroid::formats
