// SPDX-License-Identifier: Apache-2.0
// What a metal reflects: Fresnel's equations with a complex index n + i k (Born and Wolf, Principles of Optics, 14.2).
// It depends on angle and wavelength, and a path may stand for many wavelengths. So a metal has CONDUCTOR_TERMS rows of
// losses (attenuation.h): -ln R(angle, wavelength) is nearly the sum over j of a_j(wavelength) times -ln R_j(angle),
// the exact loss at one wavelength each. app/optics/conductor.h chooses these wavelengths and a_j, and says the error.
#include "kernels/scatter/interaction.h"

// Mean of the reflectances of both polarisations. n, k: of the metal, over the index of the medium before it.
static inline float conductor_reflectance(float cos_i, float n, float k) {
  const float cos2 = cos_i * cos_i, sin2 = (1.0f - cos_i) * (1.0f + cos_i);
  const float difference = n * n - k * k - sin2, product = n * k;
  const float length = sqrt(difference * difference + 4.0f * product * product); // a^2 + b^2, with (a + i b)^2 =
  const float a = sqrt(fmax(0.5f * (length + difference), 0.0f));                //   (n + i k)^2 - sin^2
  const float along = 2.0f * a * cos_i, s = (length + cos2 - along) / (length + cos2 + along);
  const float both = cos2 * length + sin2 * sin2, across = along * sin2;
  return 0.5f * s * (1.0f + (both - across) / (both + across));
}

static inline bool conductor_scatter(const World* world, Path* path, const Interaction* at, const Band* band, float u,
                                     ScatterSample* sample) {
  *sample = reflect_at(path->direction, &at->surface, 1.0f, 1.0f);
  sample->reflectance = 1.0f;
  const int around = medium_object(&path->media, world->objects);
  const float n_near = around < 0 ? 1.0f : index_of_band(world, band)[world->objects[around].material];
  const float cos_i = -dot(path->direction, sample->normal);
  __global const float* terms = world->tables.surface_data + at->material.surface_first; // n and k of each
  for (int j = 0; j < CONDUCTOR_TERMS; ++j) {
    const float reflectance = conductor_reflectance(cos_i, terms[2 * j] / n_near, terms[2 * j + 1] / n_near);
    lose(&path->losses, at->material.attenuator + j, -log(fmax(reflectance, 1e-30f)));
  }
  return true;
}

MATERIAL_WITHOUT_BASE(conductor)
