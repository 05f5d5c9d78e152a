// SPDX-License-Identifier: Apache-2.0
// Glass, water, diamond: a body or a thin pane, polished or rough, clear or absorbing, with a tint or a film on it.
#include "scatter/kind.h"

#include <algorithm>
#include <cmath>

namespace nephroid::scatter {

constinit const Kind kinds::dielectric{
    .sentence = "Glass, water, diamond: refracts and reflects.",
    .describe =
        [](preset::Fields& v, preset::Material& m) {
          v.field("dispersion", "Index of refraction: a number, a file or an object.", m.dispersion,
                  {.required = true});
          describe_roughness(v, m);
          describe_roughness_texture(v, m);
          v.field("absorption", "Absorb light inside where the dispersion file has k.", m.absorption);
          describe_tint(v, m);
          v.field("tint_texture", "What the tint is multiplied by: a picture file or an object.", m.tint_texture);
          v.field("thin", "A pane without thickness: light goes straight on, or is reflected by both faces together.",
                  m.thin);
          v.field("coating", "A thin layer on the surface, such as an anti-reflection coat or a soap film.", m.coating);
        },
    .load =
        [](const Loading& loading, Material& made) {
          const preset::Material& from = loading.from;
          const Location& where = loading.where;
          loading.roughness(made);
          loading.curve(from.dispersion, where / "dispersion",
                        [&](const optics::DispersionCurve& curve, optics::Extrapolation outside) {
                          made.n = optics::sample_n(curve, outside, loading.range);
                          if (from.absorption && curve.k && !from.thin)
                            made.k = optics::sample_k(curve, outside, loading.range);
                        });
          made.absorbs = std::any_of(made.k.begin(), made.k.end(), [](double k) { return k > 0; });
          made.tint = loading.spectrum(from.tint, "tint");
          made.texture = loading.picture(from.tint_texture, Texels::colours, "tint_texture");
          made.thin = from.thin;
          if (from.thin && is_rough(made))
            throw bad_input(where / "roughness", "is of a thin pane", "expected 0, or a body: a pane is polished",
                            "for a frosted pane take a plate");
          if (!from.coating) return;
          if (from.thin)
            throw bad_input(where / "coating", "is on a thin pane", "expected a body: a pane has no coating",
                            "for a film such as soap's, give a body the index 1 and the film as its coating");
          made.coating_nm = from.coating->thickness_nm;
          loading.curve(from.coating->dispersion, where / "coating" / "dispersion",
                        [&](const optics::DispersionCurve& curve, optics::Extrapolation outside) {
                          made.coating_n = optics::sample_n(curve, outside, loading.range);
                        });
        },
    .add_rows =
        [](const Material& material, Rows& rows) {
          shared::DeviceMaterial& row = rows.row;
          if (is_rough(material) || has_tint_texture(material)) rows.takes_light(has_tint_texture(material));
          row.attenuator = rows.loss(loss_inside(material));
          if (has_tint_texture(material))
            row.reflector = rows.colour(material.tint, 1, true);
          else
            row.tint = rows.loss(loss_at_surface(material));
          row.is_thin = material.thin;
          if (!is_coated(material)) return;
          row.surface_first = rows.data(material.coating_n);
          optics::Spectrum waves = optics::cells(material.range).nm;
          for (double& nm : waves) nm = material.coating_nm / nm;
          rows.data(waves);
        },
    .gltf =
        [](const Material& material) {
          return GltfSurface{.base_colour = material.tint,
                             .roughness = std::sqrt(material.alpha),
                             .transmits = true,
                             .left_out = is_coated(material) ? "coatings are left out" : ""};
        },
};

} // namespace nephroid::scatter
