// SPDX-License-Identifier: Apache-2.0
// The light that the pixels' paths bring from their ends (see.cl): the environment itself; on a surface direct light of
// the environment and lamps, and caustics from the cube of receivers.
#undef NEPHROID_MATERIALS
#define NEPHROID_MATERIALS (1 << MATERIAL_DIFFUSE) // see.cl has let its light pass coats already
#include "kernels/environment/cube.h"
#include "kernels/environment/render_types.h"
#include "kernels/tracing/item_kernel.h"
#include "kernels/transport/eye_path.h"
#include "kernels/transport/piece.h"

// 1: the direct layer is the smooth one.
#ifndef NEPHROID_COARSE
#define NEPHROID_COARSE 0
#endif

#define LAYERS 4
#define LAYER_BACKGROUND 0
#define LAYER_DIRECT 1
#define LAYER_CAUSTIC 2
// Direct light without noise: the environment lights surfaces as the few lights that it is cut into.
#define LAYER_SMOOTH 3

// How much a receiver's distance may differ from a flat surface's, as a part of that, and of a texel's width.
#define DISTANCE_TOLERANCE 0.02f

typedef struct {
  float4 middle;
  int size; // texels along an edge of the cube's faces
  __global const float* distances;
  __global const float* caustics;   // E r^2 on the surface: [texel][3]
  __global const float* parts_seen; // parts of the environment's light: [texel][3]
} Receivers;

// The caustics' irradiance on a surface in linear sRGB, and in *seen the part of the environment's light that it gets;
// 0 and 1 where something hides it. Of the four texels about it, those that see the same surface count.
static inline float3 caustic_irradiance(const Receivers* receivers, const DeviceEnd* end, float3* seen) {
  *seen = (float3)(1.0f);
  const float3 way = end->place.xyz - receivers->middle.xyz;
  const float distance = length(way);
  const float3 direction = way / distance;
  const float facing = -dot(end->geometric.xyz, direction);
  if (!(facing > 0.0f)) return (float3)(0.0f);
  const CubeTexels four = cube_texels(direction, receivers->size);
  float3 sum = (float3)(0.0f), parts = (float3)(0.0f);
  float weights = 0.0f;
  for (int i = 0; i < 4; ++i) {
    const float along = -dot(end->geometric.xyz, cube_texel_direction(four.texels[i], receivers->size));
    const float expected = along > 0.0f ? distance * facing / along : INFINITY,
                found = receivers->distances[four.texels[i]];
    if (!(fabs(found - expected) <= DISTANCE_TOLERANCE * expected + 4.0f * distance / (float)receivers->size)) continue;
    sum += four.weights[i] * vload3((size_t)four.texels[i], receivers->caustics);
    parts += four.weights[i] * vload3((size_t)four.texels[i], receivers->parts_seen);
    weights += four.weights[i];
  }
  if (!(weights > 0.0f)) return sum;
  *seen = parts / weights;
  return sum / (weights * distance * distance);
}

// The lights that the environment is cut into: each one's unit direction, then its irradiance on a plane that faces it.
typedef struct {
  __global const float4* lights;
  int count;
} SkyLights;

// Their irradiance on a surface, without shadows.
static inline float3 smooth_irradiance(const SkyLights* sky, const Surface* surface) {
  float3 sum = (float3)(0.0f);
  for (int l = 0; l < sky->count; ++l) {
    const float3 way = sky->lights[2 * l].xyz;
    sum += fmax(dot(surface->shading, way), 0.0f) * part_at_normal(surface, way) * sky->lights[2 * l + 1].xyz;
  }
  return sum;
}

// What a reflector sends back of light of a colour, linear sRGB. reflected_rgb: [reflector][primary].
static inline float3 reflected_colour(__global const float4* reflected_rgb, int reflector, float3 rgb) {
  __global const float4* of = reflected_rgb + 3 * reflector;
  return rgb.x * of[0].xyz + rgb.y * of[1].xyz + rgb.z * of[2].xyz;
}

// The radiance of a surface by light that reaches it unbent, linear sRGB. *smooth: the same for the layer smooth, with
// the part `seen` of the environment's light. lit_rgb: [row of the lights' tables][reflector]. sequence: which numbers
// draw places in the environment; a pass takes one.
static inline float3 direct_radiance(const World* world, const DeviceEnd* end, __global const float4* lit_rgb,
                                     __global const float4* reflected_rgb, const SkyLights* sky, float power_unit,
                                     uint2 seed, uint pass, uint sequence, float3 seen, float3* smooth) {
  const int reflector = as_int(end->shading.w);
  const uint primitive = as_uint(end->geometric.w);
  Surface surface;
  surface.position = end->place.xyz;
  surface.offset = end->place.w;
  surface.geometric = end->geometric.xyz;
  surface.shading = end->shading.xyz;
  Path path;
  path.direction = -surface.geometric; // only the side that the path arrives on is read
  float3 sampled = (float3)(0.0f), sum = (float3)(0.0f);
  for (int l = 0; l < world->scene.light_count; ++l) {
    __global const float4* row = lit_rgb + l * world->scene.reflector_count + reflector;
    if (is_of_environment(world, l)) {
      sum += reflected_colour(reflected_rgb, reflector, seen * smooth_irradiance(sky, &surface));
#if !NEPHROID_COARSE
      const float3 rgb = power_unit * sky_irradiance(world, l, &path, &surface, primitive, seed, pass, 1u, sequence);
      sampled += rgb.x * row[0].xyz + rgb.y * row[world->scene.reflector_count].xyz +
                 rgb.z * row[2 * world->scene.reflector_count].xyz;
#endif
    } else {
      const float3 lamp =
          row->xyz * (power_unit * irradiance_of(world, l, &path, &surface, primitive, seed, pass, 1u, sequence));
      sampled += lamp;
      sum += lamp;
    }
  }
  *smooth = sum / PI_F;
  return NEPHROID_COARSE ? *smooth : sampled / PI_F;
}

// Adds to the sums of each block's pixels, or begins them anew. sums: [layer][pixel][3].
ITEM_KERNEL(shade, (WORLD_ARGUMENTS, __global const DeviceEnd* ends, __global const float* texels,
                    __global const float4* colours, // reflected_rgb: 3 a reflector; then lit_rgb
                    __global const float4* sky_lights, __global const float* distances, __global const float* caustics,
                    __global const float* parts_seen, __global float* sums, DeviceShading shading),
                   (WORLD_NAMES, ends, texels, colours, sky_lights, distances, caustics, parts_seen, sums, shading)) {
  const World world = WORLD;
  const DeviceBlocks blocks = shading.blocks;
  const int block = blocks.block, width = shading.width, height = shading.height;
  if (index >= blocks.count) return;
  const Background background = {texels, 0, shading.background};
  const SkyLights sky_in_lights = {sky_lights, shading.sky_light_count};
  const Receivers receivers = {shading.middle, shading.size, distances, caustics, parts_seen};
  const uint item = blocks.first + index;
  const int columns = (width + block - 1) / block, column = (int)item % columns * block,
            row = (int)item / columns * block;
  const uint pixel = (uint)(row * width + column);
  float3 layers[LAYERS] = {(float3)(0.0f), (float3)(0.0f), (float3)(0.0f), (float3)(0.0f)};
  for (uint i = 0; i < ENDS_OF_PIXEL; ++i) {
    const DeviceEnd end = ends[ENDS_OF_PIXEL * item + i];
    const float3 throughput = end.throughput.xyz;
    if (end.throughput.w == (float)END_SKY) {
      const Piece piece = {end.place.xyz, end.geometric.xyz, end.shading.xyz, (float2)(end.geometric.w, end.shading.w)};
      const float2 numbers = random4(blocks.seed, ENDS_OF_PIXEL * blocks.pass + i, pixel, 0u, STREAM_PEAKS).xy;
      layers[LAYER_BACKGROUND] +=
          throughput * (shading.radiance * rgb_of_piece(&world.sky, &background, &piece, numbers));
    }
    if (end.throughput.w != (float)END_SURFACE) continue;
    float3 smooth, seen;
    const float3 caustic = caustic_irradiance(&receivers, &end, &seen);
    layers[LAYER_DIRECT] +=
        throughput * direct_radiance(&world, &end, colours + 3 * scene.reflector_count, colours, &sky_in_lights,
                                     shading.power_unit, blocks.seed, blocks.pass, pixel * ENDS_OF_PIXEL + i, seen,
                                     &smooth);
    layers[LAYER_SMOOTH] += throughput * smooth;
    layers[LAYER_CAUSTIC] += throughput * reflected_colour(colours, as_int(end.shading.w), caustic) / PI_F;
  }
  const size_t pixels = (size_t)width * (size_t)height;
  for (int l = 0; l < LAYERS; ++l)
    for (int y = row; y < min(row + block, height); ++y)
      for (int x = column; x < min(column + block, width); ++x) {
        const size_t place = (size_t)l * pixels + (size_t)(y * width + x);
        vstore3(shading.anew ? layers[l] : vload3(place, sums) + layers[l], place, sums);
      }
}
