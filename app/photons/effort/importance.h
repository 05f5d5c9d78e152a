// SPDX-License-Identifier: Apache-2.0
// How much each wavelength matters to the eye in a scene (thesis 4.1.2), and how many iterations a cluster gets for it.
// No OpenCL here.
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
  int material = 0; ///< index into Scene::materials
  double share =
      0; ///< ghat_i: part of the rays that hit it, of those that hit anything, all sum to 1; without geometry 1 each
  double lightness = 0; ///< L_i: CIE L*, 0..100, of a surface of its reflectance under the lights
};

struct WavelengthImportance {
  optics::Spectrum u{};                  ///< 0..1, the largest 1
  std::vector<Surrounding> surroundings; ///< by index of the material; empty where u does not depend on them
};

/// The objects that throw the caustics: the dielectrics; where there is none, the mirrors. Indices into Scene::objects.
std::vector<int> caustic_objects(const scene::Scene& scene);

/// What u hangs on of where things are: neither a light's spectrum or power nor the colour of a material changes it.
struct ImportanceGeometry {
  bool caustics = false;    ///< whether an object throws them
  std::vector<double> seen; ///< [material]: ghat_i, by rays; empty where the settings ask for none
  std::vector<double>
      used; ///< [material]: ghat_i without geometry: 1 where an object is of it and it diffuses or mirrors, else 0
  std::vector<double> towards;  ///< [light]: W towards the caustic objects of each W, or W m^-2, that it has
  std::vector<double> anywhere; ///< [light]: the same towards anything
  bool operator==(const ImportanceGeometry&) const = default;
};
/// W of each light by one of the two vectors above.
std::vector<double> watts(std::span<const scene::Light> lights, const std::vector<double>& parts);
/// Traces rays for effort `importance` with geometry only; some milliseconds.
ImportanceGeometry whereabouts(const Settings& settings, const scene::Scene& scene, const scene::Bvh& bvh);

/// u(lambda) of (4.15) for effort `importance`, of Radziszewski et al. for `radziszewski`, of the light alone for
/// `power`, `variance` and `automatic` (what the eye makes of it, (X + Y + Z) / 3; 0 where no light has power), 1
/// everywhere for `equal` and `random`. Throws bad_input at FILE#/spectral/effort where (4.15) is 0 at every
/// wavelength, and says why.
WavelengthImportance wavelength_importance(const Settings& settings, const scene::Scene& scene, const scene::Bvh& bvh);
/// The same in a fraction of a millisecond, for lights and materials as they are now; of the lights only the spectra
/// count. file: for messages.
WavelengthImportance wavelength_importance(const Settings& settings, const ImportanceGeometry& where,
                                           std::span<const scene::Light> lights,
                                           std::span<const scene::Material> materials, const std::string& file);

/// Of each cluster (indices of wavelengths, none empty): the largest u in it or the mean.
std::vector<double> cluster_importance(const optics::Spectrum& u, std::span<const std::vector<int>> clusters,
                                       photons::Importance::Cluster which);

/// Iterations of a cluster after `passes` passes: ceil(u passes). It grows with passes by 0 or 1 at a time, so a
/// cluster has its turn in pass p (from 0) when iterations(u, p + 1) > iterations(u, p). importance: 0..1.
std::int64_t iterations(double importance, std::int64_t passes);

} // namespace nephroid::photons
