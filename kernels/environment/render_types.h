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

// Eight sets of spheres, each of them what one light makes by one baked direction, turned so that it fits the light.
// They are looked up side by side, as a CPU's vectors do best. What is left over of the last eight has no flux.
typedef struct {
  float to_bake[9][8]; // rows of the rotation from the scene into the coordinates of that direction's spheres
  float flux[3][8];    // linear sRGB: the light's irradiance on a plane that faces it, times the direction's weight
  ulong first[8];      // of the direction's texels among all that are stored
} DeviceEightSets;

// The radii of the spheres, and how they are stored.
typedef struct {
  int count;   // of spheres of a baked direction
  int side;    // texels across and down a sphere's map; it is stored with a border of one more texel all around
  float scale; // from a stored number to E r^2 in scene units squared, for light of 1 W/m^2
  int padding;
} DeviceSpheres;

// A pixel whose first surface is glass has one of what it reflects and one of what it lets through, or three of that
// where glass parts colours. Other pixels have one.
typedef struct {
  float4 throughput; // linear sRGB that white radiance there is to the pixel; w: END_*
  float4 place;      // sky: the direction; surface: its position; w: Surface::offset
  float4 geometric;  // surface: the triangle's unit normal on the side that is seen; w: the primitive
  float4 shading;    // the same of the shading normal; w: the reflector
} DeviceEnd;

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(DeviceEightSets) == 448 && sizeof(DeviceSpheres) == 16 && sizeof(DeviceEnd) == 64);
} // namespace nephroid::shared
#endif

#endif
