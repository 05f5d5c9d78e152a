// SPDX-License-Identifier: Apache-2.0
// Metal by its measured n and k. Kernels have its reflectance by three terms (optics/conductor.h).
#include "optics/fresnel.h"
#include "scatter/kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

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
          made.conductor = optics::conductor_terms(made.n, made.k);
          if (const double error = made.conductor.error; error > most_conductor_error)
            throw bad_input(field, fmt::format("has a reflectance that is off by up to {:.2g} here", error),
                            "expected n and k of a metal",
                            "what light passes is a dielectric, with k as its absorption");
          else if (error > 0.001)
            loading.warn(fmt::format("its reflectance is off by up to {:.2g}", error));
          for (std::size_t w = 0; w < made.n.size(); ++w)
            made.reflectance[w] = optics::conductor_reflectance(1, 1, {made.n[w], made.k[w]});
        },
    .add_rows =
        [](const Material& material, Rows& rows) {
          static_assert(CONDUCTOR_TERMS == optics::conductor_term_count);
          if (is_rough(material)) rows.row.masking = rows.masking();
          for (std::size_t j = 0; j < CONDUCTOR_TERMS; ++j) {
            const std::size_t w = material.conductor.wavelengths[j];
            const int data = rows.data(std::array{material.n[w], material.k[w]}),
                      loss = rows.loss(material.conductor.coefficients[j]);
            if (j == 0) rows.row.surface_first = data, rows.row.attenuator = loss;
          }
        },
    .gltf =
        [](const Material& material) {
          GltfSurface surface = gltf_metal(material);
          surface.left_out = "metals have the colour that they have straight on";
          return surface;
        },
};

} // namespace nephroid::scatter
