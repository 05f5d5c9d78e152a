// SPDX-License-Identifier: Apache-2.0
// What media and surfaces leave of a path's light, at each of the wavelengths of its band: exp(-a s) in glass, after
// Beer and Lambert, with a = 4 pi k / lambda in 1/m and s in metres; and at surfaces what the files of kernels/scatter
// say. Where nothing takes light NEPHROID_LOSSES is 0, and this compiles to nothing.
#include "kernels/tracing/band.h"
#include "kernels/tracing/reflector.h"

#ifndef NEPHROID_LOSSES
#define NEPHROID_LOSSES 1
#endif

// At the wavelengths of a Carriers.
typedef struct {
  float4 four;
  float middle;
} Parts;

typedef struct {
  Parts own;     // of the light at Band::own
  Parts all;     // ... at Band::all, until the path is split
  bool is_split; // it has met glass that disperses or is coated
} Throughput;

static inline Throughput full_throughput(void) {
  Throughput throughput;
  throughput.own.four = (float4)(1.0f);
  throughput.own.middle = 1.0f;
  throughput.all = throughput.own;
  throughput.is_split = false;
  return throughput;
}

// Whether all clusters have gone the path's way.
static inline bool is_unsplit(const Throughput* throughput, const Band* band) {
  return NEPHROID_JITTER && NEPHROID_UNSPLIT && band->chance > 0.0f && !throughput->is_split;
}

// Whether the parts differ by wavelength.
static inline bool are_coloured(const Parts* parts) {
  return NEPHROID_LOSSES && any(parts->four != (float4)(parts->middle));
}

// Of the wavelength that leads.
static inline float part_left(const Throughput* throughput) { return NEPHROID_LOSSES ? throughput->own.four.x : 1.0f; }

static inline bool is_full(const Throughput* throughput) {
  return !NEPHROID_LOSSES || (throughput->own.middle == 1.0f && !are_coloured(&throughput->own));
}

// 1 less the parts.
static inline Parts without_parts(Parts parts) {
  const Parts rest = {1.0f - parts.four, 1.0f - parts.middle};
  return rest;
}

static inline void leave_parts(Parts* parts, Parts factors) {
  parts->four *= factors.four;
  parts->middle *= factors.middle;
}

// Leaves a part of the light, alike at all wavelengths.
static inline void leave_part(Throughput* throughput, float part) {
  const Parts factors = {(float4)(part), part};
  leave_parts(&throughput->own, factors);
  leave_parts(&throughput->all, factors);
}

// Leaves the parts that an expression gives for `carriers`.
#define LEAVE_BY_WAVELENGTH(throughput, band, parts_of_carriers) \
  for (int set = 0; set < (is_unsplit(throughput, band) ? 2 : 1); ++set) { \
    const Carriers* carriers = set == 0 ? &(band)->own : &(band)->all; \
    leave_parts(set == 0 ? &(throughput)->own : &(throughput)->all, parts_of_carriers); \
  }

// exp(-a length). a: [401].
static inline Parts attenuation(__global const float* a, float length, const Carriers* carriers) {
  const int4 w = carriers->wavelengths;
  const Parts parts = {exp((float4)(a[w.x], a[w.y], a[w.z], a[w.w]) * -length),
                       exp((float4)(a[carriers->middle] * -length)).x}; // as the four, to the bit
  return parts;
}

// Leaves exp(-a length) of the light. row: of a in the table; -1: all is left. length: metres of glass, or 1 for a
// surface.
static inline void attenuate(const SpectralTables* tables, Throughput* throughput, const Band* band, int row,
                             float length) {
#if NEPHROID_LOSSES
  if (row < 0) return;
  __global const float* a = tables->coefficient + row * WAVELENGTH_COUNT;
  LEAVE_BY_WAVELENGTH(throughput, band, attenuation(a, length, carriers))
#endif
}

// xyz: one wavelength of light * reflectance * (xbar, ybar, zbar). w: its power.
static inline float4 wavelength_light(const SpectralTables* tables, int light, int wavelength, Reflector reflector) {
  const float4 light_xyz = tables->light_xyz[light * WAVELENGTH_COUNT + wavelength];
  return (float4)(light_xyz.xyz * reflectance_of(tables, reflector, wavelength), light_xyz.w);
}

// The same of the members first .. end - 1 of all clusters.
static inline float4 members_light(const SpectralTables* tables, int light, int first, int end, Reflector reflector) {
  float4 sum = (float4)(0.0f);
  for (int i = first; i < end; ++i)
    sum += wavelength_light(tables, light, tables->cluster_wavelengths[i], reflector);
  return sum;
}

// What is left of light of which there was `all`, as its four wavelengths tell. The fifth, which is the same for every
// path, stands for all wavelengths, and the four for what differs from it: so light that is hardly coloured has hardly
// any noise of colour.
static inline float4 coloured_light(const SpectralTables* tables, const Parts* parts, float4 all, int light,
                                    const Carriers* carriers, Reflector reflector) {
  const float4 weights = carriers->weights * (parts->four - parts->middle);
  const int4 w = carriers->wavelengths;
  return parts->middle * all + weights.x * wavelength_light(tables, light, w.x, reflector) +
         weights.y * wavelength_light(tables, light, w.y, reflector) +
         weights.z * wavelength_light(tables, light, w.z, reflector) +
         weights.w * wavelength_light(tables, light, w.w, reflector);
}
