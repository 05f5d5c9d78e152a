// SPDX-License-Identifier: Apache-2.0
// A mirror whose reflectance does not depend on the angle: polished, or of microfacets.
#include "scatter/kind.h"

namespace nephroid::scatter {

constinit const Kind kinds::mirror{
    .sentence = "Reflects a part of the light that does not depend on the angle.",
    .describe =
        [](preset::Fields& v, preset::Material& m) {
          describe_reflectance(v, m);
          describe_roughness(v, m);
          describe_roughness_texture(v, m);
        },
    .load =
        [](const Loading& loading, Material& made) {
          loading.roughness(made);
          made.reflectance = loading.spectrum(loading.from.reflectance, "reflectance");
        },
    .add_rows =
        [](const Material& material, Rows& rows) {
          if (is_rough(material)) rows.takes_light();
          rows.row.attenuator = rows.loss(loss_at_surface(material));
        },
    .gltf = gltf_metal,
};

} // namespace nephroid::scatter
