// SPDX-License-Identifier: Apache-2.0
// Puts a photon that has reached a diffuse surface into a photon map.
#include "kernels/photons/photon_map.h"
#include "kernels/tracing/surface.h"

// 1: photons are stored for maps.
#ifndef NEPHROID_STORE
#define NEPHROID_STORE 0
#endif

// Stores a photon on a diffuse surface in its slot of a photon map. cluster: the photon's. xyz: reflected power. scale:
// quanta per unit of power. dither: uniform in [0, 1). False where a photon carries too much; then the slot is empty.
static inline bool store_photon(__global StoredPhoton* slot, const Surface* surface, float3 arriving, int cluster,
                                int object_count, float3 xyz, float scale, float dither) {
  const float3 quanta = xyz * scale;
  const bool fits = all(fabs(quanta) <= (float3)(PHOTON_LIMIT));
  StoredPhoton photon;
  photon.group =
      fits ? photon_group(surface->object, dot(arriving, surface->geometric) < 0.0f, cluster, object_count) : NO_PHOTON;
  photon.position[0] = surface->position.x;
  photon.position[1] = surface->position.y;
  photon.position[2] = surface->position.z;
  photon.xyz[0] = convert_int_sat_rte(quanta.x + dither - 0.5f);
  photon.xyz[1] = convert_int_sat_rte(quanta.y + dither - 0.5f);
  photon.xyz[2] = convert_int_sat_rte(quanta.z + dither - 0.5f);
  photon.padding = 0;
  *slot = photon;
  return fits;
}
