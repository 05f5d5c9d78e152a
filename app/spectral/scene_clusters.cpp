// SPDX-License-Identifier: Apache-2.0
#include "spectral/scene_clusters.h"

#include "spectral/clusters.h"

#include <algorithm>

namespace nephroid::spectral {

std::vector<std::vector<int>> scene_clusters(const preset::Spectral& settings, const scene::Scene& scene)
{
  std::vector<optics::Spectrum> curves;
  for (const scene::Object& object : scene.objects) {
    const scene::Material& material = scene.materials[static_cast<std::size_t>(object.material)];
    if (material.type != scene::Material::Type::dielectric) continue;
    if (std::find(curves.begin(), curves.end(), material.n) == curves.end()) curves.push_back(material.n);
  }
  std::vector<Clustering> clusterings;
  for (const optics::Spectrum& curve : curves) clusterings.push_back(cluster_wavelengths(curve, settings.threshold_deg, settings.method));
  return common_refinement(clusterings);
}

} // namespace nephroid::spectral
