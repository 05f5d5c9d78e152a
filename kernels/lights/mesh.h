// SPDX-License-Identifier: Apache-2.0
// An object whose surface shines evenly to its outside by the cosine law.
#include "kernels/lights/light.h"
#include "kernels/tracing/world.h"

static inline bool mesh_has_places(__global const DeviceLight* light) { return true; }

// A place of a mesh, even over its area: a triangle or ellipsoid in proportion to its area, and a place on it. What
// chances are rounded by, and where an ellipsoid is stretched, the place makes up for in power.
static inline LightPlace mesh_place(const World* world, __global const DeviceLight* light, float2 u) {
  __global const float* cdf = world->lamp_tables + light->table;
  const int chosen = choose(cdf, light->as.mesh.surfaces, u.x);
  const float chance = cdf[chosen] - chance_before(cdf, chosen), rest = place_in_bin(cdf, chosen, u.x);
  const uint number = (uint)(light->as.mesh.first_surface + chosen);
  const DevicePrimitive primitive = world->geometry.primitives[number];
  Hit hit;
  hit.primitive = number;
  hit.u = 1.0f - sqrt(rest); // uniform over a triangle (Turk 1990)
  hit.v = u.y * (1.0f - hit.u);
  float area = 0.5f * length(cross(primitive.edge_u.xyz, primitive.edge_v.xyz));
#if NEPHROID_ELLIPSOIDS
  if (is_ellipsoid(&primitive)) {
    const float z = 2.0f * rest - 1.0f, radius = 2.0f * sqrt(rest * fmax(1.0f - rest, 0.0f));
    float cosine_phi;
    const float sine_phi = sincos(2.0f * PI_F * u.y, &cosine_phi);
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
  LightPlace place = place_at(start_on_side(&surface, 1.0f), surface.geometric,
                              light->radiometric * (area / (light->as.mesh.area * chance)));
  place.object = surface.object;
  return place;
}

static inline float mesh_watts(__global const DeviceLight* light, const LightPlace* place, float3 direction,
                               float steradians) {
  return watts_of_surface(place, direction, steradians);
}

// The radiance of a mesh's surface, of its whole spectrum.
static inline float mesh_radiance(const World* world, __global const DeviceLight* light) {
  const float metres = world->scene.metres_per_unit;
  return light->radiometric / (PI_F * light->as.mesh.area * metres * metres);
}

// Whether a triangle or ellipsoid is one of a lamp's mesh.
static inline bool is_on_lamp(const World* world, int light_index, uint primitive) {
  __global const DeviceLight* light = world->lights + light_index;
  return is_light(light, LIGHT_MESH) &&
         primitive - (uint)light->as.mesh.first_surface < (uint)light->as.mesh.surfaces;
}
