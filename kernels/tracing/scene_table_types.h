// SPDX-License-Identifier: Apache-2.0
// The tables of a scene, each on one line: TABLE(type of an item, name, words for readers). These lists make the host's
// vectors, their place on the device and the plan's memory (app/tracing), and the kernels' structs (world.h). A new
// table is a line here and the code that fills it. On the device they lie one after the other in two blocks, of where
// surfaces are and of all the rest. DeviceScene says where each begins, in steps of TABLE_STEP bytes.
#ifndef NEPHROID_SCENE_TABLE_TYPES_H
#define NEPHROID_SCENE_TABLE_TYPES_H

#define TABLE_STEP 128

// clang-format off

// Where surfaces are: bvh.h, surface.h.
#define GEOMETRY_TABLES(TABLE) \
  TABLE(float, nodes, "tree nodes") \
  TABLE(float, blocks, "tree triangles") \
  TABLE(DevicePrimitive, primitives, "triangles")

#define OBJECT_TABLES(TABLE) \
  TABLE(DeviceObject, objects, "objects") \
  TABLE(DeviceMaterial, materials, "materials") \
  TABLE(DeviceLight, lights, "lights") /* without those that are left out */

// A lamp has one row of light, the environment three, one for each primary (sky.h). The index of refraction of a
// material that is no dielectric is 1.
#define WAVELENGTH_TABLES(TABLE) \
  TABLE(int, cluster_first, "cluster starts") /* [cluster + 1]: where it begins in the next table */ \
  TABLE(int, cluster_wavelengths, "cluster wavelengths") /* indices 0..400, cluster after cluster */ \
  TABLE(float, index_of_cluster, "index of refraction of each cluster") /* [cluster][material]: the mean */ \
  TABLE(float, index_of_wavelength, "index of refraction of each wavelength") /* [401][material] */ \
  TABLE(float, wavelength_cdf, "choice of a wavelength") /* [light, then all][of cluster_wavelengths]: band.h */ \
  TABLE(float, coefficient, "attenuation") /* [attenuator][401]: 1/m; mirror: -ln(reflectance); \
    tint: -ln(what passes) */ \
  TABLE(float, surface_data, "surfaces of materials") /* metal: [401] n, k; \
    coating: [401] its index of refraction; plastic: COAT_PARTS + COAT_COSINES items */ \
  TABLE(float, reflectance, "reflectance") /* [reflector][401] */ \
  TABLE(float4, light_xyz, "light spectra") /* [row][401]: share * (xbar, ybar, zbar), share */ \
  TABLE(float4, reflected_xyz, "reflected colours by cluster") /* [row][cluster][reflector]; w: as of a white one,
    which stands there alone where there is no reflector */

// Where wavelengths lie on the parameter s, and dn/ds: differential.h.
#define STRETCH_TABLES(TABLE) \
  TABLE(float, index_slope, "slope of the index of refraction") /* [cluster][material]: dn/ds */ \
  TABLE(float4, stretch_place, "stretch of each wavelength") /* [401]: s of it, of 1 nm below, of 1 nm above */ \
  TABLE(float4, stretch_span, "stretch of each cluster") /* [cluster]: s of its mean index; lowest, highest s */

// The environment as a light: sky.h. Empty where it is no light. The cdf is exact_cdf of the rows by flux, then of the
// texels of each row. If there are peaks, the same follows for their flux.
#define SKY_TABLES(TABLE) \
  TABLE(float, texel_cdf, "environment as a light, choice of a texel") \
  TABLE(float, texel_colour, "environment as a light") /* [row][column][3]: linear sRGB of a texel over grey */

// Pictures on surfaces: materials/texture.h. Empty where there are none.
#define TEXTURE_TABLES(TABLE) \
  TABLE(DeviceTexture, textures, "textures") \
  TABLE(ushort, texture_texels, "texels of textures") /* [texel][3]: linear sRGB or numbers, 65535 is 1 */ \
  TABLE(float, texcoords, "texture coordinates") /* [triangle of objects with textures][corner][2] */

// What lamps have beyond their DeviceLight: kernels/lights.
#define LAMP_TABLES(TABLE) \
  TABLE(float, lamp_tables, "lamps' tables") /* mesh: chances of its surfaces; picture: of rows, then of each row's \
    texels; photometry: [plane][gamma] intensity over the mean of all directions */

// A meter in the camera's place: meter.h. Empty where there is an eye.
#define METER_TABLES(TABLE) \
  TABLE(DeviceMeterChart, meter_charts, "a meter's charts") \
  TABLE(float4, meter_limits, "what a meter measures") /* low and high corner of its box; the way that it is to face, \
    w: the least cosine to that */ \
  TABLE(int, meter_cells, "a meter's cells") /* of each place of the charts' grids; -1: none */ \
  TABLE(int, meter_pieces, "where a meter's cells begin") /* [cell + 1]: first piece */ \
  TABLE(float, meter_chances, "choice of a meter's piece") /* [piece] in its cell */ \
  TABLE(float, meter_density, "areas of a meter's cells") /* [cell]: 1 over square metres */

// Where photons are sent.
#define TARGET_TABLES(TABLE) \
  TABLE(DeviceTarget, targets, "targets") /* lists: DeviceLight::first_target */

// What paths from the eye, unsplit photons and tiles look up.
#define COLOUR_TABLES(TABLE) \
  TABLE(float, cluster_cdf, "cluster choice") /* [cluster + 1]: what paths through glass are worth */ \
  TABLE(float4, reflected_xyz_all, "reflected colours") /* [row][reflector]: reflected_xyz of all clusters */ \
  TABLE(float4, reflected_before, "reflected colours by wavelength") /* [row][reflector, then white][of \
    cluster_wavelengths]: the sum over those before it, as reflected_xyz's */

#define OTHER_TABLES(TABLE) \
  OBJECT_TABLES(TABLE) WAVELENGTH_TABLES(TABLE) STRETCH_TABLES(TABLE) SKY_TABLES(TABLE) TEXTURE_TABLES(TABLE) \
  LAMP_TABLES(TABLE) METER_TABLES(TABLE) TARGET_TABLES(TABLE) COLOUR_TABLES(TABLE)

// clang-format on

#define TABLE_FIRST(type, name, words) uint name;
#ifdef __OPENCL_C_VERSION__
#define TABLE_MEMBER(type, name, words) __global const type* name;
#define TABLE_IN_GEOMETRY(type, name, words) (__global const type*)(geometry + (size_t)scene.first.name * TABLE_STEP),
#define TABLE_IN_TABLES(type, name, words) (__global const type*)(tables + (size_t)scene.first.name * TABLE_STEP),
#else
#define TABLE_VECTOR(type, name, words) std::vector<type> name;
#endif

#endif
