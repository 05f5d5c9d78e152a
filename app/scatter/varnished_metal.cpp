// SPDX-License-Identifier: Apache-2.0
// A polished metal under a clear varnish, with what goes to and fro between both (kernels/scatter/varnished_metal.h).
#include "optics/fresnel.h"
#include "scatter/kind.h"

#include <vector>

namespace nephroid::scatter {

constinit const Kind kinds::varnished_metal{
    .sentence = "A polished metal under a clear varnish, which may have a tint: lacquered brass.",
    .describe =
        [](preset::Fields& v, preset::Material& m) {
          describe_metal(v, m);
          describe_coat_index(v, m);
          describe_tint(v, m);
        },
    .load =
        [](const Loading& loading, Material& made) {
          loading.metal(made);
          loading.coat_index(made);
          made.tint = loading.spectrum(loading.from.tint, "tint");
          const double coat = optics::fresnel_reflectance(1, 1, made.coat_n);
          for (std::size_t w = 0; w < made.n.size(); ++w) {
            const double below =
                made.tint[w] * made.tint[w] * optics::conductor_reflectance(1, made.coat_n, {made.n[w], made.k[w]});
            made.reflectance[w] = coat + (1 - coat) * (1 - coat) * below / (1 - coat * below);
          }
        },
    .add_rows =
        [](const Material& material, Rows& rows) {
          rows.takes_light_of(material.reflectance);
          std::vector<double> values{material.coat_n};
          for (std::size_t w = 0; w < material.n.size(); ++w)
            values.insert(values.end(), {material.n[w] / material.coat_n, material.k[w] / material.coat_n,
                                         material.tint[w] * material.tint[w]});
          rows.row.surface_first = rows.data(values);
        },
    .gltf =
        [](const Material& material) {
          GltfSurface surface = gltf_metal(material);
          surface.left_out = "varnished metals have the colour that they have straight on";
          return surface;
        },
};

} // namespace nephroid::scatter
