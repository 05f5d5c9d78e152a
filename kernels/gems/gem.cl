// SPDX-License-Identifier: Apache-2.0
// Light that a stone sends back to an eye far above it, by rays from the eye: by reciprocity a sky's radiance along
// the ray that leaves comes to the eye with the ray's weight. A ray is split at each surface by Fresnel's equations,
// without polarization, as long as it has more than GEM_SPLIT of its light; below that it goes one way by chance.
#include "kernels/gems/gem_types.h"
#include "kernels/scatter/fresnel.h"
#include "kernels/tracing/item_kernel.h"
#include "kernels/tracing/random.h"
#include "kernels/tracing/surface.h"

#define GEM_SPLIT 1e-2f
#define GEM_SURFACES 2000 // that a ray meets at most: some go round for ever, as in a cube
#define GEM_WAITING 4     // branches that may wait; those of a convex stone need one

typedef struct {
  float3 position, direction;
  float3 at_c, at_f; // the directions of the lines C and F along the same surfaces
  float weight;
  uint skip;
  int surfaces;    // met so far
  bool is_spread;  // both lines are refracted wherever the ray is
  bool is_through; // nothing has reflected it
} GemRay;

typedef struct {
  float sums[GEM_SUMS];
} GemLight;

static inline Geometry gem_geometry(__global const float* nodes, __global const float* blocks,
                                    __global const DevicePrimitive* primitives, int root) {
  const Geometry geometry = {nodes, blocks, primitives, root};
  return geometry;
}

// The light of a ray that has left for the sky.
static inline void gem_leave(GemLight* light, const GemRay* ray, float3 eye, float cos_head, float* through) {
  const float up = dot(ray->direction, eye), weight = ray->weight;
  if (up <= 0.0f) {
    light->sums[GEM_BELOW] += weight;
    if (ray->is_through) *through += weight;
    return;
  }
  light->sums[GEM_ISO] += weight;
  light->sums[GEM_COS] += weight * up;
  if (up < cos_head) light->sums[GEM_HEAD] += weight;
  if (!ray->is_spread) return;
  light->sums[GEM_SPREAD] += weight * 2.0f * asin(fmin(0.5f * length(ray->at_c - ray->at_f), 1.0f));
  light->sums[GEM_SPREADS] += weight;
}

static inline float3 gem_bounce(float3 direction, float3 normal) {
  return direction - 2.0f * dot(direction, normal) * normal;
}

// A line that is refracted; nothing changes where it cannot be.
static inline bool gem_refract(float3* direction, float3 normal, float eta) {
  const float cos_i = -dot(*direction, normal), cos_t = refracted_cosine(cos_i, eta);
  if (cos_i < 0.0f || cos_t < 0.0f) return false;
  *direction = refract_through(*direction, normal, cos_i, cos_t, eta);
  return true;
}

// Follows a ray from the eye with all its branches. numbers: index of the pixel, and of the sample.
COMPILED_ONCE GemLight gem_light_of(const Geometry* geometry, float3 position, float3 eye, const DeviceGem* gem,
                                    uint pixel, uint sample) {
  GemLight light;
  for (int i = 0; i < GEM_SUMS; ++i) light.sums[i] = 0.0f;
  GemRay ray = {position, -eye, -eye, -eye, 1.0f, NEPHROID_NO_PRIMITIVE, 0, true, true};
  GemRay waiting[GEM_WAITING];
  int waits = 0;
  uint chances = 0;
  float through = 0.0f;
  while (true) {
    const Hit hit = closest_hit(geometry->nodes, geometry->blocks, geometry->root, ray.position, ray.direction, 0.0f,
                                INFINITY, ray.skip);
    if (hit.primitive == NEPHROID_NO_PRIMITIVE || ray.surfaces == GEM_SURFACES) {
      if (ray.surfaces == 0) return light;
      if (hit.primitive == NEPHROID_NO_PRIMITIVE)
        gem_leave(&light, &ray, eye, gem->cos_head, &through);
      else
        light.sums[GEM_LOST] += ray.weight;
      if (waits == 0) break;
      ray = waiting[--waits];
      continue;
    }
    light.sums[GEM_HITS] = 1.0f;
    const Surface surface = surface_at(geometry, hit);
    const bool leaves = dot(ray.direction, surface.geometric) > 0.0f;
    const float3 normal = leaves ? -surface.geometric : surface.geometric;
    if (leaves) ray.weight *= exp(-gem->loss * hit.t);
    const float n_i = leaves ? gem->n : 1.0f, n_t = leaves ? 1.0f : gem->n;
    const float cos_i = -dot(ray.direction, normal), cos_t = refracted_cosine(cos_i, n_i / n_t);
    const float reflectance = cos_t < 0.0f ? 1.0f : fresnel_reflectance(cos_i, cos_t, n_i, n_t);
    ray.skip = hit.primitive;
    ++ray.surfaces;

    GemRay refracted = ray;
    if (reflectance < 1.0f) {
      refracted.direction = refract_through(ray.direction, normal, cos_i, cos_t, n_i / n_t);
      const bool both = gem_refract(&refracted.at_c, normal, leaves ? gem->n_c : 1.0f / gem->n_c) &&
                        gem_refract(&refracted.at_f, normal, leaves ? gem->n_f : 1.0f / gem->n_f);
      refracted.is_spread = ray.is_spread && both;
      refracted.position = start_on_side(&surface, leaves ? 1.0f : -1.0f);
    }
    ray.direction = gem_bounce(ray.direction, normal);
    ray.at_c = gem_bounce(ray.at_c, normal);
    ray.at_f = gem_bounce(ray.at_f, normal);
    ray.is_through = false;
    ray.position = start_on_side(&surface, leaves ? -1.0f : 1.0f);
    if (reflectance >= 1.0f) continue;
    if (ray.weight > GEM_SPLIT && waits < GEM_WAITING) {
      refracted.weight *= 1.0f - reflectance;
      ray.weight *= reflectance;
      // Who is outside goes first: it has left a convex stone for good.
      waiting[waits++] = leaves ? ray : refracted;
      if (leaves) ray = refracted;
    } else if (random4(gem->seed, sample, pixel, ++chances, STREAM_GEM).x >= reflectance) {
      ray = refracted;
    }
  }
  const float half_of_it = 0.5f * (light.sums[GEM_ISO] + light.sums[GEM_BELOW]);
  light.sums[GEM_WINDOW] = through > half_of_it ? 1.0f : 0.0f;
  light.sums[GEM_DARK] = light.sums[GEM_ISO] - light.sums[GEM_HEAD] > half_of_it ? 1.0f : 0.0f;
  return light;
}

// Where the ray of a place of the picture begins. at: 0 to 1 to the right and downwards.
static inline float3 gem_start(const DeviceGemView* view, float2 at) {
  const float half_side = view->middle.w;
  return view->middle.xyz + half_side * ((2.0f * at.x - 1.0f) * view->right.xyz +
                                         (1.0f - 2.0f * at.y) * view->up.xyz + 2.0f * view->eye.xyz);
}

// The place of a sample of a pixel, 0 to 1 over the whole picture.
static inline float2 gem_place(const DeviceGem* gem, uint pixel, uint sample) {
  const float4 u = random4(gem->seed, sample, pixel, 0u, STREAM_GEM);
  return (convert_float2((uint2)(pixel % (uint)gem->side, pixel / (uint)gem->side)) + u.xy) / (float)gem->side;
}

#define GEM_ARGUMENTS                                                                                  \
  __global const float *nodes, __global const float *blocks, __global const DevicePrimitive *primitives, \
      DeviceGemView view, DeviceGem gem, __global float *sums
#define GEM_NAMES nodes, blocks, primitives, view, gem, sums

// sums: [GEM_SUMS][pixel]
ITEM_KERNEL(gem_light, (GEM_ARGUMENTS), (GEM_NAMES)) {
  const uint pixels = (uint)(gem.side * gem.side);
  if (index >= pixels) return;
  const Geometry geometry = gem_geometry(nodes, blocks, primitives, gem.root);
  float total[GEM_SUMS];
  for (int i = 0; i < GEM_SUMS; ++i) total[i] = 0.0f;
  for (uint s = gem.first; s < gem.first + (uint)gem.samples; ++s) {
    const GemLight light =
        gem_light_of(&geometry, gem_start(&view, gem_place(&gem, index, s)), view.eye.xyz, &gem, index, s);
    for (int i = 0; i < GEM_SUMS; ++i) total[i] += light.sums[i];
  }
  for (uint i = 0; i < GEM_SUMS; ++i) sums[i * pixels + index] = total[i];
}

// The same places in two views. sums: [GEM_CHANGE_SUMS][pixel]
ITEM_KERNEL(gem_change, (GEM_ARGUMENTS, DeviceGemView tilted), (GEM_NAMES, tilted)) {
  const uint pixels = (uint)(gem.side * gem.side);
  if (index >= pixels) return;
  const Geometry geometry = gem_geometry(nodes, blocks, primitives, gem.root);
  float pairs = 0.0f, change = 0.0f;
  for (uint s = gem.first; s < gem.first + (uint)gem.samples; ++s) {
    const float2 at = gem_place(&gem, index, s);
    const GemLight one = gem_light_of(&geometry, gem_start(&view, at), view.eye.xyz, &gem, index, s),
                   other = gem_light_of(&geometry, gem_start(&tilted, at), tilted.eye.xyz, &gem, index, s);
    const float both = one.sums[GEM_HITS] * other.sums[GEM_HITS];
    pairs += both;
    change += both * fabs(one.sums[GEM_HEAD] - other.sums[GEM_HEAD]);
  }
  sums[GEM_PAIRS * pixels + index] = pairs;
  sums[GEM_CHANGE * pixels + index] = change;
}

// Each place of the picture at each of a few wavelengths. n, loss: [wavelengths]; xyz: the same, of the sky's light,
// whose mean has a Y of 1. sums: [GEM_COLOUR_SUMS][pixel], under the head's sky.
ITEM_KERNEL(gem_colour,
            (GEM_ARGUMENTS, __global const float* n, __global const float* loss, __global const float4* xyz,
             int wavelengths),
            (GEM_NAMES, n, loss, xyz, wavelengths)) {
  const uint pixels = (uint)(gem.side * gem.side);
  if (index >= pixels) return;
  const Geometry geometry = gem_geometry(nodes, blocks, primitives, gem.root);
  float4 total = (float4)(0.0f);
  for (uint s = gem.first; s < gem.first + (uint)gem.samples; ++s) {
    const float3 position = gem_start(&view, gem_place(&gem, index, s));
    for (int w = 0; w < wavelengths; ++w) {
      DeviceGem at_wavelength = gem;
      at_wavelength.n = at_wavelength.n_c = at_wavelength.n_f = n[w];
      at_wavelength.loss = loss[w];
      const GemLight light = gem_light_of(&geometry, position, view.eye.xyz, &at_wavelength, index, s);
      total += (float4)(light.sums[GEM_HEAD] * xyz[w].xyz, light.sums[GEM_HITS]) / (float)wavelengths;
    }
  }
  sums[index] = total.x;
  sums[pixels + index] = total.y;
  sums[2 * pixels + index] = total.z;
  sums[3 * pixels + index] = total.w;
}
