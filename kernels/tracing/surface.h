// SPDX-License-Identifier: Apache-2.0
// From a hit of the tree to a point on a surface: exact position, geometric and shading normal, object.
#ifndef NEPHROID_SURFACE_H
#define NEPHROID_SURFACE_H

#include "kernels/tracing/shared_types.h"
#include "kernels/tracing/bvh.h"
#include "kernels/tracing/fresnel.h"

#ifndef NEPHROID_SMOOTH
#define NEPHROID_SMOOTH 1
#endif

// The scene's triangles and ellipsoids as kernels see them; every vertex has three floats a table.
typedef struct {
  __global const float* nodes;    // bvh.h
  __global const float* blocks;   // bvh.h
  __global const uint* corners;   // three vertex numbers a triangle; an ellipsoid: see is_ellipsoid
  __global const float* positions;
  __global const float* normals;  // vertex normals, unit
  __global const uint* object_of_primitive;
  int root;
} Geometry;

typedef struct {
  float3 position;
  float3 geometric; // unit normal of the triangle or ellipsoid, outwards
  float3 shading;   // unit; equals geometric unless the object is smooth
  float offset;     // how far a new ray starts from the surface, along the geometric normal
  int object;
} Surface;

// Of an ellipsoid the three numbers are: its first float in the blocks of the tree, this mark, whether its normals look inwards.
static inline bool is_ellipsoid(uint3 corner) { return NEPHROID_ELLIPSOIDS && corner.y == NEPHROID_NO_PRIMITIVE; }

#if NEPHROID_ELLIPSOIDS
// M^T u with the rows m_i of the matrix M to the unit sphere: along the normal at the point that M takes to u.
static inline float3 ellipsoid_gradient(__global const float* ellipsoid, float3 unit)
{
  return unit.x * vload3(1, ellipsoid) + unit.y * vload3(2, ellipsoid) + unit.z * vload3(3, ellipsoid);
}

// The rows are perpendicular to each other, so what M takes to u is the sum of u_i m_i / |m_i|^2.
static inline float3 ellipsoid_point(__global const float* ellipsoid, float3 unit)
{
  const float3 x = vload3(1, ellipsoid), y = vload3(2, ellipsoid), z = vload3(3, ellipsoid);
  const float3 along = unit / (float3)(dot(x, x), dot(y, y), dot(z, z));
  return vload3(0, ellipsoid) + along.x * x + along.y * y + along.z * z;
}

// A ray that leaves an ellipsoid knows that it does (bvh_ellipsoid), so the offset need only be of the size of the position's rounding.
static inline Surface ellipsoid_at(__global const float* ellipsoid, bool inwards, int object, float3 unit)
{
  Surface surface;
  const float3 gradient = ellipsoid_gradient(ellipsoid, unit);
  surface.position = ellipsoid_point(ellipsoid, unit);
  surface.geometric = surface.shading = gradient * ((inwards ? -1.0f : 1.0f) / sqrt(dot(gradient, gradient)));
  const float3 size = fabs(vload3(0, ellipsoid)) + fabs(surface.position);
  surface.offset = 0x1p-23f * max(max(size.x, size.y), size.z);
  surface.object = object;
  return surface;
}
#endif

// Barycentric interpolation rounds relative to the triangle's size; origin + t * direction would round relative to the distance.
static inline Surface surface_at(const Geometry* geometry, __global const DeviceObject* objects, Hit hit)
{
  Surface surface;
  const uint3 corner = vload3(hit.primitive, geometry->corners);
#if NEPHROID_ELLIPSOIDS
  if (is_ellipsoid(corner))
    return ellipsoid_at(geometry->blocks + corner.x, corner.z != 0u, (int)geometry->object_of_primitive[hit.primitive],
                        (float3)(hit.u, hit.v, hit.w));
#endif
  const float3 a = vload3(corner.x, geometry->positions);
  const float3 ab = vload3(corner.y, geometry->positions) - a, ac = vload3(corner.z, geometry->positions) - a;
  surface.position = a + hit.u * ab + hit.v * ac;
  surface.geometric = normalize(cross(ab, ac));
  // Both the interpolated point and the distance at which a ray meets a neighbour in the same plane are off by a few 2^-24 of the
  // triangle's largest coordinate. Starting farther away than that keeps a new ray from meeting the surface that it leaves.
  const float3 size = max(fabs(a), max(fabs(ab), fabs(ac)));
  surface.offset = 0x1p-21f * max(max(size.x, size.y), size.z);
  surface.object = (int)geometry->object_of_primitive[hit.primitive];
  surface.shading = surface.geometric;
#if NEPHROID_SMOOTH
  if (objects[surface.object].smooth) {
    const float3 mixed = (1.0f - hit.u - hit.v) * vload3(corner.x, geometry->normals) + hit.u * vload3(corner.y, geometry->normals) +
                         hit.v * vload3(corner.z, geometry->normals);
    if (dot(mixed, surface.geometric) > 0.0f) surface.shading = normalize(mixed);
  }
#endif
  return surface;
}

// A start for a ray that leaves on the outer (side 1) or inner (side -1) side.
static inline float3 start_on_side(const Surface* surface, float side) { return surface->position + side * surface->offset * surface->geometric; }

// A photon near grazing may count as so many: where a facet gets next to nothing, and its shading normal says otherwise, single photons would
// be bright specks. What is cut off is less than the light on a facet that arrives within 3.6 degrees of it.
#define SHADING_RATIO_LIMIT 16.0f

// What makes a photon's flux on a triangle the irradiance about the shading normal, by which direct.cl lights the surface: the ratio of both
// cosines (Veach 1997, 5.3.2); 0 behind the shading normal's horizon.
static inline float shading_ratio(const Surface* surface, float3 arriving)
{
#if NEPHROID_SMOOTH
  const float ratio = dot(arriving, surface->shading) / dot(arriving, surface->geometric);
  return ratio > 0.0f ? (ratio < SHADING_RATIO_LIMIT ? ratio : SHADING_RATIO_LIMIT) : 0.0f;
#else
  return 1.0f;
#endif
}

// What a mirror or dielectric does to a ray: the new direction, and whether the ray went through.
typedef struct {
  float3 direction;
  float3 normal;    // unit, on the side that the ray came from: what it was bent about
  int near_material; // of an interface, before it and beyond it; -1: air
  int far_material;
  bool transmitted;
  bool straight; // nothing bent it: the normal is not set
} Bend;

// normal: unit, on the side that the ray comes from. choice: uniform in [0, 1): below the reflectance the ray is reflected.
static inline Bend bend_at(float3 direction, float3 normal, float n_i, float n_t, float choice)
{
  Bend bend;
  bend.normal = normal;
  bend.near_material = bend.far_material = -1;
  bend.straight = false;
  const float cos_i = clamp(-dot(direction, normal), 0.0f, 1.0f);
  const float eta = n_i / n_t;
  const float cos_t = refracted_cosine(cos_i, eta);
  bend.transmitted = cos_t >= 0.0f && !(choice < fresnel_reflectance(cos_i, cos_t, n_i, n_t));
  bend.direction = bend.transmitted ? refract_through(direction, normal, cos_i, cos_t, eta) : reflect_about(direction, normal, cos_i);
  return bend;
}

// Bends about the shading normal, unless that sends the ray to the wrong side of the triangle: then about the triangle's own normal.
static inline Bend bend_at_surface(float3 direction, const Surface* surface, float n_i, float n_t, float choice)
{
  const float side = dot(direction, surface->geometric) < 0.0f ? 1.0f : -1.0f;
  const float3 geometric = side * surface->geometric, shading = side * surface->shading;
  Bend bend = bend_at(direction, dot(direction, shading) < 0.0f ? shading : geometric, n_i, n_t, choice);
  const float leaves = dot(bend.direction, geometric);
  if (bend.transmitted ? leaves >= 0.0f : leaves <= 0.0f) bend = bend_at(direction, geometric, n_i, n_t, choice);
  return bend;
}

#endif
