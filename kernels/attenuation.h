// SPDX-License-Identifier: Apache-2.0
// What a path loses on its way, wavelength by wavelength: Beer-Lambert absorption exp(-a s) in glass, a in 1/m and s in metres, and
// a mirror's reflectance as exp(-a s) with a = -ln(reflectance) and s the number of reflections. A path carries the s of each.
#ifndef NEPHROID_ATTENUATION_H
#define NEPHROID_ATTENUATION_H

#define WAVELENGTH_COUNT 401

typedef struct {
  __global const int* first;        // of each cluster in `wavelengths`; one more at the end
  __global const int* wavelengths;  // indices 0..400, cluster after cluster
  __global const float* coefficient; // [attenuator][wavelength]
  __global const float4* light_xyz; // [light][wavelength]: share of the light's power times (xbar, ybar, zbar); w: the share alone
  __global const float* reflectance; // [reflector][wavelength]
} SpectralTables;

#if NEPHROID_ATTENUATORS > 0
// Sum over the cluster's wavelengths of light * attenuation * reflectance; reflector -1 counts as 1. xyz, and in w the light's share alone.
static inline float4 attenuated_sum(const SpectralTables* tables, const float* lengths, int light, int cluster, int reflector)
{
  float4 sum = (float4)(0.0f);
  for (int i = tables->first[cluster]; i < tables->first[cluster + 1]; ++i) {
    const int wavelength = tables->wavelengths[i];
    float exponent = 0.0f;
    for (int a = 0; a < NEPHROID_ATTENUATORS; ++a) exponent += tables->coefficient[a * WAVELENGTH_COUNT + wavelength] * lengths[a];
    const float through = exp(-exponent);
    const float4 light_xyz = tables->light_xyz[light * WAVELENGTH_COUNT + wavelength];
    const float reflectance = reflector < 0 ? 1.0f : tables->reflectance[reflector * WAVELENGTH_COUNT + wavelength];
    sum += through * (float4)(light_xyz.xyz * reflectance, light_xyz.w);
  }
  return sum;
}
#endif

#endif
