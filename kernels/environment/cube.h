// SPDX-License-Identifier: Apache-2.0
// The cube of receivers: six square faces seen from the middle of the caustic object. Faces, s and t are those of
// app/environment/segment/cube.h; a texel's number counts face after face and row after row.
typedef struct {
  int face;
  float s, t; // -1..1
} CubePoint;

static inline CubePoint cube_point(float3 d) {
  const float3 a = fabs(d);
  CubePoint p;
  if (a.y >= a.x && a.y >= a.z) {
    p.face = d.y > 0.0f ? 2 : 3;
    p.s = d.x / a.y;
    p.t = (d.y > 0.0f ? d.z : -d.z) / a.y;
  } else if (a.x >= a.z) {
    p.face = d.x > 0.0f ? 0 : 1;
    p.s = (d.x > 0.0f ? -d.z : d.z) / a.x;
    p.t = -d.y / a.x;
  } else {
    p.face = d.z > 0.0f ? 4 : 5;
    p.s = (d.z > 0.0f ? d.x : -d.x) / a.z;
    p.t = -d.y / a.z;
  }
  return p;
}

// The result is not of unit length.
static inline float3 cube_direction(int face, float s, float t) {
  switch (face) {
  case 0: return (float3)(1.0f, -t, -s);
  case 1: return (float3)(-1.0f, -t, s);
  case 2: return (float3)(s, 1.0f, t);
  case 3: return (float3)(s, -1.0f, -t);
  case 4: return (float3)(s, -t, 1.0f);
  default: return (float3)(-s, -t, -1.0f);
  }
}

// The unit direction of a texel's middle.
static inline float3 cube_texel_direction(uint texel, int size) {
  const uint face_texels = (uint)(size * size), face = texel / face_texels, rest = texel % face_texels;
  const float s = (2.0f * (float)(rest % (uint)size) + 1.0f) / (float)size - 1.0f;
  const float t = (2.0f * (float)(rest / (uint)size) + 1.0f) / (float)size - 1.0f;
  return normalize(cube_direction((int)face, s, t));
}

// The texel that a direction lies in.
static inline uint cube_texel(float3 direction, int size) {
  const CubePoint p = cube_point(direction);
  const int x = clamp((int)(0.5f * (p.s + 1.0f) * (float)size), 0, size - 1),
            y = clamp((int)(0.5f * (p.t + 1.0f) * (float)size), 0, size - 1);
  return (uint)((p.face * size + y) * size + x);
}

// The four texels about a direction with their bilinear weights. A face's outermost texels continue beyond its border.
typedef struct {
  uint texels[4];
  float weights[4];
} CubeTexels;

static inline CubeTexels cube_texels(float3 direction, int size) {
  const CubePoint p = cube_point(direction);
  const float last = (float)(size - 1);
  const float x = clamp(0.5f * (p.s + 1.0f) * (float)size - 0.5f, 0.0f, last),
              y = clamp(0.5f * (p.t + 1.0f) * (float)size - 0.5f, 0.0f, last);
  const int x0 = min((int)x, size - 2), y0 = min((int)y, size - 2);
  const float u = x - (float)x0, v = y - (float)y0;
  const uint first = (uint)((p.face * size + y0) * size + x0);
  const CubeTexels four = {{first, first + 1u, first + (uint)size, first + (uint)size + 1u},
                           {(1.0f - u) * (1.0f - v), u * (1.0f - v), (1.0f - u) * v, u * v}};
  return four;
}
