// SPDX-License-Identifier: Apache-2.0
// A path from the eye through glass and mirrors to the first diffuse surface, and each lamp's unbent light there.
#include "kernels/tracing/camera.h"
#include "kernels/lights/arrival.h"
#include "kernels/tracing/film.h"
#include "kernels/tracing/low_discrepancy.h"
#include "kernels/tracing/world.h"

// A path through glass is noisy: a pixel that sees glass or a mirror takes this many paths a sample.
#define PATHS_THROUGH_GLASS 4u

// Four numbers for sample `sample` of a pixel. They come from a sequence as in light_numbers, with `paths` samples a
// pass, or are plain random numbers where paths is 0. block: which four.
static inline float4 eye_numbers(uint2 seed, uint sample, uint paths, uint pixel, uint block, uint stream) {
#if NEPHROID_LOW_DISCREPANCY
  if (paths > 0u) {
    const uint frame = sample / paths, index = frame / NEPHROID_FILM_HALVES * paths + sample % paths;
    return sobol4(seed, (uint3)(pixel, stream << 8 | block, frame % NEPHROID_FILM_HALVES), 3u, index);
  }
#endif
  return random4(seed, sample, pixel, block, stream);
}

// Moves a camera to where the path of a place in a pixel begins, at a place of its lens by eye_numbers.
static inline void begin_on_lens(DeviceCamera* camera, uint pixel, float2 place, uint2 seed, uint sample, uint paths,
                                 uint stream) {
#if NEPHROID_LENS
  stand_on_lens(camera, pixel, place, eye_numbers(seed, sample, paths, pixel, LENS_BLOCK, stream).xy);
#endif
}

// What the camera sees first in the direction of a place in a pixel. place: in [0, 1) x [0, 1). The camera moves to
// where that path begins.
static inline Hit first_hit(const World* world, DeviceCamera* camera, uint pixel, float2 place, uint2 seed, uint sample,
                            uint stream, float3* direction) {
  begin_on_lens(camera, pixel, place, seed, sample, 1u, stream);
  *direction = primary_direction(camera, (int)pixel % camera->width, (int)pixel / camera->width, place);
  Path path = path_from_eye(camera, *direction);
  return next_hit(world, &path);
}

// Adds a sample to its pixel, and counts it in `energy` where it is too bright for the film. limit: limit_of_sample's.
static inline void add_sample(volatile __global long* film, volatile __global long* energy, const DeviceCamera* camera,
                              uint pixel, uint frame, float3 xyz, float scale, float limit, float dither) {
  if (!film_add_dithered(film_of_iteration(film, frame, camera->width * camera->height), (int)pixel, xyz, scale, limit,
                         dither))
    add_exactly(energy + OUTCOME_REFUSED, 1);
}

// Whether a path from the eye met a matt surface at once, so that all wavelengths went the same way.
static inline bool is_unbent(const World* world, const DeviceCamera* camera, const Hit* first) {
  const int object = object_of_primitive(&world->geometry, first->primitive);
  const DeviceMaterial material = material_of(world, object);
  return is_matt(&material) && is_in_air(&camera->inside);
}

// Whether what the camera sees first has a coat, which reflects a part of its light.
static inline bool shows_coat(const World* world, const Hit* first) {
  const DeviceMaterial material = material_of(world, object_of_primitive(&world->geometry, first->primitive));
  return is_plastic(&material);
}

// A mirror, total reflection and glass that does not bend leave one way.
static inline bool leaves_one_way(const Bend* bend) { return bend->reflectance == 0.0f || bend->reflectance == 1.0f; }

// Continues a path at the glass or mirror that it meets first. reflected: whether it is reflected there or goes on
// through, where there are both ways. *share: the factor of the radiance there. False: the path is lost, or would reach
// the base of a plastic.
IN_PLACE bool first_bend(const World* world, Path* path, const Hit* hit, const Band* band, bool reflected,
                         float2 facet_choice, float* share, Bend* bend) {
  const Surface surface = surface_at(&world->geometry, *hit);
  const DeviceMaterial material = material_at(world, &surface, hit->primitive);
  if (is_plastic(&material) && !reflected) return false;
  lose_in_medium(world, path, hit->t);
  float n_ratio;
  if (!bend_path_as(world, path, hit->primitive, &surface, &material, band, reflected ? 0.0f : 1.0f, facet_choice,
                    &n_ratio, bend))
    return false;
  const float part = bend->transmitted ? 1.0f - bend->reflectance : bend->reflectance;
  *share = part * n_ratio * n_ratio;
  return true;
}

#if NEPHROID_ROUGH
// The XYZ radiance of a lamp that a rough surface sends to the path which arrives there: reflected, or through the
// surface from beyond. paths: as in irradiance_of.
static inline float3 highlight(const World* world, int light_index, bool beyond, const Path* path,
                               const Surface* surface, uint triangle, const DeviceMaterial* material, const Band* band,
                               uint2 seed, uint sample, uint paths, uint pixel) {
  DeviceLight light = world->lights[light_index];
  const float side = dot(path->direction, surface->geometric) < 0.0f ? 1.0f : -1.0f, light_side = beyond ? -side : side;
  const float3 n = normal_before(path->direction, surface), view = -path->direction;
  const float4 place = has_lamp_places(&light) ? light_numbers(&light, seed, sample, paths, pixel) : (float4)(0.0f);
  choose_in_lamp(world, &light, place.xy);
  const Arrival arrival = arrive_from_lamp(world, &light, surface->position, beyond ? -n : n, place.xy);
  if (!(arrival.irradiance > 0.0f) || !(light_side * dot(arrival.direction, surface->geometric) > 0.0f))
    return (float3)(0.0f);
  Path bent = *path;
  float3 normal = normalize(view + arrival.direction);
  float part;
  if (beyond) {
    Sides sides;
    if (!find_sides(&path->media, surface, world->objects, index_of_band(world, band), path->direction, &sides))
      return (float3)(0.0f);
    normal = facet_between(view, arrival.direction, n, sides.n_near, sides.n_far);
    if (!(dot(view, normal) > 0.0f) || !(dot(arrival.direction, normal) < 0.0f)) return (float3)(0.0f);
    part = transmitted_by_facets(view, arrival.direction, n, normal, sides.n_near, sides.n_far, material->alpha);
  } else
    part = reflected_by_facets(view, arrival.direction, n, normal, material->alpha);
  Surface facet = *surface;
  facet.shading = side * normal;
  Bend bend;
  float n_ratio;
  if (!bend_about(world, &bent, triangle, &facet, material, band, beyond ? 2.0f : -1.0f, &n_ratio, &bend) ||
      bend.straight || bend.transmitted != beyond)
    return (float3)(0.0f);
  if (is_hidden(world, surface, start_on_side(surface, light_side), &arrival, triangle))
    return (float3)(0.0f);
  const Source lamp = {light_index, (float3)(1.0f)};
  return carried_light(world, &bent.losses, lamp, band, white_reflector()).xyz *
         (arrival.irradiance * part * (beyond ? 1.0f - bend.reflectance : bend.reflectance));
}

// The same of all lamps on both sides.
static inline float3 highlights(const World* world, const Path* path, const Surface* surface, uint triangle,
                                const DeviceMaterial* material, const Band* band, uint2 seed, uint sample, uint paths,
                                uint pixel) {
  SET_ASIDE float3 xyz = (float3)(0.0f);
  for (int l = 0; l < world->scene.light_count; ++l)
    for (int beyond = 0; beyond < (material->type == MATERIAL_DIELECTRIC ? 2 : 1); ++beyond)
      if (!is_of_environment(world, l)) // which paths find
        xyz += highlight(world, l, beyond, path, surface, triangle, material, band, seed, sample, paths, pixel);
  return xyz;
}
#endif

// Continues a path through glass and mirrors in one band to a diffuse surface or out of the scene. known: `hit` is its
// next hit. `hit` and, at a diffuse surface, `surface` become those of its end. Returns the factor of the radiance
// there, 0 where the path is lost: a path keeps radiance over n^2 (Nicodemus 1963, "Radiance"). stream: for the numbers
// that choose between reflection and refraction. likelier: takes the likelier of both, for a preview.
// shine: with NEPHROID_HIGHLIGHTS, what is added to it on the way.
#ifdef NEPHROID_HIGHLIGHTS
typedef struct {
  float3 xyz;     // light of lamps that rough surfaces send back on the way
  bool by_facets; // the path was bent by a rough surface last: what it meets of a lamp is in xyz
} Shine;
#define SHINE_PARAMETER , Shine* shine
#define SHINE , shine
#else
#define SHINE_PARAMETER
#define SHINE
#endif
IN_PLACE float trace_to_diffuse(const World* world, Path* path, Hit* hit, bool known, const Band* band, uint2 seed,
                                uint sample, uint paths, uint pixel, uint stream, bool likelier, Surface* surface
                                SHINE_PARAMETER) {
  float radiance_scale = 1.0f;
  SET_ASIDE float4 choices = (float4)(0.0f);
  for (int surface_number = 0; surface_number <= world->scene.max_surfaces; ++surface_number) {
    if (surface_number > 0 || !known) *hit = next_hit(world, path);
    if (hit->primitive == NEPHROID_NO_PRIMITIVE) return radiance_scale;
    *surface = surface_of(world, *hit);
    const DeviceMaterial material = material_at(world, surface, hit->primitive);
    lose_in_medium(world, path, hit->t);
    if (material.type == MATERIAL_DIFFUSE) return radiance_scale;
    if ((surface_number & 3) == 0)
      choices = likelier ? (float4)(0.5f)
                         : eye_numbers(seed, sample, surface_number == 0 ? paths : 0u, pixel,
                                       1u + (uint)surface_number / 4u, stream);
#if NEPHROID_ROUGH && defined(NEPHROID_HIGHLIGHTS)
    if (material.alpha > 0.0f)
      shine->xyz += radiance_scale * highlights(world, path, surface, hit->primitive, &material, band, seed, sample,
                                                max(paths, 1u), pixel + 0x9e3779b9u * (1u + (uint)surface_number));
#endif
    const float2 facet = facet_numbers(seed, sample, pixel, (uint)surface_number, stream);
    if (ends_at(world, path->direction, surface, &material, choices.x, facet)) return radiance_scale;
    float n_ratio;
    Bend bend;
    if (!bend_path_as(world, path, hit->primitive, surface, &material, band, choices.x, facet, &n_ratio, &bend))
      return 0.0f;
#ifdef NEPHROID_HIGHLIGHTS
    shine->by_facets = material.alpha > 0.0f && !bend.straight;
#endif
    radiance_scale *= n_ratio * n_ratio;
    choices = choices.yzwx;
  }
  return 0.0f;
}

// trace_to_diffuse to a diffuse surface only: 0 where the path leaves the scene.
IN_PLACE float reach_diffuse(const World* world, Path* path, Hit* hit, const Band* band, uint2 seed, uint sample,
                             uint paths, uint pixel, uint stream, Surface* surface SHINE_PARAMETER) {
  const float radiance_scale =
      trace_to_diffuse(world, path, hit, true, band, seed, sample, paths, pixel, stream, false, surface SHINE);
  return hit->primitive == NEPHROID_NO_PRIMITIVE ? 0.0f : radiance_scale;
}
