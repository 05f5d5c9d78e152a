// SPDX-License-Identifier: Apache-2.0
// What a path carries of a light's spectrum.
#include "kernels/lights/environment.h"
#include "kernels/tracing/world.h"

// carried_light of one row of the tables of lights.
static inline float4 carried_row(const World* world, const Losses* losses, int light, const Band* band,
                                 Reflector reflector) {
#if NEPHROID_JITTER || NEPHROID_DIFFERENTIALS
  if (band->wavelength >= 0) {
    const int wavelength = made_late(band->wavelength);
    const float left = wavelength_left(&world->tables, losses, wavelength) * band->weight;
    const float reflectance = reflectance_of(&world->tables, reflector, wavelength);
    const float4 light_xyz = world->tables.light_xyz[light * WAVELENGTH_COUNT + wavelength];
    return left * (float4)(reflectance * light_xyz.xyz, light_xyz.w);
  }
#endif
  if ((NEPHROID_ATTENUATORS > 0 || HAS_LIGHTS(LIGHT_MESH)) && (losses->any || is_white(reflector)))
    return attenuated_sum(&world->tables, losses, light, band->cluster, reflector);
  const int row = light * world->scene.cluster_count + band->cluster;
  return reflected_colour_of(world->tables.reflected_xyz, row * world->scene.reflector_count, reflector);
}

// What a path carries of a light of power 1 after its losses. w: the power. xyz: as a reflector sends it.
IN_PLACE float4 carried_light(const World* world, const Losses* losses, Source source, const Band* band,
                              Reflector reflector) {
  if (is_of_environment(world, source.light))
    return source.rgb.x * carried_row(world, losses, source.light, band, reflector) +
           source.rgb.y * carried_row(world, losses, source.light + 1, band, reflector) +
           source.rgb.z * carried_row(world, losses, source.light + 2, band, reflector);
  return carried_row(world, losses, source.light, band, reflector);
}

// The share of a row's power that a band begins with.
static inline float row_share(const World* world, int light, const Band* band) {
#if NEPHROID_JITTER
  if (band->wavelength >= 0)
    return band->weight * world->tables.light_xyz[light * WAVELENGTH_COUNT + band->wavelength].w;
#endif
  const Losses none = no_losses();
  return attenuated_sum(&world->tables, &none, light, band->cluster, white_reflector()).w;
}

// The share of a light's power that a band begins with. cluster_share: a lamp's share in the whole cluster.
static inline float band_share(const World* world, Source source, const Band* band, float cluster_share) {
  if (is_of_environment(world, source.light))
    return source.rgb.x * row_share(world, source.light, band) +
           source.rgb.y * row_share(world, source.light + 1, band) +
           source.rgb.z * row_share(world, source.light + 2, band);
  return NEPHROID_JITTER && band->wavelength >= 0 ? row_share(world, source.light, band) : cluster_share;
}
