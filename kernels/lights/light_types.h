// SPDX-License-Identifier: Apache-2.0
// The lights, each on one line: LIGHT(its word in presets, its name here, its row, what it has, its sentence). The
// lists make the preset's words and the numbers LIGHT_*, join the rows to DeviceLight, and send what a light can do to
// its file in kernels/lights (lights.h) and in app/lights (lights.h).
#ifndef NEPHROID_LIGHT_TYPES_H
#define NEPHROID_LIGHT_TYPES_H

#include "kernels/tracing/shared_types.h"

// What a light of presets has.
#define LIGHT_HAS_POSITION 1u   // a place of its own
#define LIGHT_HAS_DIRECTION 2u  // a way that its light goes
#define LIGHT_HAS_EDGES 4u      // a rectangle
#define LIGHT_HAS_IRRADIANCE 8u // from far away: an irradiance in place of a power
#define LIGHT_HAS_OBJECT 16u    // an object whose surface shines

// clang-format off
#define LIGHTS(LIGHT) \
  LIGHT(point, POINT, DevicePoint, LIGHT_HAS_POSITION, "A point that shines equally to all sides.") \
  LIGHT(spot, SPOT, DeviceSpot, LIGHT_HAS_POSITION | LIGHT_HAS_DIRECTION, "A point that shines into a cone.") \
  LIGHT(directional, DIRECTIONAL, DeviceDirectional, LIGHT_HAS_DIRECTION | LIGHT_HAS_IRRADIANCE, \
        "Parallel light, as from the sun.") \
  LIGHT(area, AREA, DeviceArea, LIGHT_HAS_POSITION | LIGHT_HAS_DIRECTION | LIGHT_HAS_EDGES, \
        "A rectangle that shines to one side by the cosine law.") \
  LIGHT(mesh, MESH, DeviceMesh, LIGHT_HAS_OBJECT, \
        "An object whose surface shines evenly to its outside by the cosine law.")

// The environment has no word: presets describe it by itself. It is a scene's last light.
#define ALL_LIGHTS(LIGHT) LIGHTS(LIGHT) LIGHT(environment, ENVIRONMENT, DeviceEnvironment, LIGHT_HAS_IRRADIANCE, "")
// clang-format on

#define LIGHT_NUMBER(word, NAME, Row, has, sentence) LIGHT_##NAME,
enum { ALL_LIGHTS(LIGHT_NUMBER) LIGHT_TYPE_COUNT };

#ifndef __OPENCL_C_VERSION__
namespace nephroid::shared {
#endif

typedef struct {
  float4 position;
  float4 direction, c_0, c_90; // of photometry, unit: of gamma = 0, and across it to C = 0 and 90 degrees
} DevicePoint;

// A point's photometry: intensities at even steps of gamma, from 0 to 180 degrees, and of C, from 0 to 360.
#define PHOTOMETRY_GAMMAS 361
#define PHOTOMETRY_PLANES 361

typedef struct {
  float4 position;
  float4 direction; // unit: of the cone's axis
  float one_minus_cos; // 1 - cos of the cone's half angle; less than NARROW_SPOT: see is_narrow (spot.h)
  float solid_angle;   // of the cone, in steradians
} DeviceSpot;

#define NARROW_SPOT 0.05f // half an angle of 18 degrees

typedef struct {
  float4 direction;    // unit, the way the light goes; radiometric is its irradiance in W m^-2
  float one_minus_cos; // of half the angle of the disc that it comes from; 0: a point
} DeviceDirectional;

typedef struct {
  float4 centre;
  float4 normal;         // unit
  float4 edge_u, edge_v; // the full edges
  int width, height;     // of a picture
} DeviceArea;

typedef struct {
  float4 xyz;                // of its spectrum
  float area;                  // in square units
  int first_surface, surfaces; // in the table of triangles
} DeviceMesh;

typedef struct {
  float4 mean_colour; // of its photons; radiometric is the irradiance of all directions together
} DeviceEnvironment;

typedef struct {
  int type;         // LIGHT_*
  int number;       // among the preset's lights, so that its random numbers do not depend on lights left out
  int first_target; // the first of its targets in the table: those that this light can reach
  int target_count;
  Media inside;      // what encloses it; directional, environment: none
  float radiometric; // power in W, unless its row says otherwise
  int table; // of photometry, a picture, or the chances of a mesh's surfaces: its first item in lamp_tables; -1: none
  int padding[2];
#define LIGHT_ROW(word, NAME, Row, has, sentence) Row word;
  union {
    ALL_LIGHTS(LIGHT_ROW)
  } as;
} DeviceLight;

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(DevicePoint) == 64 && sizeof(DeviceSpot) == 48 && sizeof(DeviceDirectional) == 32);
static_assert(sizeof(DeviceArea) == 80 && sizeof(DeviceMesh) == 32 && sizeof(DeviceEnvironment) == 16);
static_assert(sizeof(DeviceLight) == 128);
} // namespace nephroid::shared
#endif

#endif
