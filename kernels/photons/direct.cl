// SPDX-License-Identifier: Apache-2.0
// The direct layer: paths from the eye, through glass and mirrors, to the first diffuse surface, which each light
// reaches unbent. Glass and mirrors block those shadow rays: light that passes them belongs to the caustic layer.
#define NEPHROID_HIGHLIGHTS 1
#include "kernels/photons/launch_types.h"
#include "kernels/transport/branches.h"
#include "kernels/transport/eye_band.h"
#include "kernels/transport/sweep.h"
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
                      Reflector reflector, const Band* band, uint2 seed, uint sample, uint paths, uint pixel) {
  SET_ASIDE float3 xyz = (float3)(0.0f);
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

// The XYZ radiance that the surface at a path's end sends back along it. Where the path's wavelengths go different
// ways, each quarter of its part of the spectrum has a place of its own.
IN_PLACE float3 shade_end(const World* world, const Path* path, const Interaction* at, bool shines, const Band* band,
                          uint2 seed, uint sample, uint paths, uint pixel) {
  const bool swept = is_swept(world, path, band);
  SET_ASIDE float3 xyz = (float3)(0.0f);
  for (int i = 0; i < (swept ? 4 : 1); ++i) {
    Surface surface = at->surface;
    uint triangle = at->triangle;
    Band shown = *band;
    if (swept) {
      shown = quarter_of_band(band, i);
      move_end(world, path, beyond_leader(world, band, number_of_four_wavelengths(&band->own, i)), &surface, &triangle);
    }
    const Reflector reflector = reflector_at(world, &surface, triangle);
    xyz += shade(world, path, &surface, triangle, shines, reflector, &shown, seed, sample, paths, pixel);
  }
  return xyz;
}

// Follows the branches of a path that has hit `first` through glass and mirrors. Returns the XYZ radiance of its band.
// One of all wavelengths (cluster -1) ends at once on that surface, or on its base below a coat. With `after_base` that
// path has been followed already, and others do not end there.
IN_PLACE float3 follow(const World* world, const Path* path, Hit first, const Band* band, bool after_base, uint2 seed,
                       uint frame, uint i, uint paths, uint pixel) {
  Visitor eye;
  begin_branches(&eye, path, band, seed, frame, i, paths, pixel, STREAM_CAMERA);
  SET_ASIDE float3 xyz = (float3)(0.0f);
  do {
    Interaction at;
    int last = 0;
    const bool at_once = band->cluster < 0;
    if (at_once) {
      at = interaction_at(world, first);
      eye.branch.share = part_to_base(world, &at.surface, path->direction);
    } else if (follow_branch(world, &eye, &first, &at, &last) != WALK_AT_BASE || (after_base && last == 0))
      continue;
    const bool shines = !eye.branch.by_microfacets && dot(eye.branch.path.direction, at.surface.geometric) < 0.0f;
    xyz += eye.branch.share * eye.branch.scale *
           shade_end(world, &eye.branch.path, &at, shines, band, seed, eye.sample, paths,
                     pixel + 0x9e3779b9u * eye.met); // each end has places of lamps of its own
  } while (next_branch(&eye));
  return xyz + eye.shine;
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
  const DeviceMaterial met = material_of_hit(&world, &hit);
  const uint straight = unbent ? 1u : 0u, bent = unbent && !has_coat(&met) ? 0u : paths_through(&world, hit);
  SET_ASIDE float3 xyz = (float3)(0.0f), outwards = direction;
  SET_ASIDE Hit first = hit;
  for (uint i = 0; i < straight + bent; ++i) {
    const Path way = path_from_eye(eye, outwards);
    const bool is_bent = i >= straight;
    Band band = whole_cluster(-1);
    float chance = 1.0f;
    if (is_bent)
      band = band_of_eye_path(&world, launch.seed, frame, i - straight, bent, pixel, STREAM_CAMERA_CLUSTER, &chance);
    xyz += follow(&world, &way, first, &band, unbent, launch.seed, frame, is_bent ? i - straight : 0u,
                  is_bent ? bent : 1u, pixel) /
           (is_bent ? chance * (float)bent : 1.0f);
  }
  add_sample(film, energy, &camera, pixel, frame, xyz, launch.film_scale,
             limit_of_sample(frame, launch.enough, launch.film_limit), jitter.z);
}
