// SPDX-License-Identifier: Apache-2.0
// The tables of a run, still on the host: the scene's tables and the allocation of photons.
#pragma once
#include "photons/settings.h"
#include "scene/bvh.h"
#include "tracing/scene_tables.h"

#include <vector>

namespace nephroid::photons {

/// The independent replicates of a meter's films, in the place of two halves: intervals are made of them.
inline constexpr unsigned meter_replicates = 8;

struct RunTables : tracing::SceneTables {
  std::vector<shared::DeviceEmitter> emitters; ///< photons of one batch, allocated to lights and clusters
  unsigned photons_per_batch = 0;              ///< photons of a batch: at least one for each emitter
  unsigned batches = 1;                        ///< batches of a pass: fair samples of its splatted photons
  unsigned photons_per_pass() const { return batches * photons_per_batch; }
  bool has_even_sky = false; ///< whether photons of the environment are of its peaks alone (kernels/lights/sky.h), and
                             ///< even_sky_stage brings the rest
  std::vector<double> importance;             ///< [cluster] 0..1, the largest 1: see ClusterShares
  double caustic_scale = 1, direct_scale = 1; ///< film quanta per unit of XYZ radiance, powers of two
  double direct_limit = 1;                    ///< quanta that one contribution to the direct film may have
  double energy_scale = 1;                    ///< energy quanta per watt, a power of two
};

/// Settings::pixel_samples or its default. Where all lamps are points, only edges within pixels need samples.
int pixel_samples(const Settings& settings, const scene::Scene& scene);

/// Makes the tables for the present lights, for settings of a preset or of a plan; relight/layer_light.h does for
/// lights to come. Throws bad_input as tracing::make_scene_tables and make_cluster_shares do, and for a threshold that
/// cluster_wavelengths refuses.
RunTables make_lit_tables(const Settings& settings, const scene::Scene& scene, const scene::Bvh& bvh,
                          const tracing::LeaveOut& leave_out);

} // namespace nephroid::photons
