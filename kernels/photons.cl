// SPDX-License-Identifier: Apache-2.0
// The caustic layer: photons of each wavelength cluster leave the lights towards the caustic objects, are bent by glass and mirrors, and
// are splatted into the pixel that sees the diffuse surface they reach. Unbiased: no map, no radius. One path carries a whole cluster.
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
#include "emission.h"

// What the plan sets; these defaults make the file build alone.
#ifndef NEPHROID_MAX_SURFACES
#define NEPHROID_MAX_SURFACES 32
#endif
#ifndef NEPHROID_ATTENUATORS
#define NEPHROID_ATTENUATORS 1
#endif
#ifndef NEPHROID_PHOTONS_PER_ITEM
#define NEPHROID_PHOTONS_PER_ITEM 1
#endif

#define STREAM_PHOTONS 0u

// The pixel that sees `position`, or -1; *weight becomes the irradiance-to-pixel factor in m^-2: a flux F deposited there adds
// F reflectance / pi * weight to the pixel's radiance.
// A pixel's value is the mean of the radiance over its area A on the plane at distance 1, so F enters as F dq / (dA A), with
// dq / dA = cos(theta) distance / z^3 (theta at the surface, z along the view axis).
static inline int project_to_pixel(const DeviceCamera* camera, float3 position, float3 geometric, float3 arriving, float metres_per_unit, float* weight)
{
  const float3 to_camera = camera->position.xyz - position;
  const float cos_camera = dot(to_camera, geometric), cos_arriving = -dot(arriving, geometric);
  if (!(cos_camera * cos_arriving > 0.0f)) return -1; // seen from its other side
  const float z = -dot(to_camera, camera->forward.xyz);
  if (!(z > 0.0f)) return -1;
  const float x = 0.5f - 0.5f * dot(to_camera, camera->right.xyz) / (z * camera->tan_x);
  const float y = 0.5f + 0.5f * dot(to_camera, camera->up.xyz) / (z * camera->tan_y);
  if (!(x >= 0.0f && x < 1.0f && y >= 0.0f && y < 1.0f)) return -1;
  const float pixel_area = 4.0f * camera->tan_x * camera->tan_y / ((float)camera->width * (float)camera->height);
  const float depth = z * metres_per_unit;
  // cos_camera is cos(theta) times the distance already.
  *weight = fabs(cos_camera) / (z * depth * depth * pixel_area);
  const int column = min((int)(x * (float)camera->width), camera->width - 1);
  const int row = min((int)(y * (float)camera->height), camera->height - 1);
  return row * camera->width + column;
}

static inline int emitter_of(__global const DeviceEmitter* emitters, int count, uint photon)
{
  int low = 0, high = count - 1;
  while (low < high) {
    const int middle = (low + high + 1) >> 1;
    if (emitters[middle].first_photon <= photon)
      low = middle;
    else
      high = middle - 1;
  }
  return low;
}

// Photons offset, offset + stride, offset + 2 stride, ... (count of them) of a pass with photons_per_pass.
__kernel void photons(__global const float* nodes, __global const float* blocks, __global const uint* corners,
                      __global const float* positions, __global const float* normals, __global const uint* object_of_triangle,
                      __global const DeviceObject* objects, __global const DeviceMaterial* materials, __global const DeviceLight* lights,
                      __global const DeviceTarget* targets, __global const DeviceEmitter* emitters,
                      __global const float* index_of_refraction, // [cluster][material]
                      __global const float4* reflected_xyz,      // [light][cluster][reflector]: sum of light * reflectance * (xbar, ybar, zbar)
                      __global const int* cluster_first, __global const int* cluster_wavelengths, __global const float* coefficient,
                      __global const float4* light_xyz, __global const float* reflectance, int reflector_count,
                      volatile __global long* film, volatile __global long* energy, // [OUTCOME_COUNT]
                      DeviceScene scene, DeviceCamera camera, uint2 seed, uint pass, uint offset, uint stride, uint count, float film_scale,
                      float energy_scale)
{
  const Geometry geometry = {nodes, blocks, corners, positions, normals, object_of_triangle, scene.root};
#if NEPHROID_ATTENUATORS > 0
  const SpectralTables tables = {cluster_first, cluster_wavelengths, coefficient, light_xyz, reflectance};
#endif
  long outcomes[OUTCOME_COUNT] = {0};
  for (int k = 0; k < NEPHROID_PHOTONS_PER_ITEM; ++k) {
    const uint number = (uint)get_global_id(0) * NEPHROID_PHOTONS_PER_ITEM + (uint)k;
    if (number >= count) break;
    const uint photon = offset + stride * number;
    const DeviceEmitter emitter = emitters[emitter_of(emitters, scene.emitter_count, photon)];
    const DeviceLight light = lights[emitter.light];
    const float4 place = light.type == LIGHT_AREA ? random4(seed, pass, photon, 1u, STREAM_PHOTONS) : (float4)(0.0f);
    const Emission emission = emit(&light, targets, &scene, random4(seed, pass, photon, 0u, STREAM_PHOTONS), place);
    if (emission.watts == 0.0f) continue;
    const float watts = emission.watts / (float)emitter.photon_count; // as if the cluster had all of the light's power
    const long quanta = convert_long_rte(watts * emitter.share * energy_scale);
    outcomes[OUTCOME_EMITTED] += quanta;

    __global const float* n_of = index_of_refraction + emitter.cluster * scene.material_count;
    Media media = light.inside;
    float3 origin = emission.origin, direction = emission.direction;
    uint skip = NEPHROID_NO_PRIMITIVE;
    bool met_caustic_object = false;
    int outcome = OUTCOME_LOST;
    float kept = 1.0f; // of the photon's power when it ends
#if NEPHROID_ATTENUATORS > 0
    float lengths[NEPHROID_ATTENUATORS];
    for (int a = 0; a < NEPHROID_ATTENUATORS; ++a) lengths[a] = 0.0f;
#endif
    float4 choices = (float4)(0.0f);
    for (int surface_number = 0; surface_number <= NEPHROID_MAX_SURFACES; ++surface_number) {
      const Hit hit = closest_hit(nodes, blocks, scene.root, origin, direction, INFINITY, skip);
      if (hit.primitive == NEPHROID_NO_PRIMITIVE) {
        outcome = met_caustic_object ? OUTCOME_ESCAPED : OUTCOME_MISSED;
        break;
      }
      const Surface surface = surface_at(&geometry, objects, hit);
      const DeviceMaterial material = materials[objects[surface.object].material];
      const int medium = medium_object(&media, objects);
#if NEPHROID_ATTENUATORS > 0
      if (medium >= 0) {
        const int attenuator = materials[objects[medium].material].attenuator;
        if (attenuator >= 0) lengths[attenuator] += hit.t * scene.metres_per_unit;
      }
#endif
      if (material.type == MATERIAL_DIFFUSE) {
        outcome = met_caustic_object ? OUTCOME_DEPOSITED : OUTCOME_MISSED;
        if (!met_caustic_object) break;
#if NEPHROID_ATTENUATORS > 0
        const float4 sum = attenuated_sum(&tables, lengths, emitter.light, emitter.cluster, material.reflector);
        const float3 xyz = sum.xyz;
        kept = sum.w / emitter.share;
#else
        const float3 xyz = reflected_xyz[(emitter.light * scene.cluster_count + emitter.cluster) * reflector_count + material.reflector].xyz;
#endif
        float weight;
        const int pixel = project_to_pixel(&camera, surface.position, surface.geometric, direction, scene.metres_per_unit, &weight);
        if (pixel < 0) break;
        const float3 from = start_on_side(&surface, dot(direction, surface.geometric) < 0.0f ? 1.0f : -1.0f);
        const float3 way = camera.position.xyz - from;
        const float distance = length(way);
        if (any_hit(nodes, blocks, scene.root, from, way / distance, distance, hit.primitive)) break;
        if (!film_add(film, pixel, xyz * (watts * weight / PI_F), film_scale)) ++outcomes[OUTCOME_REFUSED];
        break;
      }
      if (surface_number == NEPHROID_MAX_SURFACES) break;
      met_caustic_object = true;
      if ((surface_number & 3) == 0) choices = random4(seed, pass, photon, 2u + (uint)surface_number / 4u, STREAM_PHOTONS);
      const float choice = choices.x;
      choices = choices.yzwx;
      const bool outside = dot(direction, surface.geometric) < 0.0f; // the side that the photon comes from
      Bend bend;
#if NEPHROID_MIRRORS
      if (material.type == MATERIAL_MIRROR) {
        bend = bend_at_surface(direction, &surface, 1.0f, 1.0f, -1.0f);
#if NEPHROID_ATTENUATORS > 0
        if (material.attenuator >= 0) lengths[material.attenuator] += 1.0f;
#endif
      } else
#endif
      {
        float n_ratio;
        if (!cross_interface(&media, &surface, objects, n_of, medium, direction, choice, &bend, &n_ratio)) break;
      }
      direction = bend.direction;
      origin = start_on_side(&surface, outside == bend.transmitted ? -1.0f : 1.0f);
      skip = hit.primitive;
    }
#if NEPHROID_ATTENUATORS > 0
    if (outcome == OUTCOME_ESCAPED || outcome == OUTCOME_LOST)
      kept = attenuated_sum(&tables, lengths, emitter.light, emitter.cluster, -1).w / emitter.share;
#endif
    const long kept_quanta = kept >= 1.0f ? quanta : convert_long_rte((float)quanta * kept);
    outcomes[outcome] += kept_quanta;
    outcomes[OUTCOME_ABSORBED] += quanta - kept_quanta;
  }
  for (int i = 0; i < OUTCOME_COUNT; ++i)
    if (outcomes[i] != 0) add_exactly(energy + i, outcomes[i]);
}
