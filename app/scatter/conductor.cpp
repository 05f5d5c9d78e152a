// SPDX-License-Identifier: Apache-2.0
// Metal by its measured n and k.
#include "optics/fresnel.h"
#include "scatter/kind.h"

#include <vector>

namespace nephroid::scatter {

constinit const Kind kinds::conductor{
    .sentence = "Metal, by its measured n and k.",
    .describe =
        [](preset::Fields& v, preset::Material& m) {
          describe_metal(v, m);
          describe_roughness(v, m);
          describe_roughness_texture(v, m);
        },
    .load =
        [](const Loading& loading, Material& made) {
          loading.roughness(made);
          loading.metal(made);
          for (std::size_t w = 0; w < made.n.size(); ++w)
            made.reflectance[w] = optics::conductor_reflectance(1, 1, {made.n[w], made.k[w]});
        },
    .add_rows =
        [](const Material& material, Rows& rows) {
          rows.takes_light_of(material.reflectance);
          std::vector<double> n_and_k;
          for (std::size_t w = 0; w < material.n.size(); ++w)
            n_and_k.insert(n_and_k.end(), {material.n[w], material.k[w]});
          rows.row.surface_first = rows.data(n_and_k);
        },
    .gltf =
        [](const Material& material) {
          GltfSurface surface = gltf_metal(material);
          surface.left_out = "metals have the colour that they have straight on";
          return surface;
        },
};

} // namespace nephroid::scatter
