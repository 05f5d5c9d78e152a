// SPDX-License-Identifier: Apache-2.0
// Metal by its measured n and k.
#include "optics/fresnel.h"
#include "scatter/kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace nephroid::scatter {

constinit const Kind kinds::conductor{
    .sentence = "Metal, by its measured n and k.",
    .describe =
        [](preset::Fields& v, preset::Material& m) {
          v.field("metal",
                  "gold, silver, copper, aluminium, brass, or a YAML file of refractiveindex.info with n and k.",
                  m.metal, {.text = preset::Text::file, .names = preset::Names::metal});
          describe_roughness(v, m);
          describe_roughness_texture(v, m);
        },
    .load =
        [](const Loading& loading, Material& made) {
          loading.roughness(made);
          preset::Dispersion metal;
          metal.type = preset::Dispersion::Type::file;
          metal.file = loading.from.metal;
          const Location field = loading.where / "metal";
          loading.curve(metal, field, [&](const optics::DispersionCurve& curve, optics::Extrapolation outside) {
            if (!curve.k)
              throw bad_input(field, fmt::format("{} has no k", curve.name), "expected a metal's n and k",
                              "take gold, silver, copper, aluminium, brass, or a file of refractiveindex.info");
            made.n = optics::sample_n(curve, outside);
            made.k = optics::sample_k(curve, outside);
          });
          if (const double most = std::ranges::max(made.k); most < 0.01)
            loading.warn(fmt::format("its k is at most {:.2g}, which is no metal's: a conductor absorbs what a "
                                     "dielectric lets through",
                                     most));
          for (std::size_t w = 0; w < made.n.size(); ++w)
            made.reflectance[w] = optics::conductor_reflectance(1, 1, {made.n[w], made.k[w]});
        },
    .add_rows =
        [](const Material& material, Rows& rows) {
          rows.takes_light(
              std::ranges::any_of(material.reflectance, [&](double r) { return r != material.reflectance[0]; }));
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
