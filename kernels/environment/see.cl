// SPDX-License-Identifier: Apache-2.0
// Where the pixels' paths end: at a diffuse surface or at the environment, straight or through glass and mirrors.
// shade.cl adds the light there. While only light changes, ends stay.
#define NEPHROID_PLACE_DIFFERENTIALS 1
#include "kernels/environment/cube.h"
#include "kernels/environment/render_types.h"
#include "kernels/tracing/item_kernel.h"
#include "kernels/transport/eye_walk.h"
#include "kernels/transport/piece.h"

static inline DeviceEnd nowhere(void) {
  DeviceEnd end;
  end.throughput = end.place = end.geometric = end.shading = (float4)(0.0f);
  return end;
}

// Traces a path, which has met `hit`, to its end. straight: to what it has met, below a coat. weight: linear sRGB.
// point: it sees a point of the sky. place, edges: as in piece_of.
static inline DeviceEnd end_of(const World* world, Visitor* eye, Path path, Hit hit, bool straight, float3 weight,
                               bool point, float2 place, float2 edges) {
  DeviceEnd end = nowhere();
  Interaction at;
  if (hit.primitive != NEPHROID_NO_PRIMITIVE) {
    int last;
    if (follow_eye_path(world, eye, &path, &hit, &at, &last) == 0.0f) return end;
  }
  float3 throughput = eye->radiance_scale * part_left(&path.throughput) * (eye->share * weight);
  if (hit.primitive == NEPHROID_NO_PRIMITIVE) {
    end.throughput = (float4)(throughput, (float)END_SKY);
    end.place = (float4)(path.direction, 0.0f);
    if (straight || point) return end;
    const Piece piece = piece_of(&path, place, edges);
    end.geometric = (float4)(piece.u, piece.at.x);
    end.shading = (float4)(piece.v, piece.at.y);
    return end;
  }
  const Surface surface = at.surface;
  const float side = dot(path.direction, surface.geometric) < 0.0f ? 1.0f : -1.0f;
#if NEPHROID_TEXTURES // in the three colours of engine 2; the photons have its spectra
  const Reflector reflector = reflector_at(world, &surface, hit.primitive);
  if (reflector.is_textured) throughput *= reflector.rgb;
#endif
  throughput *= mean_part_to_base(world, &at.material);
  end.throughput = (float4)(throughput, (float)END_SURFACE);
  end.place = (float4)(surface.position, surface.offset);
  end.geometric = (float4)(side * surface.geometric, as_float(hit.primitive));
  end.shading = (float4)(side * surface.shading, as_float(at.material.reflector));
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
  return one_wavelength(0, choose(channel_cdf + channel * WAVELENGTH_COUNT, WAVELENGTH_COUNT, u), 1.0f);
#else
  return whole_cluster(0);
#endif
}

// Traces the paths of blocks of pixels. ends: ENDS_OF_PIXEL for each. A pixel that first sees glass follows both
// reflection and the way through, this one in three colours where glass parts them. In a coarse picture, of larger
// blocks, paths take the likelier way at later surfaces, because one that did not would stand out as a block.
ITEM_KERNEL(see, (WORLD_ARGUMENTS, __global const float* channel_cdf, __global DeviceEnd* ends, __global int* states,
                  int size, float4 middle, DeviceCamera camera, DeviceBlocks blocks),
                 (WORLD_NAMES, channel_cdf, ends, states, size, middle, camera, blocks)) {
  const World world = WORLD;
  const int block = blocks.block;
  if (index >= blocks.count) return;
  const uint item = blocks.first + index;
  const int columns = (camera.width + block - 1) / block, column = (int)item % columns * block,
            row = (int)item / columns * block;
  const uint pixel = (uint)(row * camera.width + column);
  const bool coarse = block > 1;
  const float2 jitter = coarse ? (float2)(0.5f * (float)block)
                               : eye_numbers(blocks.seed, blocks.pass, 1u, pixel, 0u, STREAM_SEE).xy;
  const float2 edges = piece_edges(blocks.pass / NEPHROID_FILM_HALVES);
  EYE_OF(camera);
  begin_on_lens(eye, pixel, jitter, blocks.seed, blocks.pass, 1u, STREAM_SEE);
  Path path = path_from_eye(eye, primary_direction(eye, column, row, jitter));
  const Hit hit = next_hit(&world, &path);
  bool bent = false, coated = false;
  if (hit.primitive != NEPHROID_NO_PRIMITIVE) {
    const DeviceMaterial met = material_of_hit(&world, &hit);
    bent = !is_only_matt(&met);
    coated = has_coat(&met);
  }
  SET_ASIDE float3 outwards = path.direction;
  SET_ASIDE float u = coarse ? 0.5f : golden_place(blocks.seed, blocks.pass, 0u, 1u, pixel, STREAM_SEE_WAVELENGTH);
  for (int i = 0; i < ENDS_OF_PIXEL; ++i) {
    // All colours are reflected the same way and nearly as much, so one of them is followed. It has the last end.
    const int channel = i < ENDS_OF_PIXEL - 1 ? i : (ENDS_OF_PIXEL - 1) / 2;
    const bool straight = !bent || (coated && i == 0), reflected = i == ENDS_OF_PIXEL - 1;
    const Band band = straight ? whole_cluster(0) : band_of_channel(channel_cdf, channel, u);
    const int channels = straight || reflected ? 1 : ENDS_OF_PIXEL - 1; // that this way brings apart from each other
    const float3 weight =
        channels == 1 ? (float3)(1.0f) : (float3)(channel == 0, channel == 1, channel == 2);
    Visitor visitor = eye_visitor(&band, blocks.seed, ENDS_OF_PIXEL * blocks.pass + (uint)i, 0u, pixel, STREAM_SEE);
    visitor.likelier = coarse;
    visitor.drops_one_way = reflected;
    if (bent) visitor.first_lobes = straight ? LOBE_DIFFUSE : reflected ? LOBE_REFLECTION : LOBE_TRANSMISSION;
    DeviceEnd end = nowhere();
    if (!straight || i == 0)
      end = end_of(&world, &visitor, path_from_eye(eye, outwards), hit, straight, weight, coarse, jitter, edges);
    ends[ENDS_OF_PIXEL * item + i] = end;
    want(&end, middle, size, states);
  }
}
