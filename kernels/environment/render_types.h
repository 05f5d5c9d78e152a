// SPDX-License-Identifier: Apache-2.0
// Structs that engine 2's host code writes and its kernels read. Lengths are in scene units.
#ifndef NEPHROID_RENDER_TYPES_H
#define NEPHROID_RENDER_TYPES_H

#include "kernels/tracing/shared_types.h"

#ifndef __OPENCL_C_VERSION__
namespace nephroid::shared {
#endif

// The state of a texel of the receivers' cube on the host.
#define RECEIVER_UNSEEN 0 // no path from the eye has ended near it
#define RECEIVER_WANTED 1 // one has
#define RECEIVER_KNOWN 2  // it is in the list of texels that are worked out

// Where a path from the eye ended.
#define END_NOWHERE 0 // lost, or not used
#define END_SKY 1
#define END_SURFACE 2

#ifdef __OPENCL_C_VERSION__
#define ENDS_OF_PIXEL (NEPHROID_JITTER ? 4 : 2)
#endif

// Eight sets of spheres. A set is what one light makes by one baked direction, turned so that it fits the light. A CPU
// looks up eight side by side in its vectors. Unused places of the last eight have no flux.
typedef struct {
  float to_bake[9][8]; // rows of the rotation from the scene into the coordinates of that direction's spheres
  float flux[3][8];    // linear sRGB: the light's irradiance on a plane that faces it, times the direction's weight
  ulong first[8];      // number of the direction's first map
} DeviceEightSets;

// The radii of the spheres, and how they are stored.
typedef struct {
  int count;   // spheres of a baked direction
  int side;    // texels across and down a sphere's map; it is stored with a border of one more texel all around
  float scale; // from a stored number to E r^2 in scene units squared, for light of 1 W/m^2
  int padding;
} DeviceSpheres;

// A texel of a sphere is stored as its brightness, (R + 2 G + B) / 4, in 0 to 255 steps. Texels of a block share the
// rest: the way of their light; the step, the upper 16 bits of a float; and their colour, which is red and blue over
// the brightness, 8 bits each.
#define BLOCK_ACROSS_BITS 2 // a block has 4 x 2 texels
#define BLOCK_DOWN_BITS 1
#define COLOUR_STEPS 32.0f // codes a unit of brightness
#define COLOUR_ZERO 96.0f  // the code of none

// Blocks across and down the stored form of a map. One more than there are across, so that two may be read at once.
#define BLOCKS_ACROSS(side) ((((side) + 1) >> BLOCK_ACROSS_BITS) + 2)
#define BLOCKS_DOWN(side) ((((side) + 1) >> BLOCK_DOWN_BITS) + 1)

// The end of a path from the eye. A pixel that first sees glass has one end by reflection and one through the glass, or
// three through it where glass parts colours. Other pixels have one.
typedef struct {
  float4 throughput; // what white radiance there is to the pixel, linear sRGB; w: END_*
  float4 place;      // sky: the direction; surface: its position; w: Surface::offset
  float4 geometric;  // surface: the triangle's unit normal on the side that is seen; w: the primitive. sky: u of its
                     // piece (piece.h); w: at.x
  float4 shading;    // surface: the shading normal on that side; w: the reflector. sky: v; w: at.y
} DeviceEnd;

// Blocks first, ..., first + count - 1 of block x block pixels, row after row, in a pass.
typedef struct {
  uint2 seed;
  uint pass;
  int block;
  uint first, count;
} DeviceBlocks;

// Texels first, ..., first + count - 1 of a list of those of the cube of receivers, which has size x size a face.
typedef struct {
  float4 middle; // of the cube
  uint first, count;
  int size;
  int light_count; // shadows.cl: lights that the environment is cut into
} DeviceTexels;

// The object's axes in the scene.
typedef struct {
  float4 x, y, z;
} DeviceAxes;

// What shade.cl says beside its buffers.
typedef struct {
  float4 middle; // of the cube of receivers, which has size x size texels a face
  DeviceBackground background;
  DeviceBlocks blocks;
  int size;
  int width, height; // of the picture
  int anew;          // 1: sums begin anew
  float radiance;    // of the texel (1, 1, 1)
  float power_unit;
  int sky_light_count;
  int padding;
} DeviceShading;

// What volume.cl says of the medium, and beside its buffers.
typedef struct {
  float4 middle; // of the spheres and of the cube of receivers, which has size x size texels a face
  DeviceAxes object;
  DeviceSpheres spheres;
  DeviceBlocks blocks;
  float extinction; // 1 / unit
  float albedo, anisotropy;
  int rayleigh;
  int size;
  int anew; // 1: sums begin anew
} DeviceMedium;

// What bake.cl says: photons first, ..., first + count - 1 of a direction, whose number keys their random numbers.
typedef struct {
  float4 direction;
  uint2 seed;
  uint number, first, count;
  int sphere_count, side; // spheres of a direction; texels across the map of one
  float scale;            // quanta a watt
} DeviceBakeLaunch;

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(DeviceBlocks) == 24 && sizeof(DeviceTexels) == 32 && sizeof(DeviceShading) == 96);
static_assert(sizeof(DeviceMedium) == 128 && sizeof(DeviceBakeLaunch) == 48);
static_assert(sizeof(DeviceEightSets) == 448 && sizeof(DeviceSpheres) == 16 && sizeof(DeviceEnd) == 64);
} // namespace nephroid::shared
#endif

#endif
