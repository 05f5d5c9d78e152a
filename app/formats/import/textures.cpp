// SPDX-License-Identifier: Apache-2.0
#include "formats/import/textures.h"

#include "base/bytes.h"
#include "base/error.h"
#include "base/files.h"
#include "image/image.h"
#include "scatter/texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

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

namespace {

/// The picture of a texture, linear. is_srgb: integers are encoded. Numbers have no primaries.
image::Image linear_texels(const preset::Texture& texture, bool is_srgb, scatter::Texels texels) {
  image::Image picture = scatter::read_texels(texture.file);
  if (!is_srgb) picture.integers = false;
  if (texels == scatter::Texels::numbers) picture.chromaticities.reset();
  return {picture.width, picture.height, {"R", "G", "B"}, image::rgb_of(picture, texture.file).values};
}

/// The texture with its picture anew: change(value, channel). Else as roughness_picture; what: for the note.
template <class Change>
std::optional<preset::Texture> rewritten(const preset::Texture& from, bool is_srgb, scatter::Texels texels,
                                         const std::string& name, const char* what, const Location& where,
                                         Description& into, const Change& change) {
  preset::Texture made = from;
  try {
    image::Image picture = linear_texels(from, is_srgb, texels);
    for (std::size_t i = 0; i < picture.data.size(); ++i) picture.data[i] = change(picture.data[i], i % 3);
    ByteStore bytes;
    image::write_exr(bytes, picture);
    made.file = into.own_bytes(name, ".exr", bytes);
    return made;
  } catch (const Error& error) {
    into.note(where, fmt::format("{} is left out: {}", what, error.line()));
    return std::nullopt;
  }
}

} // namespace

std::optional<preset::Texture> normals_with_y_up(const preset::Texture& map, bool is_srgb, const std::string& name,
                                                 const Location& where, Description& into) {
  return rewritten(map, is_srgb, scatter::Texels::numbers, name + " normals", "the normalmap", where, into,
                   [](float value, std::size_t channel) { return channel == 1 ? 1 - value : value; });
}

std::optional<preset::Texture> linear_picture(const preset::Texture& picture, bool is_srgb,
                                              std::optional<double> inverted, const Location& where,
                                              Description& into) {
  return rewritten(picture, is_srgb, scatter::Texels::colours, std::filesystem::path(picture.file).stem().string(),
                   "the picture", where, into, [&](float value, std::size_t) {
                     return inverted ? static_cast<float>(std::max(1 - *inverted * double(value), 0.0)) : value;
                   });
}

std::optional<glm::dvec3> mean_of(const preset::Texture& texture, bool is_srgb) {
  const auto vector = [](const preset::Vec3& v) { return glm::dvec3(v[0], v[1], v[2]); };
  if (texture.type == preset::Texture::Type::checkerboard)
    return 0.5 * (vector(texture.colour0) + vector(texture.colour1));
  try {
    const image::Image picture = linear_texels(texture, is_srgb, scatter::Texels::colours);
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < picture.data.size(); ++i)
      if (std::isfinite(picture.data[i])) sum[static_cast<int>(i % 3)] += double(picture.data[i]);
    return sum / (static_cast<double>(picture.width) * picture.height);
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::optional<preset::Texture> roughness_picture(const preset::Texture& values, double exponent, bool is_srgb,
                                                 const std::string& name, const Location& where, Description& into) {
  preset::Texture made = values;
  const auto root = [exponent](double value) { return std::pow(std::clamp(value, 0.0, 1.0), exponent); };
  if (values.type == preset::Texture::Type::checkerboard) {
    for (preset::Vec3* colour : {&made.colour0, &made.colour1})
      for (double& value : *colour) value = root(value);
    return made;
  }
  try {
    const image::Image picture = linear_texels(values, is_srgb, scatter::Texels::numbers);
    const std::vector<float>& rgb = picture.data;
    std::vector<std::uint16_t> grey;
    for (std::size_t i = 0; i < rgb.size(); i += 3) {
      const double mean = (double(rgb[i]) + double(rgb[i + 1]) + double(rgb[i + 2])) / 3;
      grey.push_back(static_cast<std::uint16_t>(std::lround(65535 * root(std::isfinite(mean) ? mean : 0))));
    }
    ByteStore bytes;
    image::write_png16(bytes, picture.width, picture.height, grey, "roughness");
    made.file = into.own_bytes(name + " roughness", ".png", bytes);
    return made;
  } catch (const Error& error) {
    into.note(where, "the picture of its roughness is left out: " + error.line());
    return std::nullopt;
  }
}

} // namespace nephroid::formats
