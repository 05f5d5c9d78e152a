// SPDX-License-Identifier: Apache-2.0
// Lamps that have a table: a mesh, a rectangle with a picture, a point with photometry.
#include "kernels/lights/light.h"
#include "kernels/tracing/world.h"

// 1: some rectangle has a picture.
#ifndef NEPHROID_LIGHT_PICTURES
#define NEPHROID_LIGHT_PICTURES 0
#endif

// 1: some point has photometry.
#ifndef NEPHROID_PHOTOMETRY
#define NEPHROID_PHOTOMETRY 0
#endif

// *light becomes an area light that is one place.
static inline void shine_from(DeviceLight* light, float3 place) {
  light->position.xyz = place;
  light->edge_u = light->edge_v = (float4)(0.0f);
}

// Whether a triangle or ellipsoid is one of a lamp's mesh.
static inline bool is_on_lamp(const World* world, int light_index, uint primitive) {
#if NEPHROID_LIGHT_TYPES >> LIGHT_MESH & 1
  const DeviceLight light = world->lights[light_index];
  return is_light(&light, LIGHT_MESH) && primitive - (uint)as_int(light.edge_v.w) < (uint)as_int(light.edge_u.w);
#else
  return false;
#endif
}

// A place of a mesh, even over its area: a triangle or ellipsoid in proportion to its area, and a place on it. What
// chances are rounded by, and where an ellipsoid is stretched, *light makes up for in power.
static inline void choose_in_mesh(const World* world, DeviceLight* light, float2 place) {
#if NEPHROID_LIGHT_TYPES >> LIGHT_MESH & 1
  if (!is_light(light, LIGHT_MESH)) return;
  __global const float* cdf = world->lamp_tables + light->table;
  const int chosen = choose(cdf, as_int(light->edge_u.w), place.x);
  const float chance = cdf[chosen] - chance_before(cdf, chosen), rest = place_in_bin(cdf, chosen, place.x);
  const uint number = (uint)(as_int(light->edge_v.w) + chosen);
  const DevicePrimitive primitive = world->geometry.primitives[number];
  Hit hit;
  hit.primitive = number;
  hit.u = 1.0f - sqrt(rest); // uniform over a triangle (Turk 1990)
  hit.v = place.y * (1.0f - hit.u);
  float area = 0.5f * length(cross(primitive.edge_u.xyz, primitive.edge_v.xyz));
#if NEPHROID_ELLIPSOIDS
  if (is_ellipsoid(&primitive)) {
    const float z = 2.0f * rest - 1.0f, radius = 2.0f * sqrt(rest * fmax(1.0f - rest, 0.0f));
    float cosine_phi;
    const float sine_phi = sincos(2.0f * PI_F * place.y, &cosine_phi);
    hit.u = radius * cosine_phi;
    hit.v = radius * sine_phi;
    hit.w = z;
    // The area of a steradian of the unit sphere is |M^T u| / det M, and the rows of M are perpendicular.
    area = 4.0f * PI_F * length(ellipsoid_gradient(&primitive, (float3)(hit.u, hit.v, z))) /
           (length(primitive.edge_u.xyz) * length(primitive.edge_v.xyz) * length(primitive.normal.xyz));
  }
#endif
  Surface surface = surface_at(&world->geometry, hit);
  if (is_ellipsoid(&primitive)) surface.offset *= 16.0f; // paths do not know that they leave it, as they do after a hit
  light->type = LIGHT_AREA;
  light->direction.xyz = surface.geometric;
  light->radiometric *= area / (light->solid_angle * chance);
  shine_from(light, start_on_side(&surface, 1.0f));
#endif
}

// A place of a rectangle in proportion to the luminance of its picture.
static inline void choose_in_picture(const World* world, DeviceLight* light, float2 place) {
#if NEPHROID_LIGHT_PICTURES
  if (!is_light(light, LIGHT_AREA) || light->table < 0) return;
  const int width = as_int(light->edge_u.w), height = as_int(light->edge_v.w);
  __global const float* rows = world->lamp_tables + light->table;
  const int row = choose(rows, height, place.y);
  __global const float* columns = rows + height + (size_t)row * (size_t)width;
  const int column = choose(columns, width, place.x);
  const float2 within = {((float)column + place_in_bin(columns, column, place.x)) / (float)width,
                         1.0f - ((float)row + place_in_bin(rows, row, place.y)) / (float)height};
  shine_from(light, area_point(light, within));
#endif
}

// A lamp whose light comes from different places becomes, in *light, a lamp at one of them: directional light of a
// disc, an area light of a mesh or of a picture.
static inline void choose_in_lamp(const World* world, DeviceLight* light, float2 place) {
  choose_in_disc(light, place);
  choose_in_picture(world, light, place);
  choose_in_mesh(world, light, place);
}

// A lamp's intensity in a unit direction away from it, over the mean of all directions.
static inline float photometric(const World* world, const DeviceLight* light, float3 direction) {
#if NEPHROID_PHOTOMETRY
  if (!is_light(light, LIGHT_POINT) || light->table < 0) return 1.0f;
  const float along = dot(direction, light->direction.xyz), x = dot(direction, light->edge_u.xyz),
              y = dot(direction, light->edge_v.xyz), turns = atan2(y, x) / (2.0f * PI_F);
  const float gamma = atan2(sqrt(x * x + y * y), along) / PI_F * (float)(PHOTOMETRY_GAMMAS - 1),
              c = (turns - floor(turns)) * (float)(PHOTOMETRY_PLANES - 1);
  const int step = clamp((int)gamma, 0, PHOTOMETRY_GAMMAS - 2), plane = clamp((int)c, 0, PHOTOMETRY_PLANES - 2);
  __global const float* near = world->lamp_tables + light->table + plane * PHOTOMETRY_GAMMAS + step;
  const float2 low = vload2(0, near), high = vload2(0, near + PHOTOMETRY_GAMMAS);
  const float2 mixed = mix(low, high, c - (float)plane);
  return mix(mixed.x, mixed.y, gamma - (float)step);
#else
  return 1.0f;
#endif
}
