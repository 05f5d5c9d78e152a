// SPDX-License-Identifier: Apache-2.0
// Where the pixels' paths end: at a diffuse surface or at the environment, straight or through glass and mirrors.
// shade.cl adds the light there. While only light changes, ends stay.
#include "kernels/environment/cube.h"
#include "kernels/environment/render_types.h"
#include "kernels/tracing/camera.h"
#include "kernels/tracing/eye_path.h"
#include "kernels/tracing/work_item.h"

static inline DeviceEnd nowhere(void) {
  DeviceEnd end;
  end.throughput = end.place = end.geometric = end.shading = (float4)(0.0f);
  return end;
}

// Traces a path to its end. first: its next hit, where known. weight: linear sRGB. likelier: as in trace_to_diffuse.
static inline DeviceEnd end_of(const World* world, Path path, const Hit* first, bool known, const Band* band,
                               float3 weight, uint2 seed, uint sample, uint pixel, bool likelier) {
  DeviceEnd end = nowhere();
  Surface surface;
  Hit hit = *first;
  const float scale =
      trace_to_diffuse(world, &path, &hit, known, band, seed, sample, 0u, pixel, STREAM_SEE, likelier, &surface);
  if (scale == 0.0f) return end;
  const float3 throughput = scale * wavelength_left(&world->tables, &path.losses, max(band->wavelength, 0)) * weight;
  if (hit.primitive == NEPHROID_NO_PRIMITIVE) {
    end.throughput = (float4)(throughput, (float)END_SKY);
    end.place = (float4)(path.direction, 0.0f);
    return end;
  }
  const float side = dot(path.direction, surface.geometric) < 0.0f ? 1.0f : -1.0f;
  end.throughput = (float4)(throughput, (float)END_SURFACE);
  end.place = (float4)(surface.position, surface.offset);
  end.geometric = (float4)(side * surface.geometric, as_float(hit.primitive));
  end.shading = (float4)(side * surface.shading, as_float(material_of(world, surface.object).reflector));
  return end;
}

// Marks the receivers' texels that shade.cl will read.
static inline void want(const DeviceEnd* end, float4 middle, int size, __global int* states) {
  if (end->throughput.w != (float)END_SURFACE) return;
  const CubeTexels four = cube_texels(end->place.xyz - middle.xyz, size);
  for (int i = 0; i < 4; ++i)
    if (states[four.texels[i]] == RECEIVER_UNSEEN)
      states[four.texels[i]] = RECEIVER_WANTED; // other items may write the same
}

// The part of light that glass reflects, from a path's directions before and after. n_ratio: n, near over far.
static inline float reflected_share(float3 direction, float3 reflected, float n_ratio) {
  const float3 normal = normalize(reflected - direction);
  const float cos_i = -dot(direction, normal), cos_t = refracted_cosine(cos_i, n_ratio);
  return cos_t < 0.0f ? 1.0f : fresnel_reflectance(cos_i, cos_t, n_ratio, 1.0f);
}

// The band of a path for one channel: a wavelength drawn by its share of that. channel_cdf: [channel][401].
static inline Band band_of_channel(__global const float* channel_cdf, int channel, float u) {
#if NEPHROID_JITTER
  const Band band = {0, choose(channel_cdf + channel * WAVELENGTH_COUNT, WAVELENGTH_COUNT, u), 1.0f};
  return band;
#else
  return whole_cluster(0);
#endif
}

// Continues a path from the eye at the glass or mirror that it meets first. reflected: whether it is reflected or goes
// through. weight: linear sRGB of the channel. False where there is no such way.
static inline bool first_bend(const World* world, Path* path, const Hit* hit, const Band* band, int channel,
                              bool reflected, float3* weight) {
  const Surface surface = surface_at(&world->geometry, *hit);
  const DeviceMaterial material = material_of(world, surface.object);
  lose_in_medium(world, path, hit->t);
  const float3 direction = path->direction;
  Path other = *path;
  float n_through = 1.0f, n_reflected = 1.0f;
  const bool goes_on = bend_path(world, path, hit->primitive, &surface, &material, band, 1.0f, &n_through);
  const bool reflects = bend_path(world, &other, hit->primitive, &surface, &material, band, 0.0f, &n_reflected);
  // A mirror, total reflection and glass that does not bend leave one way.
  const bool two_ways = dot(path->direction, surface.geometric) * dot(other.direction, surface.geometric) < 0.0f;
  const float share = two_ways ? reflected_share(direction, other.direction, n_through) : 0.0f;
  if (reflected) {
    *path = other;
    *weight = share * (float3)(1.0f);
    return two_ways && reflects;
  }
  *weight = (1.0f - share) * n_through * n_through *
            (ENDS_OF_PIXEL == 2 ? (float3)(1.0f) : (float3)(channel == 0, channel == 1, channel == 2));
  return goes_on;
}

// Traces the paths of blocks first .. first + count - 1 of block x block pixels, row after row. ends: ENDS_OF_PIXEL for
// each. A pixel that first sees glass follows both reflection and the way through, this one in three colours where
// glass parts them. In a coarse picture, of larger blocks, paths take the likelier way at later surfaces, because one
// that did not would stand out as a block.
__kernel void see(WORLD_ARGUMENTS, __global const float* channel_cdf, __global DeviceEnd* ends, __global int* states,
                  int size, float4 middle, DeviceCamera camera, uint2 seed, uint pass, int block, uint first,
                  uint count) {
  const World world = WORLD;
  const uint index = work_item();
  if (index >= count) return;
  const uint item = first + index;
  const int columns = (camera.width + block - 1) / block, column = (int)item % columns * block,
            row = (int)item / columns * block;
  const uint pixel = (uint)(row * camera.width + column);
  const bool coarse = block > 1;
  const float2 jitter = coarse ? (float2)(0.5f * (float)block) : random4(seed, pass, pixel, 0u, STREAM_SEE).xy;
  Path path = path_from_eye(&camera, primary_direction(&camera, column, row, jitter));
  const Hit hit = next_hit(&world, &path);
  const bool bent = hit.primitive != NEPHROID_NO_PRIMITIVE &&
                    material_of(&world, object_of_primitive(&world.geometry, hit.primitive)).type != MATERIAL_DIFFUSE;
  SET_ASIDE float3 outwards = path.direction;
  SET_ASIDE float u = coarse ? 0.5f : golden_place(seed, pass, 0u, 1u, pixel, STREAM_SEE_WAVELENGTH);
  for (int i = 0; i < ENDS_OF_PIXEL; ++i) {
    // All colours are reflected the same way and nearly as much, so one of them is followed. It has the last end.
    const int channel = i < ENDS_OF_PIXEL - 1 ? i : (ENDS_OF_PIXEL - 1) / 2;
    Band band = whole_cluster(0);
    Path way = path_from_eye(&camera, outwards);
    float3 weight = (float3)(1.0f);
    bool goes_on = i == 0;
    if (bent) {
      band = band_of_channel(channel_cdf, channel, u);
      goes_on = first_bend(&world, &way, &hit, &band, channel, i == ENDS_OF_PIXEL - 1, &weight);
    }
    DeviceEnd end = nowhere();
    if (goes_on)
      end = end_of(&world, way, &hit, !bent, &band, weight, seed, ENDS_OF_PIXEL * pass + (uint)i, pixel, coarse);
    ends[ENDS_OF_PIXEL * item + i] = end;
    want(&end, middle, size, states);
  }
}
