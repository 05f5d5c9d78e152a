// SPDX-License-Identifier: Apache-2.0
// How much each wavelength matters to the eye in a scene (thesis 4.1.2), and how many iterations a cluster gets.
#pragma once
#include "photons/settings.h"
#include "scene/bvh.h"
#include "scene/scene.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace nephroid::photons {

/// A material that the caustic objects see around them.
struct Surrounding {
  int material = 0;     ///< index into Scene::materials
  double share = 0;     ///< ghat_i: its part of the rays that hit anything; without geometry 1 each
  double lightness = 0; ///< L_i: CIE L*, 0..100, of a surface with its reflectance under the lights
};

struct WavelengthImportance {
  optics::Spectrum u{};                  ///< 0..1, the largest 1
  std::vector<Surrounding> surroundings; ///< sorted by material; empty where u does not depend on them
};

/// The objects that throw the caustics, as indices: the dielectrics, or the mirrors if there are none.
std::vector<int> caustic_objects(const scene::Scene& scene);

/// The geometric part of u: it depends neither on the lights' spectra and powers nor on the colours of materials.
struct ImportanceGeometry {
  bool caustics = false;        ///< whether an object throws them
  std::vector<double> seen;     ///< [material]: ghat_i, from rays; empty where the settings ask for none
  std::vector<double> used;     ///< [material]: ghat_i without geometry: 1 where a used one diffuses or mirrors, else 0
  std::vector<double> towards;  ///< [light]: part of its W, or W m^-2, that goes towards the caustic objects
  std::vector<double> anywhere; ///< [light]: part of its W, or W m^-2, that goes towards anything
  bool operator==(const ImportanceGeometry&) const = default;
};
/// The lights' W; parts is `towards` or `anywhere`.
std::vector<double> watts(std::span<const scene::Light> lights, const std::vector<double>& parts);
/// Traces rays for effort `importance` with geometry only; it takes some milliseconds.
ImportanceGeometry importance_geometry(const Settings& settings, const scene::Scene& scene, const scene::Bvh& bvh);

/// u(lambda). Effort `importance` takes (4.15), `radziszewski` the curve of Radziszewski et al. `power`, `variance` and
/// `automatic` take the light alone: (X + Y + Z) / 3, or 0 where no light has power. `equal` and `random` take 1
/// everywhere. Throws bad_input at FILE#/spectral/effort, with the reason, where (4.15) is 0 at every wavelength.
WavelengthImportance wavelength_importance(const Settings& settings, const scene::Scene& scene, const scene::Bvh& bvh);
/// The same in a fraction of a millisecond. Only the spectra of the lights count. file is for messages.
WavelengthImportance wavelength_importance(const Settings& settings, const ImportanceGeometry& where,
                                           std::span<const scene::Light> lights,
                                           std::span<const scatter::Material> materials, const std::string& file);

/// The largest u in each cluster, or the mean. Clusters are indices of wavelengths; none is empty.
std::vector<double> cluster_importance(const optics::Spectrum& u, std::span<const std::vector<int>> clusters,
                                       photons::Importance::Cluster which);

/// The iterations of a cluster after `passes` passes, ceil(u passes); importance is u, 0..1. They grow by 0 or 1 with
/// each pass, so a cluster has its turn in pass p (from 0) when iterations(u, p + 1) > iterations(u, p).
std::int64_t iterations(double importance, std::int64_t passes);

} // namespace nephroid::photons
