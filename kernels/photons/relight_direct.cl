// SPDX-License-Identifier: Apache-2.0
// The direct layer for relighting: direct.cl, whose samples go into layers (layers.h). Where nothing is bent, all
// wavelengths of a lamp take the same path and share one layer. Through glass and mirrors each cluster of each lamp has
// its own. Before the first pass a survey finds the reflectors that each pixel sees.
#include "kernels/photons/launch_types.h"
#include "kernels/photons/layers.h"
#include "kernels/tracing/item_kernel.h"
#include "kernels/transport/eye_walk.h"

// Each work item finds the reflector at each fixed place of one pixel, -1 where there is none.
ITEM_KERNEL(survey, (WORLD_ARGUMENTS, DeviceCamera camera, uint2 seed, __global int* unbent, // [pixel][SURVEY_PLACES]
                     __global int* bent), // [pixel][SURVEY_PLACES * SURVEY_PATHS]
                    (WORLD_NAMES, camera, seed, unbent, bent)) {
  const World world = WORLD;
  const int pixel = (int)index;
  if (pixel >= camera.width * camera.height) return;
  for (int place = 0; place < SURVEY_PLACES; ++place) {
    const float2 jitter = (float2)(place % 2 == 0 ? 0.25f : 0.75f, place < 2 ? 0.25f : 0.75f);
    const float3 direction = primary_direction(&camera, pixel % camera.width, pixel / camera.width, jitter);
    Path first_way = path_from_eye(&camera, direction);
    const Hit first = next_hit(&world, &first_way);
    const bool hits = first.primitive != NEPHROID_NO_PRIMITIVE, straight = hits && is_unbent(&world, &camera, &first);
    unbent[pixel * SURVEY_PLACES + place] =
        straight ? material_of_hit(&world, &first).reflector : -1;
    for (int p = 0; p < SURVEY_PATHS; ++p) {
      const uint number = (uint)(place * SURVEY_PATHS + p);
      int seen = -1;
      if (hits && !straight) {
        const float choice = random4(seed, number, (uint)pixel, 0u, STREAM_SURVEY).x;
        const Band band = whole_cluster(min((int)(choice * (float)scene.cluster_count), scene.cluster_count - 1));
        Path path = first_way;
        Hit hit = first;
        Visitor eye = eye_visitor(&band, seed, number, 0u, (uint)pixel, STREAM_CAMERA);
        Interaction at;
        if (reach_base(&world, &eye, &path, &hit, &at) > 0.0f) seen = at.material.reflector;
      }
      bent[pixel * SURVEY_PLACES * SURVEY_PATHS + (int)number] = seen;
    }
  }
}

// Takes one sample of every pixel of some rows. mean_reflectance: [cluster, then all clusters][reflector].
ITEM_KERNEL(direct, (WORLD_ARGUMENTS, __global const float* cluster_cdf, __global const float* mean_reflectance,
                     __global const float* luminance_share, // [cluster]: for a flat spectrum
                     LAYER_FILM_ARGUMENTS(unbent), LAYER_FILM_ARGUMENTS(bent), volatile __global long* energy,
                     DeviceCamera camera, DeviceRowLaunch launch),
                    (WORLD_NAMES, cluster_cdf, mean_reflectance, luminance_share, LAYER_FILM_NAMES(unbent),
                     LAYER_FILM_NAMES(bent), energy, camera, launch)) {
  const World world = WORLD;
  const int place = (int)index;
  if (place >= launch.row_count * camera.width) return;
  const LayerFilm unbent = LAYER_FILM(unbent, launch.frame), bent = LAYER_FILM(bent, launch.frame);
  const int column = place % camera.width, row = launch.first_row + place / camera.width,
            pixel = row * camera.width + column;
  const float4 jitter = place_numbers(launch.seed, launch.frame, (uint)pixel);
  const float3 direction = primary_direction(&camera, column, row, jitter.xy);
  Path first_way = path_from_eye(&camera, direction);
  const Hit first = next_hit(&world, &first_way);
  if (first.primitive == NEPHROID_NO_PRIMITIVE) return;

  const bool straight = is_unbent(&world, &camera, &first);
  const int all = scene.cluster_count;
  long refused = 0;
  for (uint i = 0; i < (straight ? 1u : PATHS_THROUGH_GLASS); ++i) {
    const uint sample = straight ? launch.frame : launch.frame * PATHS_THROUGH_GLASS + i;
    Band band = whole_cluster(-1);
    float weight = 1.0f;
    if (!straight) {
      const int cluster = choose_cluster(cluster_cdf, all, launch.seed, launch.frame, i, PATHS_THROUGH_GLASS,
                                         (uint)pixel, STREAM_CAMERA_CLUSTER);
      band = flat_cluster(&world.tables, cluster,
                          golden_place_of_four(launch.seed, launch.frame, i, (uint)pixel, STREAM_CAMERA_WAVELENGTH));
      weight = 1.0f / ((cluster_cdf[band.cluster + 1] - cluster_cdf[band.cluster]) * (float)PATHS_THROUGH_GLASS);
    }
    Path path = first_way;
    Hit hit = first;
    Visitor eye = eye_visitor(&band, launch.seed, sample, 0u, (uint)pixel, STREAM_CAMERA);
    Interaction at;
    weight *= reach_base(&world, &eye, &path, &hit, &at);
    if (weight == 0.0f) continue;
    weight *= flat_part_left(&path.throughput);
    const int reflector = at.material.reflector;
    for (int l = 0; l < scene.light_count; ++l) {
      const float radiance = weight *
                             irradiance_of(&world, l, &path, &at.surface, at.triangle, launch.seed, sample,
                                           straight ? 1u : PATHS_THROUGH_GLASS, (uint)pixel) /
                             PI_F;
      if (radiance == 0.0f) continue;
      bool taken;
      if (straight)
        taken = layer_add(&unbent, pixel, reflector, l, radiance, launch.film_scale, launch.film_limit,
                          mean_reflectance + all * scene.reflector_count, jitter.z);
      else if (has_cells(&bent, pixel))
        taken = layer_add(&bent, pixel, reflector, l * all + band.cluster, radiance, launch.film_scale,
                          launch.film_limit, mean_reflectance + band.cluster * scene.reflector_count, jitter.z);
      else // the survey missed a sliver of glass here, whose light counts as unbent
        taken = layer_add(&unbent, pixel, reflector, l, radiance * luminance_share[band.cluster], launch.film_scale,
                          launch.film_limit, mean_reflectance + all * scene.reflector_count, jitter.z);
      if (!taken) ++refused;
    }
  }
  if (refused > 0) add_exactly(energy + OUTCOME_REFUSED, refused);
}
