// SPDX-License-Identifier: Apache-2.0
// Where the pixels' paths end: at a diffuse surface or at the environment, straight or through glass and mirrors.
// shade.cl adds the light there. While only light changes, ends stay.
#define NEPHROID_PLACE_DIFFERENTIALS 1
#include "kernels/environment/cube.h"
#include "kernels/environment/render_types.h"
#include "kernels/tracing/camera.h"
#include "kernels/tracing/eye_path.h"
#include "kernels/tracing/piece.h"
#include "kernels/tracing/work_item.h"

static inline DeviceEnd nowhere(void) {
  DeviceEnd end;
  end.throughput = end.place = end.geometric = end.shading = (float4)(0.0f);
  return end;
}

// Traces a path to its end. first: its next hit, where known: then nothing has bent it, and it ends below a coat.
// weight: linear sRGB. likelier: as in trace_to_diffuse, and it sees a point of the sky. place, edges: as in piece_of.
static inline DeviceEnd end_of(const World* world, Path path, const Hit* first, bool known, const Band* band,
                               float3 weight, uint2 seed, uint sample, uint pixel, bool likelier, float2 place,
                               float2 edges) {
  DeviceEnd end = nowhere();
  Surface surface;
  Hit hit = *first;
  float scale = 1.0f;
  if (known && hit.primitive != NEPHROID_NO_PRIMITIVE && shows_coat(world, &hit)) {
    surface = surface_at(&world->geometry, hit);
    lose_in_medium(world, &path, hit.t);
    scale = part_through_coat(world, &surface, path.direction);
  } else
    scale = trace_to_diffuse(world, &path, &hit, known, band, seed, sample, 0u, pixel, STREAM_SEE, likelier, &surface);
  if (scale == 0.0f) return end;
  float3 throughput = scale * wavelength_left(&world->tables, &path.losses, max(band->wavelength, 0)) * weight;
  if (hit.primitive == NEPHROID_NO_PRIMITIVE) {
    end.throughput = (float4)(throughput, (float)END_SKY);
    end.place = (float4)(path.direction, 0.0f);
    if (known || likelier) return end;
    const Piece piece = piece_of(&path, place, edges);
    end.geometric = (float4)(piece.u, piece.at.x);
    end.shading = (float4)(piece.v, piece.at.y);
    return end;
  }
  const float side = dot(path.direction, surface.geometric) < 0.0f ? 1.0f : -1.0f;
#if NEPHROID_TEXTURES // in the three colours of engine 2; the photons have its spectra
  const Reflector reflector = reflector_at(world, &surface, hit.primitive);
  if (reflector.is_textured) throughput *= reflector.rgb;
#endif
  const DeviceMaterial material = material_of(world, surface.object);
  if (is_plastic(&material)) throughput *= world->tables.surface_data[material.surface_first + COAT_MEAN];
  end.throughput = (float4)(throughput, (float)END_SURFACE);
  end.place = (float4)(surface.position, surface.offset);
  end.geometric = (float4)(side * surface.geometric, as_float(hit.primitive));
  end.shading = (float4)(side * surface.shading, as_float(material.reflector));
  return end;
}

// Marks the receivers' texels that shade.cl will read.
static inline void want(const DeviceEnd* end, float4 middle, int size, __global int* states) {
  if (end->throughput.w != (float)END_SURFACE) return;
  const float3 way = end->place.xyz - middle.xyz;
  const CubeTexels four = cube_texels(way / length(way), size); // rounded as in shade.cl
  for (int i = 0; i < 4; ++i)
    if (states[four.texels[i]] == RECEIVER_UNSEEN)
      states[four.texels[i]] = RECEIVER_WANTED; // other items may write the same
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
  const float2 jitter = coarse ? (float2)(0.5f * (float)block) : eye_numbers(seed, pass, 1u, pixel, 0u, STREAM_SEE).xy;
  const float2 edges = piece_edges(pass / NEPHROID_FILM_HALVES);
  EYE_OF(camera);
  begin_on_lens(eye, pixel, jitter, seed, pass, 1u, STREAM_SEE);
  Path path = path_from_eye(eye, primary_direction(eye, column, row, jitter));
  const Hit hit = next_hit(&world, &path);
  const bool bent = hit.primitive != NEPHROID_NO_PRIMITIVE &&
                    material_of(&world, object_of_primitive(&world.geometry, hit.primitive)).type != MATERIAL_DIFFUSE;
  const bool coated = bent && shows_coat(&world, &hit);
  SET_ASIDE float3 outwards = path.direction;
  SET_ASIDE float u = coarse ? 0.5f : golden_place(seed, pass, 0u, 1u, pixel, STREAM_SEE_WAVELENGTH);
  for (int i = 0; i < ENDS_OF_PIXEL; ++i) {
    // All colours are reflected the same way and nearly as much, so one of them is followed. It has the last end.
    const int channel = i < ENDS_OF_PIXEL - 1 ? i : (ENDS_OF_PIXEL - 1) / 2;
    Band band = whole_cluster(0);
    Path way = path_from_eye(eye, outwards);
    float3 weight = (float3)(1.0f);
    bool goes_on = i == 0;
    const bool straight = !bent || (coated && i == 0); // to what is seen first
    if (!straight) {
      band = band_of_channel(channel_cdf, channel, u);
      const bool reflected = i == ENDS_OF_PIXEL - 1;
      const float2 facet =
          facet_numbers(seed, ENDS_OF_PIXEL * pass + (uint)i, pixel, BEFORE_THE_PATH, STREAM_SEE);
      float share;
      Bend bend;
      goes_on = first_bend(&world, &way, &hit, &band, reflected, facet, &share, &bend) &&
                !(reflected && leaves_one_way(&bend));
      weight = share *
               (reflected || ENDS_OF_PIXEL == 2 ? (float3)(1.0f) : (float3)(channel == 0, channel == 1, channel == 2));
    }
    DeviceEnd end = nowhere();
    if (goes_on)
      end = end_of(&world, way, &hit, straight, &band, weight, seed, ENDS_OF_PIXEL * pass + (uint)i, pixel, coarse,
                   jitter, edges);
    ends[ENDS_OF_PIXEL * item + i] = end;
    want(&end, middle, size, states);
  }
}
