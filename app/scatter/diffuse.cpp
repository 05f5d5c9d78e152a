// SPDX-License-Identifier: Apache-2.0
// Lambert's surface: of the irradiance it sends reflectance / pi on to all sides.
#include "scatter/kind.h"

namespace nephroid::scatter {

constinit const Kind kinds::diffuse{
    .sentence = "Scatters light equally to all sides (Lambert): what caustics fall on.",
    .describe =
        [](preset::Fields& v, preset::Material& m) {
          describe_reflectance(v, m);
          describe_texture(v, m);
          v.field("normal_map", "Normals as glTF has them: red, green, blue, plain numbers, are (1 + x, y, z) / 2.",
                  m.normal_map);
          v.field("normal_scale", "Factor of the x and y of the normal map.", m.normal_scale,
                  {.bounds = preset::within(-100, 100)});
        },
    .load =
        [](const Loading& loading, Material& made) {
          const preset::Material& from = loading.from;
          if (from.normal_map)
            made.normal_map = std::make_shared<const Texture>(
                make_normal_map(*from.normal_map, from.normal_scale, loading.finder, loading.where / "normal_map",
                                loading.owner, loading.warnings));
          made.texture = loading.picture(from.texture, Texels::colours, "texture");
          made.reflectance = loading.spectrum(from.reflectance, "reflectance");
        },
    .add_rows = [](const Material& material,
                   Rows& rows) { rows.row.reflector = rows.colour(material.reflectance, 1, is_textured(material)); },
    .gltf = [](const Material& material) { return GltfSurface{.base_colour = material.reflectance}; },
};

} // namespace nephroid::scatter
