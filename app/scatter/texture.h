// SPDX-License-Identifier: Apache-2.0
// A picture on a surface, as kernels look it up (kernels/scatter/texture.h).
#pragma once
#include "base/files.h"
#include "preset/preset.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace nephroid::image {
struct Image;
}

namespace nephroid::scatter {

struct Texture {
  int width = 0, height = 0;
  /// Linear sRGB or plain numbers, 65535 is 1, 3 a texel, row 0 at the top; materials that show one picture share it.
  std::shared_ptr<const std::vector<std::uint16_t>> rgb;
  preset::Texture::Wrap wrap = preset::Texture::Wrap::repeat;
  bool grey = false;    ///< of one channel, here thrice
  bool nearest = false; ///< texels have edges; else bilinear between their middles
  glm::dmat2 linear{1}; ///< (u, v) -> linear (u, v) + offset, from the mesh's to the picture's
  glm::dvec2 offset{0, 0};
};

/// A picture of a texture or a lamp. Throws bad_input as image::read_image does, and for more than 2^26 texels.
image::Image read_texels(const std::filesystem::path& file);

/// What the numbers of a picture are: colours, or plain numbers whatever the file says of its colours.
enum class Texels { colours, numbers };

/// Integers of colours are decoded as image/image.h says. Values outside of 0..1 are clipped, and alpha is left out;
/// warnings say so, after `owner`: "material 'wall'". where: FILE#/scene/materials/NAME/texture. Throws bad_input there
/// for a file that is not there, and at the file for what is no picture, too large, or has a value that is not finite.
Texture make_texture(const preset::Texture& texture, Texels texels, const FileFinder& finder, const Location& where,
                     const std::string& owner, std::vector<std::string>& warnings);

/// The same of a map of normals whose x and y are multiplied by `scale`: (1 + normal) / 2 as red, green and blue, of
/// any length. Throws bad_input at the file, too, where it is grey.
Texture make_normal_map(const preset::Texture& texture, double scale, const FileFinder& finder, const Location& where,
                        const std::string& owner, std::vector<std::string>& warnings);

} // namespace nephroid::scatter
