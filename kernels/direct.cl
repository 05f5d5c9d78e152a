// SPDX-License-Identifier: Apache-2.0
// The direct layer: paths from the eye, through glass and mirrors, to the first diffuse surface, lit there by what of each light
// arrives unbent. Glass and mirrors block those shadow rays: what they let through is the caustic layer's.
#include "shared_types.h"
#include "random.h"
#include "bvh.h"
#include "fresnel.h"
#include "film.h"
#include "media.h"
#include "surface.h"
#include "interface.h"
#include "attenuation.h"
#include "light.h"

// What the plan sets; these defaults make the file build alone.
#ifndef NEPHROID_MAX_SURFACES
#define NEPHROID_MAX_SURFACES 32
#endif
#ifndef NEPHROID_ATTENUATORS
#define NEPHROID_ATTENUATORS 1
#endif

#define STREAM_CAMERA 1u
#define STREAM_CAMERA_LIGHT 2u
#define STREAM_CAMERA_CLUSTER 3u

// Irradiance in W m^-2 that a light of the whole spectrum gives a surface point, without shadows; the way to it and how far.
typedef struct {
  float irradiance;
  float3 direction;
  float distance; // INFINITY: directional
} Arrival;

static inline Arrival arrive_from(const DeviceLight* light, float3 position, float3 normal, float metres_per_unit, float2 place)
{
  Arrival arrival = {0.0f, -light->direction.xyz, INFINITY};
  if (light->type == LIGHT_DIRECTIONAL) {
    arrival.irradiance = light->radiometric * max(dot(arrival.direction, normal), 0.0f);
    return arrival;
  }
  const float3 source = light->type == LIGHT_AREA ? area_point(light, place) : light->position.xyz;
  const float3 way = source - position;
  arrival.distance = length(way);
  arrival.direction = way / arrival.distance;
  const float cosine = max(dot(arrival.direction, normal), 0.0f);
  const float cos_light = -dot(arrival.direction, light->direction.xyz);
  float watts_per_steradian = light->radiometric / (4.0f * PI_F);
  if (light->type == LIGHT_SPOT) watts_per_steradian = in_spot(light, -arrival.direction) ? light->radiometric / light->solid_angle : 0.0f;
  if (light->type == LIGHT_AREA) watts_per_steradian = light->radiometric * max(cos_light, 0.0f) / PI_F;
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

// One sample of every pixel of rows first_row .. first_row + row_count - 1.
__kernel void direct(__global const float* nodes, __global const float* blocks, __global const uint* corners,
                     __global const float* positions, __global const float* normals, __global const uint* object_of_triangle,
                     __global const DeviceObject* objects, __global const DeviceMaterial* materials, __global const DeviceLight* lights,
                     __global const float* index_of_refraction, // [cluster][material]
                     __global const float4* reflected_xyz,      // [light][cluster][reflector]: sum of light * reflectance * (xbar, ybar, zbar)
                     __global const float4* reflected_xyz_all,  // [light][reflector]: the same over all clusters
                     __global const float* cluster_cdf,         // [cluster + 1]: which cluster a path through glass takes
                     __global const int* cluster_first, __global const int* cluster_wavelengths, __global const float* coefficient,
                     __global const float4* light_xyz, __global const float* reflectance, int reflector_count,
                     volatile __global long* film, volatile __global long* energy, // [OUTCOME_COUNT]: only refused ones are counted
                     DeviceScene scene, DeviceCamera camera, uint2 seed,
                     uint frame, int first_row, int row_count, float film_scale)
{
  const int index = (int)get_global_id(0);
  if (index >= row_count * camera.width) return;
  const int column = index % camera.width, row = first_row + index / camera.width;
  const uint pixel = (uint)(row * camera.width + column);
  const Geometry geometry = {nodes, blocks, corners, positions, normals, object_of_triangle, scene.root};
#if NEPHROID_ATTENUATORS > 0
  const SpectralTables tables = {cluster_first, cluster_wavelengths, coefficient, light_xyz, reflectance};
#endif
  const float4 first_random = random4(seed, frame, pixel, 0u, STREAM_CAMERA);

  float3 origin = camera.position.xyz, direction = primary_direction(&camera, column, row, first_random.xy);
  Media media = camera.inside;
  int cluster = -1; // chosen where the path first meets glass; without glass all wavelengths go the same way
  float radiance_scale = 1.0f;
  uint skip = NEPHROID_NO_PRIMITIVE;
#if NEPHROID_ATTENUATORS > 0
  float lengths[NEPHROID_ATTENUATORS];
  for (int a = 0; a < NEPHROID_ATTENUATORS; ++a) lengths[a] = 0.0f;
  bool attenuated = false;
#endif
  float4 choices = (float4)(0.0f);
  for (int surface_number = 0; surface_number <= NEPHROID_MAX_SURFACES; ++surface_number) {
    const Hit hit = closest_hit(nodes, blocks, scene.root, origin, direction, INFINITY, skip);
    if (hit.primitive == NEPHROID_NO_PRIMITIVE) return;
    const Surface surface = surface_at(&geometry, objects, hit);
    const DeviceMaterial material = materials[objects[surface.object].material];
    const int medium = medium_object(&media, objects);
#if NEPHROID_ATTENUATORS > 0
    if (medium >= 0) {
      const int attenuator = materials[objects[medium].material].attenuator;
      if (attenuator >= 0) {
        lengths[attenuator] += hit.t * scene.metres_per_unit;
        attenuated = true;
      }
    }
#endif
    const float side = dot(direction, surface.geometric) < 0.0f ? 1.0f : -1.0f;
    if (material.type == MATERIAL_DIFFUSE) {
      const float3 from = start_on_side(&surface, side);
      float3 xyz = (float3)(0.0f);
      for (int l = 0; l < scene.light_count; ++l) {
        const DeviceLight light = lights[l];
        const float4 place = random4(seed, frame, pixel, (uint)l, STREAM_CAMERA_LIGHT);
        const Arrival arrival = arrive_from(&light, surface.position, side * surface.shading, scene.metres_per_unit, place.xy);
        if (!(arrival.irradiance > 0.0f) || !(side * dot(arrival.direction, surface.geometric) > 0.0f)) continue;
        if (any_hit(nodes, blocks, scene.root, from, arrival.direction, arrival.distance, hit.primitive)) continue;
        float3 light_reflected;
        if (cluster < 0)
          light_reflected = reflected_xyz_all[l * reflector_count + material.reflector].xyz;
        else {
          light_reflected = reflected_xyz[(l * scene.cluster_count + cluster) * reflector_count + material.reflector].xyz;
#if NEPHROID_ATTENUATORS > 0
          if (attenuated) light_reflected = attenuated_sum(&tables, lengths, l, cluster, material.reflector).xyz;
#endif
          light_reflected /= cluster_cdf[cluster + 1] - cluster_cdf[cluster];
        }
        xyz += light_reflected * (arrival.irradiance * radiance_scale / PI_F);
      }
      if (!film_add(film, (int)pixel, xyz, film_scale)) add_exactly(energy + OUTCOME_REFUSED, 1);
      return;
    }
    if (surface_number == NEPHROID_MAX_SURFACES) return;
    if ((surface_number & 3) == 0) choices = random4(seed, frame, pixel, 1u + (uint)surface_number / 4u, STREAM_CAMERA);
    const float choice = choices.x;
    choices = choices.yzwx;
    if (cluster < 0) {
      // Steps of the golden ratio from a start of the pixel's own: successive frames spread over the clusters evenly.
      const uint start = philox4x32((uint4)(pixel, 0u, 0u, STREAM_CAMERA_CLUSTER), seed).x;
      const float place = (float)((start + frame * 2654435769u) >> 8) * 0x1p-24f;
      cluster = 0;
      while (cluster + 1 < scene.cluster_count && place >= cluster_cdf[cluster + 1]) ++cluster;
    }
    Bend bend;
    float n_ratio = 1.0f;
#if NEPHROID_MIRRORS
    if (material.type == MATERIAL_MIRROR) {
      bend = bend_at_surface(direction, &surface, 1.0f, 1.0f, -1.0f);
#if NEPHROID_ATTENUATORS > 0
      if (material.attenuator >= 0) {
        lengths[material.attenuator] += 1.0f;
        attenuated = true;
      }
#endif
    } else
#endif
    {
      __global const float* n_of = index_of_refraction + cluster * scene.material_count;
      if (!cross_interface(&media, &surface, objects, n_of, medium, direction, choice, &bend, &n_ratio)) return;
      radiance_scale *= n_ratio * n_ratio; // radiance over n^2 is what a path keeps
    }
    direction = bend.direction;
    origin = start_on_side(&surface, bend.transmitted ? -side : side);
    skip = hit.primitive;
  }
}
