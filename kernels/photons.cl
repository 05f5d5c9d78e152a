// SPDX-License-Identifier: Apache-2.0
// The caustic layer: photons of each wavelength cluster leave the lights towards the caustic objects, are bent by glass and mirrors, and
// are splatted into the pixel that sees the diffuse surface they reach. Unbiased: no map, no radius. One path carries a whole cluster.
#include "shared_types.h"
#include "random.h"
#include "emission.h"
#include "film.h"
#include "world.h"

// 0: nothing can stand between the camera and what it sees.
#ifndef NEPHROID_OCCLUSION
#define NEPHROID_OCCLUSION 1
#endif
#ifndef NEPHROID_PHOTONS_PER_ITEM
#define NEPHROID_PHOTONS_PER_ITEM 1
#endif

// The pixel that sees `position`, or -1; *weight becomes the irradiance-to-pixel factor in m^-2: a flux F deposited there adds
// F reflectance / pi * weight to the pixel's radiance.
// A pixel's value is the mean of the radiance over its area A on the plane at distance 1, so F enters as F dq / (dA A), with
// dq / dA = cos(theta) distance / z^3 (theta at the surface, z along the view axis).
static inline int project_to_pixel(const DeviceCamera* camera, float3 position, float3 geometric, float3 arriving, float metres_per_unit,
                                   float* weight)
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

// The last emitter that begins at this photon or before it, by bisection.
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

// Where a photon ended, and what is left of its power there.
typedef struct {
  int outcome; // OUTCOME_*
  float left;  // 0..1
  Surface surface; // of a deposit
  uint triangle;
  float3 xyz; // of a deposit: reflected light, as if the photon carried the light's whole power
} PhotonEnd;

// Follows a photon to the first diffuse surface, out of the scene, or to its last interface. Leaves `path` on its last way.
static inline PhotonEnd trace_photon(const World* world, const DeviceEmitter* emitter, Path* path, uint2 seed, uint pass, uint photon)
{
  PhotonEnd end;
  end.outcome = OUTCOME_LOST;
  end.left = 1.0f;
  bool met_caustic_object = false;
  float4 choices = (float4)(0.0f);
  for (int surface_number = 0; surface_number <= NEPHROID_MAX_SURFACES; ++surface_number) {
    const Hit hit = next_hit(world, path);
    if (hit.primitive == NEPHROID_NO_PRIMITIVE) {
      end.outcome = met_caustic_object ? OUTCOME_ESCAPED : OUTCOME_MISSED;
      break;
    }
    end.surface = surface_at(&world->geometry, world->objects, hit);
    end.triangle = hit.primitive;
    const DeviceMaterial material = material_of(world, end.surface.object);
    lose_in_medium(world, path, hit.t);
    if (material.type == MATERIAL_DIFFUSE) {
      end.outcome = met_caustic_object ? OUTCOME_DEPOSITED : OUTCOME_MISSED;
      if (!met_caustic_object) return end;
      float share = emitter->share;
      end.xyz = reflected_light(world, &path->losses, emitter->light, emitter->cluster, material.reflector, &share);
      end.left = share / emitter->share;
      return end;
    }
    if (surface_number == NEPHROID_MAX_SURFACES) break;
    met_caustic_object = true;
    if ((surface_number & 3) == 0) choices = random4(seed, pass, photon, 2u + (uint)surface_number / 4u, STREAM_PHOTONS);
    float n_ratio;
    if (!bend_path(world, path, hit.primitive, &end.surface, &material, emitter->cluster, choices.x, &n_ratio)) break;
    choices = choices.yzwx;
  }
  if (path->losses.any) end.left = attenuated_sum(&world->tables, &path->losses, emitter->light, emitter->cluster, -1).w / emitter->share;
  return end;
}

// Adds a deposited photon to the pixel that sees it. False where the film refused it.
static inline bool splat(const World* world, const DeviceCamera* camera, const PhotonEnd* end, float3 arriving, float watts,
                         volatile __global long* film, float film_scale, float dither)
{
  float weight;
  const int pixel = project_to_pixel(camera, end->surface.position, end->surface.geometric, arriving, world->scene.metres_per_unit, &weight);
  if (pixel < 0) return true;
#if NEPHROID_OCCLUSION
  const float3 from = start_on_side(&end->surface, dot(arriving, end->surface.geometric) < 0.0f ? 1.0f : -1.0f);
  const float3 way = camera->position.xyz - from;
  const float distance = length(way);
  if (is_blocked(world, from, way / distance, distance, end->triangle)) return true;
#endif
  return film_add_dithered(film, pixel, end->xyz * (watts * weight / PI_F), film_scale, FILM_LIMIT, dither);
}

// Photons offset, offset + stride, offset + 2 stride, ... (count of them) of a pass.
__kernel void photons(WORLD_ARGUMENTS, __global const DeviceTarget* targets, __global const DeviceEmitter* emitters,
                      volatile __global long* film, volatile __global long* energy, // [OUTCOME_COUNT]
                      DeviceCamera camera, uint2 seed, uint pass, uint offset, uint stride, uint count, float film_scale, float energy_scale)
{
  const World world = WORLD;
  long outcomes[OUTCOME_COUNT] = {0};
  film = film_of_pass(film, pass, camera.width * camera.height);
  for (uint k = 0; k < NEPHROID_PHOTONS_PER_ITEM; ++k) {
    const uint number = (uint)get_global_id(0) * NEPHROID_PHOTONS_PER_ITEM + k;
    if (number >= count) break;
    const uint photon = offset + stride * number;
    const DeviceEmitter emitter = emitters[emitter_of(emitters, scene.emitter_count, photon)];
    const DeviceLight light = lights[emitter.light];
    const float4 place = is_light(&light, LIGHT_AREA) ? random4(seed, pass, photon, 1u, STREAM_PHOTONS) : (float4)(0.0f);
    const float4 random = random4(seed, pass, photon, 0u, STREAM_PHOTONS); // w: the film's
    const Emission emission = emit(&light, targets, &scene, random, place);
    if (emission.watts == 0.0f) continue;
    const float watts = emission.watts / (float)emitter.photon_count; // as if the cluster had all of the light's power
    Path path = {emission.origin, emission.direction, NEPHROID_NO_PRIMITIVE, light.inside, no_losses(), emission.behind};
    const PhotonEnd end = trace_photon(&world, &emitter, &path, seed, pass, photon);
    if (end.outcome == OUTCOME_DEPOSITED && !splat(&world, &camera, &end, path.direction, watts, film, film_scale, random.w))
      ++outcomes[OUTCOME_REFUSED];

    const long quanta = convert_long_rte(watts * emitter.share * energy_scale);
    const long left = end.left >= 1.0f ? quanta : convert_long_rte((float)quanta * end.left);
    outcomes[OUTCOME_EMITTED] += quanta;
    outcomes[end.outcome] += left;
    outcomes[OUTCOME_ABSORBED] += quanta - left;
  }
  for (int i = 0; i < OUTCOME_COUNT; ++i)
    if (outcomes[i] != 0) add_exactly(energy + i, outcomes[i]);
}
