// SPDX-License-Identifier: Apache-2.0
// A diffuse base below a clear coat, with what goes to and fro between both (optics/coat.h).
#include "scatter/kind.h"

#include <fmt/format.h>

#include <array>

namespace nephroid::scatter {

constinit const Kind kinds::plastic{
    .sentence = "A diffuse base below a clear coat: plastic, varnished wood, glazed tiles.",
    .describe =
        [](preset::Fields& v, preset::Material& m) {
          v.field("dispersion", "The coat's index of refraction, in air at 588 nm: a number, a file or an object.",
                  m.dispersion);
          describe_reflectance(v, m);
          describe_texture(v, m);
          describe_roughness(v, m);
        },
    .load =
        [](const Loading& loading, Material& made) {
          const preset::Material& from = loading.from;
          const Location field = loading.where / "dispersion";
          made.alpha = from.roughness * from.roughness; // its coat is tabulated for one
          loading.curve(from.dispersion, field,
                        [&](const optics::DispersionCurve& curve, optics::Extrapolation outside) {
                          made.coat_n = curve.sample(588, outside).n.value_or(0);
                        });
          if (!(made.coat_n >= 1 && made.coat_n <= 4))
            throw bad_input(field, fmt::format("is {:.3g} at 588 nm", made.coat_n), "expected 1 to 4 for a coat",
                            "varnish and plastic have about 1.5");
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
