// SPDX-License-Identifier: Apache-2.0
// The losses of a path, wavelength by wavelength: Beer-Lambert absorption exp(-a s) in glass, with a = 4 pi k / lambda
// in 1/m and s in metres, and what surfaces take as exp(-a s) with s a number of times: a = -ln(reflectance) of a
// mirror, -ln(tint) of glass. Metals and roughness have their own (kernels/scatter). A path carries the s of each.
// Without losses NEPHROID_ATTENUATORS is 0 and this compiles to nothing.
#include "kernels/tracing/registers.h"
#include "kernels/tracing/shared_types.h"
#include "kernels/tracing/reflector.h"

#ifndef NEPHROID_ATTENUATORS
#define NEPHROID_ATTENUATORS 1
#endif

#define LOSES_ALL 200.0f // exp(-200) is 0 in single precision

typedef struct {
#if NEPHROID_ATTENUATORS > 0
  float lengths[NEPHROID_ATTENUATORS];
#endif
  bool any;
} Losses;

static inline Losses no_losses(void) {
  Losses losses;
  losses.any = false;
#if NEPHROID_ATTENUATORS > 0
  for (int a = 0; a < NEPHROID_ATTENUATORS; ++a) losses.lengths[a] = 0.0f;
#endif
  return losses;
}

// attenuator: a row of the table, or -1 for a material without losses. length: metres of glass, or 1 for a reflection.
static inline void lose(Losses* losses, int attenuator, float length) {
#if NEPHROID_ATTENUATORS > 0
  if (attenuator < 0) return;
#if NEPHROID_ATTENUATORS <= 4 // without an index they are registers
  for (int a = 0; a < NEPHROID_ATTENUATORS; ++a) losses->lengths[a] += a == attenuator ? length : 0.0f;
#else
  losses->lengths[attenuator] += length;
#endif
  losses->any = true;
#endif
}

// The part of one wavelength that is left: exp(-a s).
static inline float wavelength_left(const SpectralTables* tables, const Losses* losses, int wavelength) {
#if NEPHROID_ATTENUATORS > 0
  if (!losses->any) return 1.0f;
  float exponent = 0.0f;
  for (int a = 0; a < NEPHROID_ATTENUATORS; ++a)
    exponent += tables->coefficient[a * WAVELENGTH_COUNT + wavelength] * losses->lengths[a];
  return exp(-exponent);
#else
  return 1.0f;
#endif
}

// xyz: the sum over the cluster's wavelengths of light * part left * reflectance * (xbar, ybar, zbar). w: the
// sum of light * part left, which is the share of the light's power that is left.
static inline float4 attenuated_sum(const SpectralTables* tables, const Losses* losses, int light, int cluster,
                                    Reflector reflector) {
  float4 sum = (float4)(0.0f);
  cluster = made_late(cluster);
  for (int i = tables->cluster_first[cluster]; i < tables->cluster_first[cluster + 1]; ++i) {
    const int wavelength = tables->cluster_wavelengths[i];
    const float4 light_xyz = tables->light_xyz[light * WAVELENGTH_COUNT + wavelength];
    const float reflectance = reflectance_of(tables, reflector, wavelength);
    sum += wavelength_left(tables, losses, wavelength) * (float4)(light_xyz.xyz * reflectance, light_xyz.w);
  }
  return sum;
}
