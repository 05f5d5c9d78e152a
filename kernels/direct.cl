// SPDX-License-Identifier: Apache-2.0
// The direct layer: paths from the eye, through glass and mirrors, to the first diffuse surface, lit there by what of each light
// arrives unbent. Glass and mirrors block those shadow rays: what they let through is the caustic layer's.
#include "shared_types.h"
#include "random.h"
#include "film.h"
#include "light.h"
#include "world.h"

// A path through glass follows one cluster and one branch of each reflection, so it is noisy: a pixel that sees glass or a mirror takes
// this many paths a sample.
#define PATHS_THROUGH_GLASS 4u

// Irradiance in W m^-2 that a light of the whole spectrum gives a surface point, without shadows; the way to it and how far:
// I cos(theta) / d^2 with the intensity I = P / (4 pi) of a point, P / (its cone's solid angle) of a spot, and P cos(theta') / pi
// of an area light, of which one place stands for all; E cos(theta) of directional light.
typedef struct {
  float irradiance;
  float3 direction;
  float distance; // INFINITY: directional
} Arrival;

static inline Arrival arrive_from(const DeviceLight* light, float3 position, float3 normal, float metres_per_unit, float2 place)
{
  Arrival arrival = {0.0f, -light->direction.xyz, INFINITY};
  if (is_light(light, LIGHT_DIRECTIONAL)) {
    arrival.irradiance = light->radiometric * max(dot(arrival.direction, normal), 0.0f);
    return arrival;
  }
  const float3 source = is_light(light, LIGHT_AREA) ? area_point(light, place) : light->position.xyz;
  const float3 way = source - position;
  arrival.distance = length(way);
  arrival.direction = way / arrival.distance;
  const float cosine = max(dot(arrival.direction, normal), 0.0f);
  const float cos_light = -dot(arrival.direction, light->direction.xyz);
  float watts_per_steradian = light->radiometric / (4.0f * PI_F);
  if (is_light(light, LIGHT_SPOT)) watts_per_steradian = in_spot(light, -arrival.direction) ? light->radiometric / light->solid_angle : 0.0f;
  if (is_light(light, LIGHT_AREA)) watts_per_steradian = light->radiometric * max(cos_light, 0.0f) / PI_F;
  const float metres = arrival.distance * metres_per_unit;
  arrival.irradiance = watts_per_steradian * cosine / (metres * metres);
  return arrival;
}

static inline float3 primary_direction(const DeviceCamera* camera, int column, int row, float2 jitter)
{
  const float x = 2.0f * ((float)column + jitter.x) / (float)camera->width - 1.0f;
  const float y = 1.0f - 2.0f * ((float)row + jitter.y) / (float)camera->height;
  return normalize(camera->forward.xyz + (x * camera->tan_x) * camera->right.xyz + (y * camera->tan_y) * camera->up.xyz);
}

// XYZ radiance that a diffuse surface sends back along the path. cluster -1: all wavelengths, which went the same way.
static inline float3 shade(const World* world, const Path* path, const Surface* surface, uint triangle, int reflector, int cluster,
                           __global const float4* reflected_xyz_all, uint2 seed, uint sample, uint pixel)
{
  const float side = dot(path->direction, surface->geometric) < 0.0f ? 1.0f : -1.0f;
  const float3 from = start_on_side(surface, side);
  float3 xyz = (float3)(0.0f);
  for (int l = 0; l < world->scene.light_count; ++l) {
    const DeviceLight light = world->lights[l];
    const float4 place = is_light(&light, LIGHT_AREA) ? random4(seed, sample, pixel, (uint)light.number, STREAM_CAMERA_LIGHT) : (float4)(0.0f);
    const Arrival arrival = arrive_from(&light, surface->position, side * surface->shading, world->scene.metres_per_unit, place.xy);
    if (!(arrival.irradiance > 0.0f) || !(side * dot(arrival.direction, surface->geometric) > 0.0f)) continue;
    if (is_blocked(world, from, arrival.direction, arrival.distance, triangle)) continue;
    float left;
    const float3 reflected = cluster < 0 ? reflected_xyz_all[l * world->reflector_count + reflector].xyz
                                         : reflected_light(world, &path->losses, l, cluster, reflector, &left);
    xyz += reflected * (arrival.irradiance / PI_F);
  }
  return xyz;
}

// Takes a path that has hit `first` on through glass and mirrors in one cluster. Returns XYZ radiance of that cluster's light alone.
static inline float3 follow(const World* world, Path path, Hit first, int cluster, __global const float4* reflected_xyz_all, uint2 seed,
                            uint sample, uint pixel)
{
  float radiance_scale = 1.0f; // radiance over n^2 is what a path keeps (Nicodemus 1963, "Radiance")
  Hit hit = first;
  float4 choices = (float4)(0.0f);
  for (int surface_number = 0; surface_number <= NEPHROID_MAX_SURFACES; ++surface_number) {
    if (surface_number > 0) hit = next_hit(world, &path);
    if (hit.primitive == NEPHROID_NO_PRIMITIVE) break;
    const Surface surface = surface_at(&world->geometry, world->objects, hit);
    const DeviceMaterial material = material_of(world, surface.object);
    lose_in_medium(world, &path, hit.t);
    if (material.type == MATERIAL_DIFFUSE)
      return radiance_scale * shade(world, &path, &surface, hit.primitive, material.reflector, cluster, reflected_xyz_all, seed, sample, pixel);
    if ((surface_number & 3) == 0) choices = random4(seed, sample, pixel, 1u + (uint)surface_number / 4u, STREAM_CAMERA);
    float n_ratio;
    if (!bend_path(world, &path, hit.primitive, &surface, &material, cluster, choices.x, &n_ratio)) break;
    radiance_scale *= n_ratio * n_ratio;
    choices = choices.yzwx;
  }
  return (float3)(0.0f);
}

// Which cluster a path of a pixel takes: steps of the golden ratio, so that the samples of a pixel spread over the clusters evenly. Even
// and odd frames each have a start of their own and count by themselves: they are independent, as the film's two halves have to be.
static inline int choose_cluster(__global const float* cdf, int count, uint2 seed, uint frame, uint path, uint pixel)
{
  const uint half_of_frames = frame & 1u, step = (frame >> 1) * PATHS_THROUGH_GLASS + path;
  const uint start = philox4x32((uint4)(pixel, half_of_frames, 0u, STREAM_CAMERA_CLUSTER), seed).x;
  const float place = (float)((start + step * 2654435769u) >> 8) * 0x1p-24f;
  int cluster = 0;
  while (cluster + 1 < count && place >= cdf[cluster + 1]) ++cluster;
  return cluster;
}

// One sample of every pixel of rows first_row .. first_row + row_count - 1.
__kernel void direct(WORLD_ARGUMENTS, __global const float4* reflected_xyz_all, // [light][reflector]: reflected_xyz over all clusters
                     __global const float* cluster_cdf,                         // [cluster + 1]: which cluster a path through glass takes
                     volatile __global long* film, volatile __global long* energy, // [OUTCOME_COUNT]: only refused ones are counted
                     DeviceCamera camera, uint2 seed, uint frame, int first_row, int row_count, float film_scale,
                     float film_limit)
{
  const World world = WORLD;
  const int index = (int)get_global_id(0);
  if (index >= row_count * camera.width) return;
  const int column = index % camera.width, row = first_row + index / camera.width;
  const uint pixel = (uint)(row * camera.width + column);
  const float4 jitter = random4(seed, frame, pixel, 0u, STREAM_CAMERA);
  const Path path = {camera.position.xyz, primary_direction(&camera, column, row, jitter.xy), NEPHROID_NO_PRIMITIVE, camera.inside, no_losses(), 0.0f};
  const Hit hit = next_hit(&world, &path);
  if (hit.primitive == NEPHROID_NO_PRIMITIVE) return;

  const bool unbent = material_of(&world, (int)object_of_triangle[hit.primitive]).type == MATERIAL_DIFFUSE && camera.inside.count == 0;
  float3 xyz = (float3)(0.0f);
  if (unbent)
    xyz = follow(&world, path, hit, -1, reflected_xyz_all, seed, frame, pixel);
  else
    for (uint i = 0; i < PATHS_THROUGH_GLASS; ++i) {
      const uint sample = frame * PATHS_THROUGH_GLASS + i;
      const int cluster = choose_cluster(cluster_cdf, scene.cluster_count, seed, frame, i, pixel);
      const float probability = (cluster_cdf[cluster + 1] - cluster_cdf[cluster]) * (float)PATHS_THROUGH_GLASS;
      xyz += follow(&world, path, hit, cluster, reflected_xyz_all, seed, sample, pixel) / probability;
    }
  if (!film_add_dithered(film_of_pass(film, frame, camera.width * camera.height), (int)pixel, xyz, film_scale, film_limit, jitter.z))
    add_exactly(energy + OUTCOME_REFUSED, 1);
}
