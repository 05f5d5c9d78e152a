// SPDX-License-Identifier: Apache-2.0
// Structs that the host writes and kernels read, with the sizes checked on the host.
// Lengths are in scene units unless a name says metres.
#ifndef NEPHROID_SHARED_TYPES_H
#define NEPHROID_SHARED_TYPES_H

#include "kernels/scatter/material_types.h"
#include "kernels/tracing/scene_table_types.h"

#ifndef __OPENCL_C_VERSION__
#include <cstdint>
namespace nephroid::shared {
using uint = std::uint32_t;
using ulong = std::uint64_t;
using ushort = std::uint16_t;
struct alignas(16) float4 {
  float x, y, z, w;
};
struct alignas(8) uint2 {
  uint x, y;
};
#endif

// optics::wavelength_count: 380..780 nm in steps of 1 nm, but for meters (optics/wavelength.h).
#define WAVELENGTH_COUNT 401

// At most this many dielectrics may enclose one point; they take 128 bits.
#define MEDIA_DEPTH 8
#define MEDIUM_BITS 16

// At most this many spheres stand for the caustic objects.
#define MAX_TARGETS 16
// How many times as densely as on the mean a target may have photons (targets.h).
#define MOST_CROWDED 256.0f

// The histogram that guides a light's photons (guide.h): bins of the numbers that pick a target and a direction in it.
#define GUIDE_BINS_X 16
#define GUIDE_BINS_Y 16
#define GUIDE_BINS_Z 16
#define GUIDE_CELLS (GUIDE_BINS_X * GUIDE_BINS_Y * GUIDE_BINS_Z)
#define GUIDE_FLOATS (GUIDE_BINS_X + GUIDE_BINS_X * GUIDE_BINS_Y + GUIDE_CELLS)

// Where a photon ended. The energy counters, in quanta of power (RunTables::energy_scale), are in this order.
#define OUTCOME_EMITTED 0   // sum of the next five
#define OUTCOME_DEPOSITED 1 // on a diffuse surface after glass or a mirror
#define OUTCOME_MISSED 2    // met no glass and no mirror: direct light
#define OUTCOME_ABSORBED 3  // in glass or at its surface, by a mirror or metal, by roughness
#define OUTCOME_ESCAPED 4   // left the scene after glass or a mirror
#define OUTCOME_LOST 5      // met max_surfaces interfaces, or more than MEDIA_DEPTH nested media
#define OUTCOME_REFUSED 6   // a plain count: film contributions too large for the film's fixed point
#define OUTCOME_SEGMENTS 7  // a plain count: rays that the photons' paths are made of
#define OUTCOME_COUNT 8

// What the table surface_data has of a plastic's coat (scatter/plastic.h): its index of refraction, the part of light
// from all sides that passes it; then the part that passes it by the cosine of the way, at COAT_COSINES cosines from 0
// to 1.
#define COAT_MEAN 1
#define COAT_PARTS 2
#define COAT_COSINES 256

// What the table surface_data has of a glazing (scatter/glazing.h): a row for each of GLAZING_ANGLES angles, at the
// cosines (i / (GLAZING_ANGLES - 1))^2. In a row: what passes; what is reflected of light from the front; of light from
// the back. Each is 401 parts by wavelength, then their mean in sunlight.
#define GLAZING_ANGLES 48
#define GLAZING_PARTS (WAVELENGTH_COUNT + 1)
#define GLAZING_ROW (3 * GLAZING_PARTS)

typedef struct {
  int type;            // MATERIAL_*
  int reflector;       // matt, tint with a texture: row of the reflectance tables; with a texture its red, green and
                       // blue rows follow
  int attenuator;      // absorbing dielectric, mirror: row of the attenuation table; -1: none
  int tint;            // dielectric: row of the attenuation table for what passes its surface; -1: none, or a texture
  int surface_first;   // metal, coated dielectric, plastic, glazing: its first item in surface_data; -1: none. A
                       // coating has its 401 indices there, then its thickness in each wavelength
  int is_thin;         // dielectric: a pane without thickness
  float alpha;         // of GGX (scatter/microfacet.h); 0: polished
  int texture;         // of its reflectance or tint: number of a texture (scatter/texture.h); -1: none
  int roughness_texture; // the same of its roughness
  int normal_map;        // the same of its normals
  int splits_wavelengths; // dielectric: its surface bends or reflects each wavelength otherwise
} DeviceMaterial;

typedef struct {
  int material;
  int priority;
  int texcoords; // with textures: its triangles' numbers less those of their texcoords
} DeviceObject;

// The preset's words for what is beyond a texture's edges.
#define WRAP_REPEAT 0
#define WRAP_MIRROR 1
#define WRAP_CLAMP 2

// A picture on a surface: scatter/texture.h.
typedef struct {
  uint first;        // of its texels in the table
  int width, height;
  int wrap;          // WRAP_*
  int nearest;       // 1: texels have edges; 0: bilinear
  float u[3], v[3];  // a place in it: u[0] * u + u[1] * v + u[2] of a triangle's u and v
} DeviceTexture;

// The dielectric objects that enclose a point, each as its number + 1 in MEDIUM_BITS: media.h.
typedef struct {
  ulong latest, earlier; // the last four objects entered, the last one in the lowest bits; the four before
} Media;

// A sphere about a caustic object or a part of one; photons are sent towards these only. The table has lists of them.
typedef struct {
  float4 centre_radius; // w: radius
} DeviceTarget;

// The photons of one wavelength cluster from one light. The emitters of a light follow each other. Photon i of a pass
// belongs to the last emitter with first_photon <= i, or with low-discrepancy numbers to any emitter of the same light,
// each as often as its photon_count says (photon_path.h).
typedef struct {
  uint first_photon;
  uint photon_count;
  int light;
  int cluster;
  float share;             // the cluster's share of the light's power, 0..1
  uint light_first_photon; // for all emitters of this light together
  uint light_photon_count;
  uint sequence;            // the low-discrepancy sequence of these photons,
  uint sequence_start;      // and the place of each half of the film in it: the photons of earlier allocations, lower
  uint sequence_start_high; // and upper 32 bits
  int padding[2];
} DeviceEmitter;

typedef struct {
  float4 position;
  float4 right, up, forward; // orthonormal
  float tan_x, tan_y;        // tangents of half the angle of view; orthographic: half the picture's edges
  int width, height;         // pixels
  Media inside;
  int receiver; // the object whose light is mapped, whatever hides it; -1: an eye sees all, or a meter is in the air
  // With NEPHROID_LENS, as scene::Camera has them:
  int orthographic;
  float shift_x, shift_y; // tangents: the way of the middle of the picture is forward + shift_x right + shift_y up
  float lens_radius, focus;
  int meter_charts, first_piece; // of a meter (meter.h): how many charts; the number of its first primitive
} DeviceCamera;

// A flat grid of a meter's cells. right, up, normal: unit.
typedef struct {
  float4 right, up, normal; // w: of the grid's left and its top, along right and up; of the plane, along its normal
  float columns_per_unit, rows_per_unit;
  int columns, rows;
  int first;   // its first place in meter_cells
  int is_flat; // all of the surface is in its plane, or in the air
  int padding[2];
} DeviceMeterChart;

// The environment's picture: see background.h and sky.h.
typedef struct {
  int width, height; // texels
  float turns;       // turn of the picture about +y, counterclockwise as seen from above
  int has_peaks;     // as a light: whether it is drawn by its peaks too (sky.h)
} DeviceBackground;

#define PRIMITIVE_FLAT 0
#define PRIMITIVE_SMOOTH 1
#define PRIMITIVE_ELLIPSOID 2
#define PRIMITIVE_ELLIPSOID_INWARDS 3 // its normals look towards its centre

// A triangle or ellipsoid as a hit reads it: 64 bytes, a line of a processor's cache. In a smooth triangle `normal` and
// the w of edge_u and edge_v hold the normals of its vertices, 8 bytes each (surface.h).
typedef struct {
  float4 corner; // first corner; ellipsoid: its centre. w: as_int, the object's number << 2 | PRIMITIVE_*
  float4 edge_u; // from there to the second corner; ellipsoid: first row of the matrix to the unit sphere
  float4 edge_v; // to the third corner; ellipsoid: second row
  float4 normal; // flat triangle: unit, outwards, w: how far a new ray starts from it; ellipsoid: third row
} DevicePrimitive;

// Where each table begins in its block.
typedef struct {
  GEOMETRY_TABLES(TABLE_FIRST)
  OTHER_TABLES(TABLE_FIRST)
} DeviceTables;

typedef struct {
  int root; // the tree's root: bvh.h
  int material_count;
  int light_count;
  int cluster_count;
  int emitter_count;
  float metres_per_unit;
  float outside_distance; // directional photons start this far before their target, outside everything
  int max_surfaces;       // surfaces that a path may meet before it counts as lost
  int reflector_count;
  DeviceBackground sky_size; // the environment's as a light, if it is one
  DeviceTables first;
} DeviceScene;

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(DeviceMaterial) == 44 && sizeof(DeviceObject) == 12 && sizeof(Media) == 16);
static_assert(sizeof(DeviceTarget) == 16 && sizeof(DeviceEmitter) == 48);
static_assert(sizeof(DeviceCamera) == 128 && sizeof(DeviceScene) == 52 + sizeof(DeviceTables));
static_assert(sizeof(DeviceBackground) == 16);
static_assert(sizeof(DeviceMeterChart) == 80);
static_assert(sizeof(DevicePrimitive) == 64 && sizeof(DeviceTexture) == 44);
} // namespace nephroid::shared
#endif

#endif
