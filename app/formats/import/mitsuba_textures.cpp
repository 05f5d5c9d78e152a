// SPDX-License-Identifier: Apache-2.0
#include "formats/import/mitsuba_scene.h"
#include "formats/import/textures.h"
#include "scene/scene.h"

namespace nephroid::formats {

std::optional<preset::Texture> mitsuba_texture(MitsubaScene& scene, xml_node parent, const std::string& name,
                                               scatter::Texels texels) {
  const MitsubaFile& file = scene.file;
  const xml_node node = file.child(parent, name);
  const std::string type = node ? file.attribute(node, "type") : std::string();
  if (std::string_view(node.name()) != "texture" || (type != "bitmap" && type != "checkerboard")) return std::nullopt;
  const Location where = file.at(node);
  const Nesting nesting(scene.nested, "textures", where);
  const glm::dmat4 to_uv = file.to_world(node, "to_uv");
  // A matrix of 3 x 3 has its shift in the third column, one of 4 x 4 in the fourth.
  const glm::dvec2 offset(glm::dvec3(to_uv[2]).x + to_uv[3].x, glm::dvec3(to_uv[2]).y + to_uv[3].y);
  // Of version 0.6.
  const glm::dvec2 scale(file.number(node, "uscale", 1), file.number(node, "vscale", 1)),
      shift(file.number(node, "uoffset", 0), file.number(node, "voffset", 0));
  const TextureMap map = upside_down({glm::dmat2(scale.x, 0, 0, scale.y) * glm::dmat2(to_uv), scale * offset + shift});
  if (type == "checkerboard") {
    preset::Texture board;
    board.type = preset::Texture::Type::checkerboard;
    const auto colour_of_part = [&](const char* part, double standard) {
      return scene::to_vec3(glm::clamp(linear_srgb_of(mitsuba_colour(scene, node, part, standard)), 0.0, 1.0));
    };
    board.colour1 = colour_of_part("color0", 0.4); // of the upper left quarter there
    board.colour0 = colour_of_part("color1", 0.2);
    return placed(board, map, where, scene.d);
  }
  const std::string wrap = file.text(node, "wrap_mode", "repeat");
  if (file.text(node, "filter_type", "bilinear") != "bilinear")
    scene.d.note(where, "the texels of the texture have no edges here");
  const bool is_raw = file.flag(node, "raw") && texels == scatter::Texels::colours;
  note_unasked(scene, node);
  const auto taken = picture(file.find(node, file.text(node, "filename", "")),
                             wrap == "mirror"  ? preset::Texture::Wrap::mirror
                             : wrap == "clamp" ? preset::Texture::Wrap::clamp
                                               : preset::Texture::Wrap::repeat,
                             map, where, scene.d);
  return taken && is_raw ? linear_picture(*taken, false, {}, where, scene.d) : taken;
}

} // namespace nephroid::formats
