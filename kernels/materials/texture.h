// SPDX-License-Identifier: Apache-2.0
// Pictures on diffuse surfaces: the place in the picture of a point of a triangle, and the colour there, from the four
// texels about it or the one that it is in. Without textures NEPHROID_TEXTURES is 0, and this is a look-up of a row.

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

// u and v at a point of a triangle's plane.
static inline float2 texcoord_at(const World* world, uint triangle, int object, float3 position) {
  const DevicePrimitive met = world->geometry.primitives[triangle];
  const float3 e1 = met.edge_u.xyz, e2 = met.edge_v.xyz, from_a = position - met.corner.xyz;
  const float3 across = cross(e1, e2);
  const float area = dot(across, across), b = dot(cross(from_a, e2), across) / area,
              c = dot(cross(e1, from_a), across) / area;
  const int number = (int)triangle - world->objects[object].texcoords;
  __global const float* corners = world->texcoords + 6 * (size_t)number;
  return (1.0f - b - c) * vload2(0, corners) + b * vload2(1, corners) + c * vload2(2, corners);
}
#endif

// Of a matt surface, at a point in a triangle.
static inline Reflector reflector_at(const World* world, const Surface* surface, uint triangle) {
  const DeviceMaterial material = material_of(world, surface->object);
  Reflector reflector = reflector_of_row(material.reflector);
#if NEPHROID_TEXTURES
  if (is_matt(&material) && material.texture >= 0) {
    const DeviceTexture texture = world->textures[material.texture];
    const float2 at = texcoord_at(world, triangle, surface->object, surface->position);
    const float2 place = (float2)(texture.u[0] * at.x + texture.u[1] * at.y + texture.u[2],
                                  texture.v[0] * at.x + texture.v[1] * at.y + texture.v[2]);
    reflector.is_textured = true;
    reflector.rgb = texture_colour(world, &texture, place);
  }
#endif
  return reflector;
}
