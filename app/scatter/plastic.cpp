// SPDX-License-Identifier: Apache-2.0
// A diffuse base below a clear coat, with what goes to and fro between both (optics/coat.h).
#include "scatter/kind.h"

#include <array>

namespace nephroid::scatter {

constinit const Kind kinds::plastic{
    .sentence = "A diffuse base below a clear coat: plastic, varnished wood, glazed tiles.",
    .describe =
        [](preset::Fields& v, preset::Material& m) {
          describe_coat_index(v, m);
          describe_reflectance(v, m);
          describe_texture(v, m);
          describe_roughness(v, m);
        },
    .load =
        [](const Loading& loading, Material& made) {
          const preset::Material& from = loading.from;
          made.alpha = from.roughness * from.roughness; // its coat is tabulated for one
          loading.coat_index(made);
          made.coat = optics::make_coat(made.coat_n, made.alpha);
          made.texture = loading.picture(from.texture, Texels::colours, "texture");
          made.reflectance = loading.spectrum(from.reflectance, "reflectance");
        },
    .add_rows =
        [](const Material& material, Rows& rows) {
          static_assert(COAT_COSINES == optics::coat_cosines && COAT_MEAN == 1 && COAT_PARTS == 2);
          rows.takes_light();
          rows.row.reflector = rows.colour(material.reflectance, 1 / material.coat.mean, is_textured(material));
          rows.row.surface_first = rows.data(std::array{material.coat_n, material.coat.mean});
          rows.data(material.coat.passes);
        },
    .gltf =
        [](const Material& material) {
          return GltfSurface{.base_colour = material.reflectance,
                             .left_out = "coats of plastic are left out: they are matt"};
        },
};

} // namespace nephroid::scatter
