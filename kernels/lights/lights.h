// SPDX-License-Identifier: Apache-2.0
// What a light can do. Each is a file of this folder, by the list in light_types.h, and says three things of itself:
//   point_has_places  whether its light comes from different places: of a surface, of a disc far away, of the sky
//   point_place       one of them, for two numbers in [0, 1): even over its light
//   point_watts       the power that it sends from there into a small solid angle about a direction
// The rest follows, and is below: a sample towards a point (sample_towards), a photon (emit) or one of a lattice with
// its footprint (emit_on_lattice). Radiance is for meshes to say (is_on_lamp, mesh_radiance), which alone paths meet,
// and for background.h. Power is DeviceLight::radiometric. pbrt-v4 has the same verbs: SampleLi, SampleLe, L, Phi.
#include "kernels/lights/area.h"
#include "kernels/lights/directional.h"
#include "kernels/lights/environment.h"
#include "kernels/lights/mesh.h"
#include "kernels/lights/point.h"
#include "kernels/lights/spectrum.h"
#include "kernels/lights/spot.h"
#include "kernels/lights/targets.h"
#include "kernels/scatter/scatter.h"
#include "kernels/tracing/registers.h"
#include "kernels/tracing/world.h"

#define LIGHT_PLACES(word, NAME, Row, has, sentence) \
  if (is_light(light, LIGHT_##NAME)) return word##_has_places(light);
#define LIGHT_PLACE(word, NAME, Row, has, sentence) \
  if (is_light(light, LIGHT_##NAME)) return word##_place(world, light, u);
#define LIGHT_WATTS(word, NAME, Row, has, sentence) \
  if (is_light(light, LIGHT_##NAME)) return word##_watts(light, place, direction, steradians);

static inline bool has_places(__global const DeviceLight* light) {
  ALL_LIGHTS(LIGHT_PLACES)
  return false;
}

static inline LightPlace place_of_lamp(const World* world, __global const DeviceLight* light, float2 u) {
  LIGHTS(LIGHT_PLACE)
  return place_at((float3)(0.0f), (float3)(0.0f), 0.0f);
}

static inline LightPlace place_of(const World* world, __global const DeviceLight* light, float2 u) {
  return is_light(light, LIGHT_ENVIRONMENT) ? environment_place(world, light, u) : place_of_lamp(world, light, u);
}

static inline float watts_into(__global const DeviceLight* light, const LightPlace* place, float3 direction,
                               float steradians) {
  ALL_LIGHTS(LIGHT_WATTS)
  return 0.0f;
}

// The part of a place's power that it sends that way: what a luminaire's measured table says, and what passes the coat
// of an object that shines.
static inline float part_sent(const World* world, __global const DeviceLight* light, const LightPlace* place,
                              float3 direction) {
  const float part = photometric(world, light, direction);
  if (!HAS_LIGHTS(LIGHT_MESH) || place->object < 0) return part;
  const DeviceMaterial material = material_of(world, place->object);
  if (!has_coat(&material)) return part;
  Surface surface;
  surface.object = place->object;
  surface.shading = place->direction;
  return part * part_to_base(world, &surface, direction);
}

// The irradiance in W m^-2 that a light's whole spectrum gives a surface point, without shadows, and the way to the
// lamp: I cos(theta) / d^2 with the intensity I at one of its places, E cos(theta) of parallel light.
typedef struct {
  float irradiance;
  float3 direction;
  float distance; // INFINITY: parallel light
} LightSample;

static inline LightSample sample_towards(const World* world, __global const DeviceLight* light, float3 position,
                                         float3 normal, float2 u) {
  const LightPlace from = place_of_lamp(world, light, u);
  LightSample sample = {0.0f, -from.direction, INFINITY};
  if (from.is_parallel) {
    sample.irradiance = from.radiometric * max(dot(sample.direction, normal), 0.0f);
    return sample;
  }
  const float3 way = from.position - position;
  sample.distance = length(way);
  sample.direction = way / sample.distance;
  const float cosine = max(dot(sample.direction, normal), 0.0f);
  const float watts_per_steradian = watts_into(light, &from, -sample.direction, 1.0f);
  const float metres = sample.distance * world->scene.metres_per_unit;
  sample.irradiance = watts_per_steradian * cosine / (metres * metres);
  sample.irradiance *= part_sent(world, light, &from, -sample.direction);
  return sample;
}

// A photon of a light, sent towards its targets. u: has_places.
COMPILED_ONCE Emission emit(const World* world, int index, float4 random, float2 u) {
  __global const DeviceLight* light = world->lights + index;
  __global const DeviceTarget* targets = world->targets + light->first_target;
  const LightPlace from = place_of(world, light, u);
  Emission emission = {from.position, from.direction, 0.0f, 0.0f};
  if (from.is_parallel)
    emission = emit_parallel(from.direction, from.radiometric, targets, light->target_count, &world->scene, random);
  else if (is_light(light, LIGHT_SPOT) && is_tighter(light, targets))
    emission = emit_in_cone(light, index, random);
  else {
    const float steradians = sample_targets(targets, light->target_count, from.position, random, &emission);
    emission.watts = watts_into(light, &from, emission.direction, steradians) *
                     part_sent(world, light, &from, emission.direction);
    emission.behind *= UP_TO_LAMP;
  }
  emission.source.light = index;
  emission.source.rgb = from.rgb;
  return emission;
}

// Where a photon of a lattice starts. disc: its place in the square [-1, 1] x [-1, 1], of which the unit disc stands
// for the target of that number, or for the cone of a spot (-1). d: derivatives by the place. The density is that of
// `emit` with as many photons in the disc as it sends there.
static inline Emission emit_on_lattice(const World* world, int index, int target, float2 disc, float2 u,
                                       Differential d[2]) {
  __global const DeviceLight* light = world->lights + index;
  const int target_count = light->target_count;
  __global const DeviceTarget* targets = world->targets + light->first_target;
  const LightPlace from = place_of(world, light, u);
  Emission emission;
  if (from.is_parallel)
    emission =
        parallel_lattice(from.direction, from.radiometric, targets, target_count, &world->scene, target, disc, d);
  else {
    emission = cone_lattice(from.position, from.direction, light->as.spot.one_minus_cos, targets, target, disc, d);
    emission.watts = light->radiometric;
    if (target >= 0) {
      const Densities of = densities_from(targets, target_count, from.position);
      const float steradians = steradians_a_photon(targets, target_count, target, &of, from.position, &emission);
      emission.watts = watts_into(light, &from, emission.direction, steradians) *
                       part_sent(world, light, &from, emission.direction);
      emission.behind *= UP_TO_LAMP;
    }
  }
  emission.source.light = index;
  emission.source.rgb = from.rgb;
  return emission;
}
