// SPDX-License-Identifier: Apache-2.0
// What a path carries of a light's spectrum.
#include "kernels/lights/environment.h"
#include "kernels/tracing/world.h"

// XYZ of a row's light in all members up to `number` and in a part of that, as a reflector sends it.
static inline float3 light_before(const World* world, int row, Reflector reflector, int number, float part) {
  const SpectralTables* tables = &world->tables;
  const int members = tables->cluster_first[world->scene.cluster_count], reflectors = world->scene.reflector_count,
            wavelength = tables->cluster_wavelengths[number];
  __global const float4* before = world->reflected_before + row * (reflectors + 1) * members + number;
  float3 xyz = part * wavelength_light(tables, row, wavelength, reflector).xyz;
  if (is_white(reflector)) return xyz + before[reflectors * members].xyz;
#if NEPHROID_TEXTURES
  if (reflector.is_textured)
    return xyz + reflector.rgb.x * before[(reflector.row + 1) * members].xyz +
           reflector.rgb.y * before[(reflector.row + 2) * members].xyz +
           reflector.rgb.z * before[(reflector.row + 3) * members].xyz;
#endif
  return xyz + before[reflector.row * members].xyz;
}

// carried_light of one row of the tables of lights.
static inline float4 carried_row(const World* world, const Throughput* throughput, int light, const Band* band,
                                 Reflector reflector) {
  const SpectralTables* tables = &world->tables;
  if (is_unsplit(throughput, band)) {
    const float4 all =
        band->chance *
        (is_white(reflector)
             ? members_light(tables, light, 0, tables->cluster_first[world->scene.cluster_count], reflector)
             : reflected_colour_of(world->reflected_xyz_all, light * world->scene.reflector_count, reflector));
    return are_coloured(&throughput->all)
               ? coloured_light(tables, &throughput->all, all, light, &band->all, reflector)
               : throughput->all.middle * all;
  }
  if (NEPHROID_JITTER && band->size > 0.0f) {
    const Member first = member_at(world, band->low), last = member_at(world, band->low + band->size);
    const float4 all = (float4)(light_before(world, light, reflector, last.number, last.part) -
                                light_before(world, light, reflector, first.number, first.part), 0.0f);
    return are_coloured(&throughput->own) ? coloured_light(tables, &throughput->own, all, light, &band->own, reflector)
                                          : throughput->own.middle * all;
  }
#if NEPHROID_JITTER || NEPHROID_DIFFERENTIALS
  if (band->wavelength >= 0)
    return part_left(throughput) * band->weight *
           wavelength_light(tables, light, made_late(band->wavelength), reflector);
#endif
  const int cluster = made_late(band->cluster),
            row = (light * world->scene.cluster_count + cluster) * world->scene.reflector_count;
  const float4 all = is_white(reflector)
                         ? members_light(tables, light, tables->cluster_first[cluster],
                                         tables->cluster_first[cluster + 1], reflector)
                         : reflected_colour_of(tables->reflected_xyz, row, reflector);
  return are_coloured(&throughput->own) ? coloured_light(tables, &throughput->own, all, light, &band->own, reflector)
                                        : part_left(throughput) * all;
}

// wavelength_light of a source.
static inline float4 source_wavelength_light(const World* world, Source source, int wavelength, Reflector reflector) {
  const SpectralTables* tables = &world->tables;
  if (is_of_environment(world, source.light))
    return source.rgb.x * wavelength_light(tables, source.light, wavelength, reflector) +
           source.rgb.y * wavelength_light(tables, source.light + 1, wavelength, reflector) +
           source.rgb.z * wavelength_light(tables, source.light + 2, wavelength, reflector);
  return wavelength_light(tables, source.light, wavelength, reflector);
}

// What a path carries of a light of power 1. w: the power. xyz: as a reflector sends it.
IN_PLACE float4 carried_light(const World* world, const Throughput* throughput, Source source, const Band* band,
                              Reflector reflector) {
  if (is_of_environment(world, source.light))
    return source.rgb.x * carried_row(world, throughput, source.light, band, reflector) +
           source.rgb.y * carried_row(world, throughput, source.light + 1, band, reflector) +
           source.rgb.z * carried_row(world, throughput, source.light + 2, band, reflector);
  return carried_row(world, throughput, source.light, band, reflector);
}

// The share of a row's power that a band begins with.
static inline float row_share(const World* world, int light, const Band* band) {
#if NEPHROID_JITTER
  if (band->wavelength >= 0)
    return band->weight * world->tables.light_xyz[light * WAVELENGTH_COUNT + band->wavelength].w;
#endif
  const int row = light * world->scene.cluster_count + band->cluster;
  return world->tables.reflected_xyz[row * max(world->scene.reflector_count, 1)].w; // any reflector's is a white one's
}

// The share of a light's power that a band begins with. cluster_share: a lamp's share in the whole cluster.
static inline float band_share(const World* world, Source source, const Band* band, float cluster_share) {
  if (is_of_environment(world, source.light))
    return source.rgb.x * row_share(world, source.light, band) +
           source.rgb.y * row_share(world, source.light + 1, band) +
           source.rgb.z * row_share(world, source.light + 2, band);
  return NEPHROID_JITTER && band->wavelength >= 0 ? row_share(world, source.light, band) : cluster_share;
}

// The share of a light's power that a path began with which ends in this state. share: band_share.
static inline float share_at_end(const World* world, const Throughput* throughput, Source source, const Band* band,
                                 float share) {
  const Throughput full = full_throughput();
  return is_unsplit(throughput, band) ? carried_light(world, &full, source, band, reflector_of_row(0)).w : share;
}

// The part of that which is left. Again any reflector does.
static inline float power_left(const World* world, const Throughput* throughput, Source source, const Band* band,
                               float share) {
  const bool unsplit = is_unsplit(throughput, band),
             coloured = are_coloured(unsplit ? &throughput->all : &throughput->own);
  if (!coloured || (band->wavelength >= 0 && !unsplit)) return part_left(throughput);
  if (share == 0.0f) return 1.0f; // an environment's, whose colours cancel
  return carried_light(world, throughput, source, band, reflector_of_row(0)).w / share;
}
