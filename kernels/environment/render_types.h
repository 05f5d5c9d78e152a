// SPDX-License-Identifier: Apache-2.0
// Structs that engine 2's host code writes and its kernels read. Lengths are in scene units.
#ifndef NEPHROID_RENDER_TYPES_H
#define NEPHROID_RENDER_TYPES_H

#include "kernels/tracing/shared_types.h"

#ifndef __OPENCL_C_VERSION__
namespace nephroid::shared {
#endif

// What the host knows of a texel of the receivers' cube.
#define RECEIVER_UNSEEN 0 // no path from the eye has ended near it
#define RECEIVER_WANTED 1 // one has
#define RECEIVER_KNOWN 2  // it is in the list of those that are worked out

// Where a path from the eye ended.
#define END_NOWHERE 0 // lost, or not used
#define END_SKY 1
#define END_SURFACE 2

#ifdef __OPENCL_C_VERSION__
#define ENDS_OF_PIXEL (NEPHROID_JITTER ? 4 : 2)
#endif

// Caustics that one light makes by one baked direction: its spheres, turned so that they fit the light.
typedef struct {
  float4 to_bake[3]; // rows of the rotation from the scene into the coordinates of that direction's spheres
  float4 flux;       // linear sRGB: the light's irradiance on a plane that faces it, times the direction's weight
  int direction;     // of the bake, then of the lights' own
  int first_map;     // its first sphere, counting all spheres of the directions before
  int own;           // 1: its spheres are those of lights' own directions
  int padding;
} DeviceTurnedSet;

// The radii of the spheres, and how they are stored.
typedef struct {
  int count;      // of spheres of a baked direction
  int side;       // texels across and down a sphere's map
  float scale;    // from a stored number to E r^2 in scene units squared, for light of 1 W/m^2
  int own_count;  // of spheres of a light's own direction, whose radii follow the others
} DeviceSpheres;

// A pixel whose first surface is glass has one of what it reflects and one of what it lets through, or three of that where glass parts
// colours. Other pixels have one.
typedef struct {
  float4 throughput; // linear sRGB that white radiance there is to the pixel; w: END_*
  float4 place;      // sky: the direction; surface: its position; w: Surface::offset
  float4 geometric;  // surface: the triangle's unit normal on the side that is seen; w: the primitive
  float4 shading;    // the same of the shading normal; w: the reflector
} DeviceEnd;

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(DeviceTurnedSet) == 80 && sizeof(DeviceSpheres) == 16 && sizeof(DeviceEnd) == 64);
} // namespace nephroid::shared
#endif

#endif
