// SPDX-License-Identifier: Apache-2.0
// The direct layer: paths from the eye, through glass and mirrors, to the first diffuse surface, which each light
// reaches unbent. Glass and mirrors block those shadow rays: light that passes them belongs to the caustic layer.
#define NEPHROID_HIGHLIGHTS
#include "kernels/photons/launch_types.h"
#include "kernels/transport/eye_walk.h"
#include "kernels/tracing/work_item.h"

// The XYZ radiance of a lamp's own surface.
static inline float3 emitted(const World* world, int light_index, const Path* path, const Band* band) {
  const Source lamp = source_lamp(light_index);
  const float3 xyz = band->cluster < 0
                         ? world->lights[light_index].as.mesh.xyz.xyz
                         : carried_light(world, &path->throughput, lamp, band, white_reflector()).xyz;
  return xyz * mesh_radiance(world, world->lights + light_index);
}

// The XYZ radiance that a diffuse surface sends back along the path. shines: with its own where it is a lamp.
IN_PLACE float3 shade(const World* world, const Path* path, const Surface* surface, uint triangle, bool shines,
                      Reflector reflector, const Band* band, uint2 seed,
                      uint sample, uint pixel) {
  SET_ASIDE float3 xyz = (float3)(0.0f);
  const uint paths = band->cluster < 0 ? 1u : PATHS_THROUGH_GLASS;
  for (int l = 0; l < world->scene.light_count; ++l) {
    if (is_of_environment(world, l)) {
      const float3 rgb = sky_irradiance(world, l, path, surface, triangle, seed, sample, paths, pixel);
      const Source sky = {l, rgb / PI_F};
      const int first = l * world->scene.reflector_count, next = world->scene.reflector_count;
      xyz += band->cluster < 0
                 ? sky.rgb.x * reflected_colour_of(world->reflected_xyz_all, first, reflector).xyz +
                       sky.rgb.y * reflected_colour_of(world->reflected_xyz_all, first + next, reflector).xyz +
                       sky.rgb.z * reflected_colour_of(world->reflected_xyz_all, first + 2 * next, reflector).xyz
                 : carried_light(world, &path->throughput, sky, band, reflector).xyz;
      continue;
    }
    if (shines && is_on_lamp(world, l, triangle)) xyz += emitted(world, l, path, band);
    const float irradiance = irradiance_of(world, l, path, surface, triangle, seed, sample, paths, pixel);
    if (irradiance == 0.0f) continue;
    const Source lamp = {l, (float3)(1.0f)};
    const float3 reflected =
        band->cluster < 0
            ? reflected_colour_of(world->reflected_xyz_all, l * world->scene.reflector_count, reflector).xyz
                          : carried_light(world, &path->throughput, lamp, band, reflector).xyz;
    xyz += reflected * (irradiance / PI_F);
  }
  return xyz;
}

// Follows a path that has hit `first` on through glass and mirrors. Returns the XYZ radiance of its band alone. Where
// all its wavelengths go the same way (cluster -1), a coat that it meets first sends it to the base, else back.
IN_PLACE float3 follow(const World* world, Path path, Hit first, const Band* band, uint2 seed, uint sample,
                       uint pixel) {
  Visitor eye =
      eye_visitor(band, seed, sample, band->cluster < 0 ? 1u : PATHS_THROUGH_GLASS, pixel, STREAM_CAMERA);
  if (is_in_air(&path.media) && shows_coat(world, &first))
    eye.first_lobes = band->cluster < 0 ? LOBE_DIFFUSE : LOBE_REFLECTION;
  Interaction at;
  const float radiance_scale = reach_base(world, &eye, &path, &first, &at);
  const float3 xyz = eye.first_shine + eye.share * eye.shine;
  if (radiance_scale == 0.0f) return xyz;
  const bool shines = !eye.by_microfacets && dot(path.direction, at.surface.geometric) < 0.0f;
  const Reflector reflector = reflector_at(world, &at.surface, at.triangle);
  return xyz + radiance_scale * shade(world, &path, &at.surface, at.triangle, shines, reflector, band, seed, sample,
                                      pixel);
}

// samples: [count], each a pixel and the sample's number there.
__kernel void direct(WORLD_ARGUMENTS,
                     volatile __global long* film,
                     volatile __global long* energy, // [OUTCOME_COUNT]: only refused ones are counted
                     DeviceCamera camera, __global const uint2* samples, DeviceSampleLaunch launch) {
  const World world = WORLD;
  const uint index = work_item();
  if (index >= launch.count) return;
  const uint pixel = samples[index].x;
  SET_ASIDE uint frame = samples[index].y;
  SET_ASIDE float4 jitter = eye_numbers(launch.seed, frame, 1u, pixel, 0u, STREAM_CAMERA);
  float3 direction;
  EYE_OF(camera);
  const Hit hit = first_hit(&world, eye, pixel, jitter.xy, launch.seed, frame, STREAM_CAMERA, &direction);
  if (hit.primitive == NEPHROID_NO_PRIMITIVE) return;

  // One call of follow() for both cases: Intel's vectoriser gets two of them wrong (docs/checking.md).
  const bool unbent = is_unbent(&world, &camera, &hit);
  const uint straight = unbent ? 1u : 0u,
             paths = straight + (unbent && !shows_coat(&world, &hit) ? 0u : PATHS_THROUGH_GLASS);
  SET_ASIDE float3 xyz = (float3)(0.0f), outwards = direction;
  SET_ASIDE Hit first = hit;
  for (uint i = 0; i < paths; ++i) {
    const Path way = path_from_eye(eye, outwards);
    const bool bent = i >= straight;
    const uint number = i - (bent ? straight : 0u), sample = bent ? frame * PATHS_THROUGH_GLASS + number : frame;
    Band band = whole_cluster(-1);
    float chance = 1.0f;
    if (bent) {
      const float place = golden_place_of_four(launch.seed, frame, number, pixel, STREAM_CAMERA_CLUSTER);
      band = choose_eye_band(&world, scene.light_count, place, &chance);
    }
    xyz += follow(&world, way, first, &band, launch.seed, sample, pixel) /
           (bent ? chance * (float)PATHS_THROUGH_GLASS : 1.0f);
  }
  add_sample(film, energy, &camera, pixel, frame, xyz, launch.film_scale,
             limit_of_sample(frame, launch.enough, launch.film_limit), jitter.z);
}
