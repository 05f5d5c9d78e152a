// SPDX-License-Identifier: Apache-2.0
// The band of all paths of a pass in a cluster. Photons and paths from the eye that meet on a surface have to be of one wavelength
// each: where they jitter, the wavelength of a cluster is drawn once a pass.
#ifndef NEPHROID_PASS_BAND_H
#define NEPHROID_PASS_BAND_H

#include "camera.h"
#include "random.h"
#include "world.h"

static inline Band band_of_pass(const World* world, int cluster, uint2 seed, uint pass)
{
  return choose_band(world, world->scene.light_count, cluster, golden_place(seed, pass, 0u, 1u, (uint)cluster, STREAM_PASS_BAND));
}

#endif
