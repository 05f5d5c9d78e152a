// SPDX-License-Identifier: Apache-2.0
// Photons sent towards the caustic objects only. Spheres about them are the targets. A photon picks a target, then a
// direction (parallel light: a place) uniformly inside it. Where targets overlap, each could have made a photon: its
// density is the sum of theirs (balance heuristic; Veach and Guibas 1995).
//
// A target's size is the solid angle, or the area, that it fills. Half of the photons go by size, and half to all
// targets alike: so a glass has photons of its own, however large the varnished table is that it stands on. Without a
// bound a tiny target's photons would be too weak for a film's quanta.
#include "kernels/lights/light.h"
#include "kernels/tracing/frame.h"
#include "kernels/tracing/surface.h"

typedef struct {
  float3 origin, direction; // the photon flies along origin + t direction, t > -behind
  float behind;             // the light is this far behind the origin, which may lie at a small target: see aim
  float watts; // power of the whole spectrum that this photon carries, times the number of photons; 0: not emitted
  Source source;
} Emission;

// A direction about the unit vector n with the density cos(theta) / pi: uniform on the disc below (Malley).
static inline float3 cosine_direction(float3 n, float u, float v) {
  float3 x, y;
  make_frame(n, &x, &y);
  const float radius = sqrt(u);
  float cosine_phi;
  const float sine_phi = sincos(2.0f * PI_F * v, &cosine_phi);
  return normalize(x * (radius * cosine_phi) + y * (radius * sine_phi) + n * sqrt(1.0f - u));
}

// A direction uniform in the cone about axis with 1 - cos(half angle) = one_minus_cos, which stays exact for far and
// small targets. Its part along the axis is 1 - *below, and *aside is the rest.
static inline float3 sample_cone(float3 axis, float one_minus_cos, float u, float v, float* below, float3* aside) {
  float3 x, y;
  make_frame(axis, &x, &y);
  *below = u * one_minus_cos;
  const float sine = sqrt(*below * (2.0f - *below));
  float cosine_phi;
  const float sine_phi = sincos(2.0f * PI_F * v, &cosine_phi);
  *aside = x * (sine * cosine_phi) + y * (sine * sine_phi);
  return normalize(*aside + axis * (1.0f - *below));
}

// 1 - cos of a sphere's half angle as seen from a point; 2 from inside.
static inline float one_minus_cos_of(float4 sphere, float3 from) {
  const float3 way = sphere.xyz - from;
  const float distance2 = dot(way, way), radius2 = sphere.w * sphere.w;
  if (distance2 <= radius2) return 2.0f;
  const float sine2 = radius2 / distance2;
  return sine2 / (1.0f + sqrt(1.0f - sine2));
}

static inline bool meets_sphere(float4 sphere, float3 from, const Emission* photon) {
  const float3 start = sphere.xyz - from, way = sphere.xyz - photon->origin;
  const float along = dot(way, photon->direction), radius2 = sphere.w * sphere.w;
  if (dot(start, start) <= radius2) return true;
  const float3 aside = way - along * photon->direction;
  return along + photon->behind > 0.0f && dot(aside, aside) <= radius2;
}

// Points a photon from `from` at the target at `centre`. A direction is rounded by 2^-24, which a far and small target
// shows. There the photon begins in the plane through its centre and reaches back to the light.
static inline void aim(float3 centre, float one_minus_cos, float3 from, float2 random, Emission* photon) {
  const float3 way = centre - from;
  const float distance2 = dot(way, way); // 0 in the middle of a target, where any axis will do
  const float3 axis = distance2 > 0.0f ? normalize(way) : (float3)(0.0f, 0.0f, 1.0f);
  float below;
  float3 aside;
  photon->direction = sample_cone(axis, one_minus_cos, random.x, random.y, &below, &aside);
  photon->origin = from;
  photon->behind = 0.0f;
  if (one_minus_cos > 1e-3f) return;
  photon->behind = sqrt(distance2) / (1.0f - below);
  photon->origin = centre + photon->behind * aside;
}

// The sizes of a light's targets, and a photon's density in each where no other overlaps it.
typedef struct {
  float size[MAX_TARGETS], density[MAX_TARGETS];
} Densities;

// With sizes that are all 0 a photon carries nothing.
static inline void make_densities(Densities* of, int target_count) {
  float sizes = 0.0f, photons = 0.0f;
  for (int i = 0; i < target_count; ++i) sizes += of->size[i];
  for (int i = 0; i < target_count; ++i) {
    of->density[i] = min(1.0f / ((float)target_count * of->size[i]), MOST_CROWDED / sizes) + 1.0f / sizes;
    photons += of->density[i] * of->size[i];
  }
  for (int i = 0; i < target_count; ++i) of->density[i] = sizes > 0.0f ? of->density[i] / photons : INFINITY;
}

// The number of a target, drawn by random in [0, 1).
static inline int draw_target(const Densities* of, int target_count, float random) {
  int chosen = 0;
  for (; chosen + 1 < target_count; ++chosen) {
    const float share = of->size[chosen] * of->density[chosen];
    if (random < share) break;
    random -= share;
  }
  return chosen;
}

// Sizes are one_minus_cos_of.
static inline Densities densities_from(__global const DeviceTarget* targets, int target_count, float3 from) {
  Densities result;
  for (int i = 0; i < target_count; ++i) result.size[i] = one_minus_cos_of(targets[i].centre_radius, from);
  make_densities(&result, target_count);
  return result;
}

// 1 / density of a photon that was sent towards the target `chosen`.
static inline float steradians_a_photon(__global const DeviceTarget* targets, int target_count, int chosen,
                                        const Densities* of, float3 from, const Emission* photon) {
  float density = 0.0f;
  for (int i = 0; i < target_count; ++i)
    if (i == chosen || meets_sphere(targets[i].centre_radius, from, photon)) density += of->density[i];
  return 2.0f * PI_F / density;
}

// Sends a photon from a point towards the targets: writes its line to *photon. Returns 1 / density in steradians.
static inline float sample_targets(__global const DeviceTarget* targets, int target_count, float3 from, float4 random,
                                   Emission* photon) {
  const Densities of = densities_from(targets, target_count, from);
  const int chosen = draw_target(&of, target_count, random.x);
  aim(targets[chosen].centre_radius.xyz, of.size[chosen], from, random.yz, photon);
  return steradians_a_photon(targets, target_count, chosen, &of, from, photon);
}

// Sizes are the squares of radii.
static inline Densities parallel_densities(__global const DeviceTarget* targets, int target_count) {
  Densities result;
  for (int i = 0; i < target_count; ++i)
    result.size[i] = targets[i].centre_radius.w * targets[i].centre_radius.w;
  make_densities(&result, target_count);
  return result;
}

// What a photon of parallel light carries that starts at a place of the target `chosen`.
static inline float parallel_watts(float3 direction, float irradiance, __global const DeviceTarget* targets,
                                   int target_count, const DeviceScene* scene, int chosen, const Densities* of,
                                   float3 place) {
  float density = 0.0f;
  for (int i = 0; i < target_count; ++i) {
    const float3 way = place - targets[i].centre_radius.xyz;
    const float3 aside = way - dot(way, direction) * direction;
    if (i == chosen || dot(aside, aside) <= of->size[i]) density += of->density[i];
  }
  return irradiance * PI_F / density * scene->metres_per_unit * scene->metres_per_unit;
}

// A photon of parallel light in a unit direction.
static inline Emission emit_parallel(float3 direction, float irradiance, __global const DeviceTarget* targets,
                                     int target_count, const DeviceScene* scene, float4 random) {
  const Densities of = parallel_densities(targets, target_count);
  const int chosen = draw_target(&of, target_count, random.x);
  float3 x, y;
  make_frame(direction, &x, &y);
  float cosine_phi;
  const float sine_phi = sincos(2.0f * PI_F * random.z, &cosine_phi);
  const float radius = targets[chosen].centre_radius.w * sqrt(random.y);
  const float3 place = targets[chosen].centre_radius.xyz + radius * (cosine_phi * x + sine_phi * y);
  const Emission emission = {place, direction, scene->outside_distance,
                             parallel_watts(direction, irradiance, targets, target_count, scene, chosen, &of, place)};
  return emission;
}

// The same for a lattice, whose places in the square [-1, 1] x [-1, 1] stand for a target's shadow where they are on
// the unit disc. d: derivatives by the place.
static inline Emission parallel_lattice(float3 direction, float irradiance, __global const DeviceTarget* targets,
                                        int target_count, const DeviceScene* scene, int target, float2 disc,
                                        Differential d[2]) {
  float3 x, y;
  make_frame(direction, &x, &y);
  const Densities of = parallel_densities(targets, target_count);
  const float4 sphere = targets[target].centre_radius;
  const float3 place = sphere.xyz + sphere.w * (disc.x * x + disc.y * y);
  const Emission emission = {
      place, direction, scene->outside_distance,
      parallel_watts(direction, irradiance, targets, target_count, scene, target, &of, place)};
  d[0].position = sphere.w * x;
  d[1].position = sphere.w * y;
  d[0].direction = d[1].direction = (float3)(0.0f);
  return emission;
}

// A photon from a point into the cone of a target, or into another one (target -1), at a place of a lattice: the unit
// disc is the cone's by equal areas (Lambert's map). Its watts are to come.
static inline Emission cone_lattice(float3 from, float3 axis, float one_minus_cos,
                                    __global const DeviceTarget* targets, int target, float2 disc, Differential d[2]) {
  Emission emission = {from, axis, 0.0f, 0.0f};
  float distance = 0.0f;
  if (target >= 0) {
    const float3 way = targets[target].centre_radius.xyz - from;
    distance = length(way);
    axis = distance > 0.0f ? way / distance : (float3)(0.0f, 0.0f, 1.0f);
    one_minus_cos = one_minus_cos_of(targets[target].centre_radius, from);
  }
  float3 x, y;
  make_frame(axis, &x, &y);
  const float below = one_minus_cos * dot(disc, disc);
  const float stretch = sqrt(one_minus_cos * (2.0f - below)); // sine of the angle over the radius
  const float3 outwards = disc.x * x + disc.y * y, aside = stretch * outwards;
  const bool is_far = target >= 0 && one_minus_cos <= 1e-3f; // as in aim
  emission.direction = normalize(aside + axis * (1.0f - below));
  if (is_far) {
    emission.behind = distance / (1.0f - below);
    emission.origin = targets[target].centre_radius.xyz + emission.behind * aside;
  }
  for (int i = 0; i < 2; ++i) {
    const float along = i == 0 ? disc.x : disc.y, d_below = 2.0f * one_minus_cos * along;
    const float3 d_aside = stretch * (i == 0 ? x : y) - outwards * (one_minus_cos * one_minus_cos * along / stretch);
    d[i].direction = d_aside - d_below * axis;
    d[i].position = is_far ? emission.behind * (d_aside + aside * (d_below / (1.0f - below))) : (float3)(0.0f);
  }
  return emission;
}
