// SPDX-License-Identifier: Apache-2.0
// A rectangle that shines to one side by the cosine law, evenly or in proportion to the luminance of a picture.
#include "kernels/lights/light.h"
#include "kernels/tracing/world.h"

// 1: some rectangle has a picture.
#ifndef NEPHROID_LIGHT_PICTURES
#define NEPHROID_LIGHT_PICTURES 0
#endif

static inline bool area_has_places(__global const DeviceLight* light) { return true; }

static inline float3 area_point(__global const DeviceLight* light, float2 place) {
  return light->as.area.centre.xyz + (place.x - 0.5f) * light->as.area.edge_u.xyz +
         (place.y - 0.5f) * light->as.area.edge_v.xyz;
}

// The place in a picture, whose first row is at the end of edge_v.
static inline float2 place_in_picture(const World* world, __global const DeviceLight* light, float2 u) {
  const int width = light->as.area.width, height = light->as.area.height;
  __global const float* rows = world->lamp_tables + light->table;
  const int row = choose(rows, height, u.y);
  __global const float* columns = rows + height + (size_t)row * (size_t)width;
  const int column = choose(columns, width, u.x);
  return (float2)(((float)column + place_in_bin(columns, column, u.x)) / (float)width,
                  1.0f - ((float)row + place_in_bin(rows, row, u.y)) / (float)height);
}

static inline LightPlace area_place(const World* world, __global const DeviceLight* light, float2 u) {
  if (NEPHROID_LIGHT_PICTURES && light->table >= 0) u = place_in_picture(world, light, u);
  return place_at(area_point(light, u), light->as.area.normal.xyz, light->radiometric);
}

static inline float area_watts(__global const DeviceLight* light, const LightPlace* place, float3 direction,
                               float steradians) {
  return watts_of_surface(place, direction, steradians);
}
