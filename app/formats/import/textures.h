// SPDX-License-Identifier: Apache-2.0
// Pictures on surfaces, as files of other programs place them. v counts from a picture's lower edge here and in PBRT,
// and from its upper one in Mitsuba and glTF.
#pragma once
#include "formats/import/description.h"
#include "scatter/texture.h"

#include <glm/glm.hpp>

namespace nephroid::formats {

/// From u, v of a surface to those of a picture: linear (u, v) + offset.
struct TextureMap {
  glm::dmat2 linear{1};
  glm::dvec2 offset{0};
};

/// The same map with v counted from the other edge, of the surface and of the picture.
TextureMap upside_down(const TextureMap& map);
void turn_upside_down(scene::Mesh& mesh);

/// The texture, placed so. A map that shears is left out, with a note.
preset::Texture placed(preset::Texture texture, const TextureMap& map, const Location& where, Description& into);

/// A picture file so placed; nothing, with a note, where it is not there.
std::optional<preset::Texture> picture(const std::filesystem::path& file, preset::Texture::Wrap wrap,
                                       const TextureMap& map, const Location& where, Description& into);

/// The texture of a roughness, of which the file has the picture of `values`: a preset's roughness is their value to
/// the power `exponent`, so the picture is written anew. is_srgb: integers are. Nothing, with a note, where it cannot
/// be read.
std::optional<preset::Texture> roughness_picture(const preset::Texture& values, double exponent, bool is_srgb,
                                                 const std::string& name, const Location& where, Description& into);

/// A normal map whose y goes down in the picture, as Mitsuba has it: written anew with y up. Else as roughness_picture.
std::optional<preset::Texture> normals_with_y_up(const preset::Texture& map, bool is_srgb, const std::string& name,
                                                 const Location& where, Description& into);

/// A picture of reflectances that are not encoded as a preset's are: written anew in linear values, or as 1 minus
/// `inverted` times them. is_srgb: its integers are. Else as roughness_picture.
std::optional<preset::Texture> linear_picture(const preset::Texture& picture, bool is_srgb,
                                              std::optional<double> inverted, const Location& where, Description& into);

/// The mean of all of a texture, linear sRGB; nothing where it cannot be read.
std::optional<glm::dvec3> mean_of(const preset::Texture& texture, bool is_srgb);

} // namespace nephroid::formats
