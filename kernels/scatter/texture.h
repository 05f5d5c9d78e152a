// SPDX-License-Identifier: Apache-2.0
// Pictures on surfaces: the place in the picture of a point of a triangle, and the colour there, from the four texels
// about it or the one that it is in. It is a factor of a matt surface's reflectance, of the tint of glass or of
// roughness, or it is a normal. Without textures NEPHROID_TEXTURES is 0, and this is a look-up of a row.
#include "kernels/scatter/interaction.h"

// 1: a surface has a texture of its roughness; a glass of its tint; a matt surface has a normal map.
#ifndef NEPHROID_ROUGHNESS_TEXTURES
#define NEPHROID_ROUGHNESS_TEXTURES 0
#endif
#ifndef NEPHROID_TINT_TEXTURES
#define NEPHROID_TINT_TEXTURES 0
#endif

// A surface with a texture of its roughness is polished where its alpha is less: a roughness of 0.01.
#define LEAST_ALPHA 1e-4f

#if NEPHROID_TEXTURES
// The texel number i of a row or column of n, wherever i is.
static inline int wrapped_texel(int i, int n, int wrap) {
  if (wrap == WRAP_CLAMP) return clamp(i, 0, n - 1);
  const int period = wrap == WRAP_MIRROR ? 2 * n : n;
  i = i % period;
  i = i < 0 ? i + period : i;
  return i < n ? i : period - 1 - i;
}

// The place in the first period which looks the same: 0..1, mirrored 0..2.
static inline float wrapped_place(float x, int wrap) {
  if (wrap == WRAP_CLAMP) return clamp(x, 0.0f, 1.0f);
  const float period = wrap == WRAP_MIRROR ? 2.0f : 1.0f;
  return x - period * floor(x / period);
}

static inline float3 texel_of(const World* world, const DeviceTexture* texture, int column, int row) {
  column = wrapped_texel(column, texture->width, texture->wrap);
  row = wrapped_texel(row, texture->height, texture->wrap);
  const ushort3 rgb = vload3(texture->first + (uint)row * (uint)texture->width + (uint)column, world->texture_texels);
  return convert_float3(rgb) / 65535.0f;
}

// The colour at a place in the picture: (0, 0) is its lower left, (1, 1) its upper right.
static inline float3 texture_colour(const World* world, const DeviceTexture* texture, float2 place) {
  const float x = wrapped_place(place.x, texture->wrap) * (float)texture->width,
              y = (1.0f - wrapped_place(place.y, texture->wrap)) * (float)texture->height;
  if (texture->nearest) return texel_of(world, texture, (int)floor(x), (int)floor(y));
  const int column = (int)floor(x - 0.5f), row = (int)floor(y - 0.5f);
  const float right = x - 0.5f - (float)column, down = y - 0.5f - (float)row;
  return mix(mix(texel_of(world, texture, column, row), texel_of(world, texture, column + 1, row), right),
             mix(texel_of(world, texture, column, row + 1), texel_of(world, texture, column + 1, row + 1), right),
             down);
}

// The part of the second and of the third corner in a point of a triangle's plane.
static inline float2 place_in_triangle(const World* world, uint triangle, float3 position) {
  const DevicePrimitive met = world->geometry.primitives[triangle];
  const float3 e1 = met.edge_u.xyz, e2 = met.edge_v.xyz, from_a = position - met.corner.xyz;
  const float3 across = cross(e1, e2);
  const float area = dot(across, across), b = dot(cross(from_a, e2), across) / area,
              c = dot(cross(e1, from_a), across) / area;
  return (float2)(b, c);
}

// Those of a triangle of an object: corners[2 * corner + axis].
static inline __global const float* texcoords_of(const World* world, uint triangle, int object) {
  const int number = (int)triangle - world->objects[object].texcoords;
  return world->texcoords + 6 * (size_t)number;
}

// u and v at a point of a triangle's plane.
static inline float2 texcoord_at(const World* world, uint triangle, int object, float3 position) {
  const float2 bc = place_in_triangle(world, triangle, position);
  __global const float* corners = texcoords_of(world, triangle, object);
  return (1.0f - bc.x - bc.y) * vload2(0, corners) + bc.x * vload2(1, corners) + bc.y * vload2(2, corners);
}

// The colour of the texture with a number, at a point in a triangle.
static inline float3 texture_at(const World* world, int number, const Surface* surface, uint triangle) {
  const DeviceTexture texture = world->textures[number];
  const float2 at = texcoord_at(world, triangle, surface->object, surface->position);
  const float2 place = (float2)(texture.u[0] * at.x + texture.u[1] * at.y + texture.u[2],
                                texture.v[0] * at.x + texture.v[1] * at.y + texture.v[2]);
  return texture_colour(world, &texture, place);
}
#endif

// Of a matt surface, at a point in a triangle.
static inline Reflector reflector_at(const World* world, const Surface* surface, uint triangle) {
  const DeviceMaterial material = material_of(world, surface->object);
  Reflector reflector = reflector_of_row(material.reflector);
#if NEPHROID_TEXTURES
  if (is_matt(&material) && material.texture >= 0) {
    reflector.is_textured = true;
    reflector.rgb = texture_at(world, material.texture, surface, triangle);
  }
#endif
  return reflector;
}

// The material at a point in a triangle, with the roughness that it has there.
static inline DeviceMaterial material_at(const World* world, const Surface* surface, uint triangle) {
  DeviceMaterial material = material_of(world, surface->object);
#if NEPHROID_ROUGHNESS_TEXTURES
  if (material.roughness_texture >= 0) {
    const float part = texture_at(world, material.roughness_texture, surface, triangle).y;
    material.alpha *= part * part;
    if (material.alpha < LEAST_ALPHA) material.alpha = 0.0f;
  }
#endif
  return material;
}

#if NEPHROID_TINT_TEXTURES
// What a dielectric with a texture of its tint lets pass, as what a reflector reflects.
static inline Reflector tint_at(const World* world, const Interaction* at) {
  Reflector tint = reflector_of_row(at->material.reflector);
  tint.is_textured = true;
  tint.rgb = texture_at(world, at->material.texture, &at->surface, at->triangle);
  return tint;
}
#endif

// What a path meets: surface_at, with the normal of its map.
static inline Surface surface_of(const World* world, Hit hit) {
  Surface surface = surface_at(&world->geometry, hit);
#if NEPHROID_NORMAL_MAPS
  const int number = material_of(world, surface.object).normal_map;
  if (number >= 0) {
    const DevicePrimitive met = world->geometry.primitives[hit.primitive];
    const DeviceTexture texture = world->textures[number];
    __global const float* corners = texcoords_of(world, hit.primitive, surface.object);
    const float2 first = vload2(0, corners), u = vload2(1, corners) - first, v = vload2(2, corners) - first;
    // The edges in the picture, and from them the ways on the surface that go to the right and up in it.
    const float2 e1 = (float2)(texture.u[0] * u.x + texture.u[1] * u.y, texture.v[0] * u.x + texture.v[1] * u.y),
                 e2 = (float2)(texture.u[0] * v.x + texture.u[1] * v.y, texture.v[0] * v.x + texture.v[1] * v.y);
    const float turn = e1.x * e2.y - e1.y * e2.x < 0.0f ? -1.0f : 1.0f;
    const float3 right = turn * (e2.y * met.edge_u.xyz - e1.y * met.edge_v.xyz), n = surface.shading,
                 across = right - dot(right, n) * n;
    const float length2 = dot(across, across);
    const float3 x = across / sqrt(length2), y = turn * cross(n, x);
    const float3 normal = 2.0f * texture_at(world, number, &surface, hit.primitive) - 1.0f;
    const float3 mapped = normalize(normal.x * x + normal.y * y + normal.z * n);
    if (length2 > 0.0f && dot(mapped, surface.geometric) > 0.0f) surface.shading = mapped;
  }
#endif
  return surface;
}
