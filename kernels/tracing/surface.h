// SPDX-License-Identifier: Apache-2.0
// From a hit of the tree to a point on a surface: exact position, geometric and shading normal, object.
#include "kernels/tracing/bvh.h"
#include "kernels/tracing/shared_types.h"

#ifndef NEPHROID_SMOOTH
#define NEPHROID_SMOOTH 1
#endif

typedef struct {
  GEOMETRY_TABLES(TABLE_MEMBER)
  int root;
} Geometry;

typedef struct {
  float3 position;
  float3 geometric; // unit normal of the triangle or ellipsoid, outwards
  float3 shading;   // unit; equals geometric unless the object is smooth
  float offset;     // how far a new ray starts from the surface, along the geometric normal
  int object;
} Surface;

// How a place and a direction move with something: their derivatives by it (differential.h).
typedef struct {
  float3 position, direction; // P', D'
} Differential;

static inline int kind_of(const DevicePrimitive* primitive) { return as_int(primitive->corner.w) & 3; }
static inline int object_of(const DevicePrimitive* primitive) { return as_int(primitive->corner.w) >> 2; }
static inline bool is_ellipsoid(const DevicePrimitive* primitive) {
  return NEPHROID_ELLIPSOIDS && kind_of(primitive) >= PRIMITIVE_ELLIPSOID;
}

static inline int object_of_primitive(const Geometry* geometry, uint primitive) {
  return as_int(geometry->primitives[primitive].corner.w) >> 2;
}

// Unpacks a vertex normal of 21 bits a coordinate, in units of 2^-20, each moved to the top of a word.
static inline float3 unpacked_normal(float low, float high) {
  const uint x = as_uint(low), y = as_uint(high);
  return (float3)((float)(int)(x << 11), (float)(int)(x >> 21 << 11 | y << 22), (float)(int)(y >> 10 << 11)) * 0x1p-31f;
}

typedef struct {
  float3 first, second, third;
} VertexNormals;

static inline VertexNormals vertex_normals(const DevicePrimitive* triangle) {
  const VertexNormals normals = {unpacked_normal(triangle->normal.x, triangle->normal.y),
                                 unpacked_normal(triangle->normal.z, triangle->normal.w),
                                 unpacked_normal(triangle->edge_u.w, triangle->edge_v.w)};
  return normals;
}

#if NEPHROID_ELLIPSOIDS
// M way, with M the matrix to the unit sphere.
static inline float3 to_unit_sphere(const DevicePrimitive* ellipsoid, float3 way) {
  return (float3)(dot(ellipsoid->edge_u.xyz, way), dot(ellipsoid->edge_v.xyz, way), dot(ellipsoid->normal.xyz, way));
}

// M^T u, with the matrix M to the unit sphere. It is along the normal at the point that M takes to u.
static inline float3 ellipsoid_gradient(const DevicePrimitive* ellipsoid, float3 unit) {
  return unit.x * ellipsoid->edge_u.xyz + unit.y * ellipsoid->edge_v.xyz + unit.z * ellipsoid->normal.xyz;
}

// The point that M takes to u. The rows m_i of M are perpendicular, so it is the sum of u_i m_i / |m_i|^2.
static inline float3 ellipsoid_point(const DevicePrimitive* ellipsoid, float3 unit) {
  const float3 x = ellipsoid->edge_u.xyz, y = ellipsoid->edge_v.xyz, z = ellipsoid->normal.xyz;
  const float3 along = unit / (float3)(dot(x, x), dot(y, y), dot(z, z));
  return ellipsoid->corner.xyz + along.x * x + along.y * y + along.z * z;
}

// 1, or -1 where the ellipsoid's normals point inwards.
static inline float ellipsoid_side(const DevicePrimitive* ellipsoid) {
  return kind_of(ellipsoid) == PRIMITIVE_ELLIPSOID_INWARDS ? -1.0f : 1.0f;
}

// bvh_ellipsoid knows when a ray leaves the ellipsoid, so the offset need only be as large as the position's rounding.
static inline Surface ellipsoid_at(const DevicePrimitive* ellipsoid, float3 unit) {
  Surface surface;
  const float3 gradient = ellipsoid_gradient(ellipsoid, unit);
  surface.position = ellipsoid_point(ellipsoid, unit);
  surface.geometric = surface.shading = gradient * (ellipsoid_side(ellipsoid) / sqrt(dot(gradient, gradient)));
  const float3 size = fabs(ellipsoid->corner.xyz) + fabs(surface.position);
  surface.offset = 0x1p-23f * max(max(size.x, size.y), size.z);
  surface.object = object_of(ellipsoid);
  return surface;
}
#endif

// How far a new ray starts from a triangle. The interpolated point and the distance at which a ray meets a neighbour in
// the same plane are off by a few 2^-24 of the triangle's largest coordinate.
static inline float triangle_offset(float3 corner, float3 edge_u, float3 edge_v) {
  const float3 size = max(fabs(corner), max(fabs(edge_u), fabs(edge_v)));
  return 0x1p-21f * max(max(size.x, size.y), size.z);
}

// Barycentric interpolation rounds relative to the triangle's size, origin + t * direction to the distance.
static inline Surface surface_at(const Geometry* geometry, Hit hit) {
  const DevicePrimitive triangle = geometry->primitives[hit.primitive];
#if NEPHROID_ELLIPSOIDS
  if (is_ellipsoid(&triangle)) return ellipsoid_at(&triangle, (float3)(hit.u, hit.v, hit.w));
#endif
  Surface surface;
  surface.position = triangle.corner.xyz + hit.u * triangle.edge_u.xyz + hit.v * triangle.edge_v.xyz;
  surface.geometric = surface.shading = triangle.normal.xyz;
  surface.offset = triangle.normal.w;
  surface.object = object_of(&triangle);
#if NEPHROID_SMOOTH
  if (kind_of(&triangle) == PRIMITIVE_SMOOTH) {
    surface.geometric = surface.shading = normalize(cross(triangle.edge_u.xyz, triangle.edge_v.xyz));
    surface.offset = triangle_offset(triangle.corner.xyz, triangle.edge_u.xyz, triangle.edge_v.xyz);
    const VertexNormals n = vertex_normals(&triangle);
    const float3 mixed = (1.0f - hit.u - hit.v) * n.first + hit.u * n.second + hit.v * n.third;
    if (dot(mixed, surface.geometric) > 0.0f) surface.shading = normalize(mixed);
  }
#endif
  return surface;
}

// The start of a ray that leaves on the outer (side 1) or inner (side -1) side.
static inline float3 start_on_side(const Surface* surface, float side) {
  return surface->position + side * surface->offset * surface->geometric;
}

// 1: a matt surface has a normal map.
#ifndef NEPHROID_NORMAL_MAPS
#define NEPHROID_NORMAL_MAPS 0
#endif

// The part of the light along the unit vector `way`, to or from it, that a surface with such a normal as its shading
// normal takes: 1, or less where it would take more than what falls on the triangle over the cosine of both normals
// (Chiang, Li and Burley 2019, "Taming the Shadow Terminator", without its smoothing); 0 from behind one of both.
static inline float part_at_normal(const Surface* surface, float3 way) {
#if NEPHROID_NORMAL_MAPS
  const float falls = dot(way, surface->geometric),
              takes = dot(way, surface->shading) * dot(surface->shading, surface->geometric);
  if (falls * takes <= 0.0f) return 0.0f;
  return fabs(takes) > fabs(falls) ? falls / takes : 1.0f;
#else
  return 1.0f;
#endif
}

// The limit of shading_ratio, without which photons near grazing, within 3.6 degrees, would be bright specks.
#define SHADING_RATIO_LIMIT 16.0f

// The factor that makes a photon's flux on a triangle the irradiance about the shading normal, by which direct.cl
// lights the surface. It is the ratio of both cosines (Veach 1997, 5.3.2), and 0 behind the shading normal's horizon.
static inline float shading_ratio(const Surface* surface, float3 arriving) {
#if NEPHROID_SMOOTH
  const float ratio = dot(arriving, surface->shading) / dot(arriving, surface->geometric) *
                      part_at_normal(surface, arriving);
  return ratio > 0.0f ? (ratio < SHADING_RATIO_LIMIT ? ratio : SHADING_RATIO_LIMIT) : 0.0f;
#else
  return 1.0f;
#endif
}

// The normal on a ray's side: the shading normal, or where that looks away the triangle's own.
static inline float3 normal_before(float3 direction, const Surface* surface) {
  const float side = dot(direction, surface->geometric) < 0.0f ? 1.0f : -1.0f;
  const float3 shading = side * surface->shading;
  return dot(direction, shading) < 0.0f ? shading : side * surface->geometric;
}
