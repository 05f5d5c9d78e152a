// SPDX-License-Identifier: Apache-2.0
// A polished metal under a polished varnish. R, by Fresnel's equations, is reflected by the varnish. What passes it is
// refracted, and the metal reflects the part M, with its index n + i k over the varnish's. The varnish leaves the part
// t each way, however slanted. What goes to and fro below it leaves in the mirror's direction, too, and is summed:
//
//   R + (1 - R) t M t (1 - R) (1 + R t M t + ...) = R + (1 - R)^2 t^2 M / (1 - R t^2 M),
//
// pbrt-v4's CoatedConductorBxDF with polished interfaces. R and M are means of both polarisations, as there.
#include "kernels/scatter/conductor.h"

// At a wavelength. around: material_around. The table has the varnish's index; then, by wavelength, n and k of the
// metal over that, and t^2.
static inline float varnished_metal_part(const World* world, const DeviceMaterial* material, const Band* band,
                                         int around, float cos_i, int wavelength) {
  __global const float* varnish = world->tables.surface_data + material->surface_first;
  __global const float* metal = varnish + 1 + 3 * wavelength;
  const float n = varnish[0], n_near = index_around(world, band, around, wavelength);
  const float cos_t = refracted_cosine(cos_i, n_near / n);
  if (!(cos_t > 0.0f)) return 1.0f; // total reflection, or along the surface
  const float coat = fresnel_reflectance(cos_i, cos_t, n_near, n), passes = 1.0f - coat;
  if (!(passes > 0.0f)) return 1.0f;
  const float below = metal[2] * conductor_reflectance(cos_t, metal[0], metal[1]);
  return coat + passes * passes * below / (1.0f - coat * below);
}

METAL(varnished_metal)
