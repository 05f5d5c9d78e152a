// SPDX-License-Identifier: Apache-2.0
// The tables of a run of engine 1, still on the host: the scene's, and how its photons are allocated. Made once a job;
// tested without a device.
#pragma once
#include "photons/settings.h"
#include "scene/bvh.h"
#include "tracing/scene_tables.h"

#include <vector>

namespace nephroid::photons {

struct RunTables : tracing::SceneTables {
  std::vector<shared::DeviceEmitter> emitters; ///< photons of one batch, allocated to lights and clusters
  unsigned photons_per_batch = 0;              ///< as allocated: at least one for each emitter
  unsigned batches = 1;                        ///< of a pass: photons that are splatted come in so many fair samples
  unsigned eye_paths = 1;                      ///< that gather photons, of a pixel in a pass (maps/photon_map.h)
  unsigned photons_per_pass() const { return batches * photons_per_batch; }
  std::vector<double> importance;             ///< [cluster] 0..1, the largest 1: see ClusterShares
  double caustic_scale = 1, direct_scale = 1; ///< film quanta per unit of XYZ radiance, powers of two
  double direct_limit = 1;                    ///< quanta that one contribution to the direct film may have
  double energy_scale = 1;                    ///< energy quanta per watt, a power of two
};

/// For the lights as they are (relight/layer_light.h: for lights to come). Throws bad_input as
/// tracing::make_scene_tables does, for a threshold that cluster_wavelengths refuses, and as make_cluster_shares does.
RunTables make_lit_tables(const Settings& settings, const scene::Scene& scene, const scene::Bvh& bvh,
                          const tracing::LeaveOut& leave_out);

} // namespace nephroid::photons
