// SPDX-License-Identifier: Apache-2.0
#include "tracing/wavelength_tables.h"

#include "optics/spectrum.h"
#include "tracing/scales.h"
#include "tracing/scene_tables.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace nephroid::tracing {
namespace {

using optics::Spectrum;
using optics::wavelength_count;

static_assert(WAVELENGTH_COUNT == wavelength_count, "kernels and host mean the same wavelengths");

float4 to_float4(const glm::dvec4& v) { return tracing::to_float4(glm::dvec3(v), v.w); }

std::vector<bool> used_materials(const scene::Scene& scene) {
  std::vector<bool> used(scene.materials.size(), false);
  for (const scene::Object& object : scene.objects) used[static_cast<std::size_t>(object.material)] = true;
  return used;
}

/// The clusters with the wavelengths that are lit, and their indices of refraction.
void add_cluster_rows(const scene::Scene& scene, const std::vector<std::vector<int>>& clusters,
                      const std::vector<bool>& lit, WavelengthTables& tables) {
  tables.cluster_first.push_back(0);
  for (const std::vector<int>& cluster : clusters) {
    std::vector<int> left;
    std::ranges::copy_if(cluster, std::back_inserter(left), [&](int w) { return lit[static_cast<std::size_t>(w)]; });
    if (left.empty()) continue;
    tables.cluster_wavelengths.insert(tables.cluster_wavelengths.end(), left.begin(), left.end());
    tables.cluster_first.push_back(static_cast<int>(tables.cluster_wavelengths.size()));
    tables.clusters.push_back(std::move(left));
    for (const scatter::Material& material : scene.materials) {
      double sum = 0;
      for (const int w : cluster) sum += material.n[static_cast<std::size_t>(w)];
      tables.index_of_cluster.push_back(
          is_refractive(material.type) ? static_cast<float>(sum / static_cast<double>(cluster.size())) : 1.0f);
    }
  }
}

/// The index of refraction of each wavelength, and whether any cluster has more than one.
void add_wavelength_rows(const scene::Scene& scene, WavelengthTables& tables) {
  for (std::size_t w = 0; w < wavelength_count; ++w)
    for (const scatter::Material& material : scene.materials)
      tables.index_of_wavelength.push_back(is_refractive(material.type) ? static_cast<float>(material.n[w]) : 1.0f);
  const std::vector<bool> used = used_materials(scene);
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    if (!used[m] || !is_refractive(scene.materials[m].type)) continue;
    tables.clusters_spread = tables.clusters_spread || is_coated(scene.materials[m]);
    const Spectrum& n = scene.materials[m].n;
    for (const std::vector<int>& cluster : tables.clusters)
      for (const int w : cluster)
        tables.clusters_spread =
            tables.clusters_spread || n[static_cast<std::size_t>(w)] != n[static_cast<std::size_t>(cluster.front())];
  }
}

/// Sum over wavelengths of light share times reflectance times (xbar, ybar, zbar) of `eye`, and of the light share.
glm::dvec4 reflected(const optics::ColourMatching& eye, const Spectrum& light, const float* reflectance,
                     const std::vector<int>& wavelengths) {
  glm::dvec4 sum(0);
  for (const int index : wavelengths) {
    const auto w = static_cast<std::size_t>(index);
    const double reflected = light[w] * (reflectance ? reflectance[w] : 1.0);
    sum += glm::dvec4(reflected * eye.x[w], reflected * eye.y[w], reflected * eye.z[w], light[w]);
  }
  return sum;
}

const float* reflectance_row(const WavelengthTables& tables, int reflector) {
  return tables.reflectance.data() + static_cast<std::size_t>(reflector) * wavelength_count;
}

/// Adds one row to each table of light, for a spectrum that a photon may carry.
void add_spectrum_rows(const optics::ColourMatching& eye, const Spectrum& spectrum, const std::vector<int>& all,
                       WavelengthTables& tables) {
  for (const int w : all) tables.light_xyz.push_back(to_float4(reflected(eye, spectrum, nullptr, {w})));
  for (const std::vector<int>& cluster : tables.clusters) {
    for (int r = 0; r < tables.reflector_count; ++r)
      tables.reflected_xyz.push_back(to_float4(reflected(eye, spectrum, reflectance_row(tables, r), cluster)));
    if (tables.reflector_count == 0)
      tables.reflected_xyz.push_back(to_float4(reflected(eye, spectrum, nullptr, cluster)));
  }
  for (int r = 0; r < tables.reflector_count; ++r)
    tables.reflected_xyz_all.push_back(to_float4(reflected(eye, spectrum, reflectance_row(tables, r), all)));
  for (int r = 0; r <= tables.reflector_count; ++r) {
    glm::dvec4 before(0);
    for (const int w : tables.cluster_wavelengths) {
      tables.reflected_before.push_back(to_float4(before));
      before += reflected(eye, spectrum, r < tables.reflector_count ? reflectance_row(tables, r) : nullptr, {w});
    }
  }
}

/// Photons are allocated by a light's spectrum and carry it too. Only the environment's carry three parts.
void add_light_rows(const optics::ColourMatching& eye, const std::vector<const scene::Light*>& lights,
                    WavelengthTables& tables) {
  const std::vector<int> all = optics::all_wavelengths();
  for (const scene::Light* light : lights) {
    if (is_environment(*light))
      for (const Spectrum& primary : light->primaries) add_spectrum_rows(eye, primary, all, tables);
    else
      add_spectrum_rows(eye, light->spectrum, all, tables);
    std::vector<double>& share = tables.share.emplace_back();
    std::vector<double>& seen = tables.seen.emplace_back();
    for (const std::vector<int>& cluster : tables.clusters) {
      const glm::dvec4 sum = reflected(eye, light->spectrum, nullptr, cluster);
      share.push_back(sum[3]);
      seen.push_back((sum[0] + sum[1] + sum[2]) / 3);
    }
  }
}

void add_cluster_cdf(const std::vector<const scene::Light*>& lights, WavelengthTables& tables) {
  std::vector<double> weights(tables.clusters.size(), 0);
  for (std::size_t l = 0; l < lights.size(); ++l)
    for (std::size_t c = 0; c < weights.size(); ++c)
      weights[c] += radiometric(*lights[l]) * worth(tables.seen[l][c], tables.share[l][c]);
  tables.cluster_cdf = exact_cdf_from_zero(weights);
}

/// Adds a cdf for each cluster, by the worth of its members' light.
void add_wavelength_cdf(const optics::ColourMatching& eye, const std::vector<const scene::Light*>& lights,
                        WavelengthTables& tables) {
  for (const std::vector<int>& cluster : tables.clusters) {
    std::vector<double> weights;
    for (const int w : cluster) {
      double weight = 0;
      for (const scene::Light* light : lights) {
        const glm::dvec4 xyz_power = reflected(eye, light->spectrum, nullptr, {w});
        weight += radiometric(*light) * worth((xyz_power[0] + xyz_power[1] + xyz_power[2]) / 3, xyz_power[3]);
      }
      weights.push_back(weight);
    }
    const std::vector<float> cdf = exact_cdf(weights);
    tables.wavelength_cdf.insert(tables.wavelength_cdf.end(), cdf.begin(), cdf.end());
  }
}

constexpr std::size_t middle_wavelength = 200; // 580 nm of the visible ones
constexpr double jump_ratio = 8;

/// The curves of all glass that disperses and that an object has, each once.
std::vector<const Spectrum*> dispersive_curves(const scene::Scene& scene) {
  std::vector<const Spectrum*> curves;
  for (const scene::Object& object : scene.objects) {
    const scatter::Material& material = material_of(scene, object);
    const Spectrum& n = material.n;
    if (!disperses(material)) continue;
    if (std::ranges::none_of(curves, [&](const Spectrum* other) { return *other == n; })) curves.push_back(&n);
  }
  return curves;
}

/// s at every wavelength, counted from the middle one.
Spectrum parameter(const scene::Scene& scene) {
  const std::vector<const Spectrum*> curves = dispersive_curves(scene);
  Spectrum s{};
  for (std::size_t w = 0; w < s.size(); ++w)
    s[w] = curves.size() == 1 ? (*curves[0])[w] - (*curves[0])[middle_wavelength]
                              : static_cast<double>(w) - static_cast<double>(middle_wavelength);
  return s;
}

/// s[to] - s[from] for neighbours; 0 across a jump. Beyond the ends it is as long as the step before.
double arm(const Spectrum& s, int from, int to) {
  const auto step = [&](int lower) {
    return s[static_cast<std::size_t>(lower) + 1] - s[static_cast<std::size_t>(lower)];
  };
  const int last = wavelength_count - 2; // the lower wavelength of the last step
  const int lower = std::clamp(std::min(from, to), 0, last);
  double beside = 0;
  if (lower > 0) beside = std::abs(step(lower - 1));
  if (lower < last) beside = std::max(beside, std::abs(step(lower + 1)));
  if (std::abs(step(lower)) > jump_ratio * beside) return 0;
  return to > from ? step(lower) : -step(lower);
}

/// The slope of n over s by least squares, over a cluster's wavelengths and their neighbours.
double slope(const Spectrum& n, const Spectrum& s, const std::vector<int>& cluster) {
  const int low = std::max(*std::ranges::min_element(cluster) - 1, 0),
            high = std::min(*std::ranges::max_element(cluster) + 1, wavelength_count - 1);
  double mean_n = 0, mean_s = 0, above = 0, below = 0;
  for (int w = low; w <= high; ++w) {
    mean_n += n[static_cast<std::size_t>(w)] / (high - low + 1);
    mean_s += s[static_cast<std::size_t>(w)] / (high - low + 1);
  }
  for (int w = low; w <= high; ++w) {
    const double away = s[static_cast<std::size_t>(w)] - mean_s;
    above += away * (n[static_cast<std::size_t>(w)] - mean_n);
    below += away * away;
  }
  return below > 0 ? above / below : 0;
}

} // namespace

WavelengthTables make_wavelength_tables(const scene::Scene& scene, const std::vector<const scene::Light*>& lights,
                                        const std::vector<std::vector<int>>& clusters, const std::vector<bool>& lit,
                                        std::vector<shared::DeviceMaterial>& materials) {
  WavelengthTables tables;
  scatter::DeviceMaterials rows = scatter::device_materials(scene.materials, used_materials(scene));
  materials = std::move(rows.materials);
  tables.coefficient = std::move(rows.coefficient);
  tables.reflectance = std::move(rows.reflectance);
  tables.surface_data = std::move(rows.surface_data);
  tables.takes_light = rows.takes_light;
  tables.colours_light = rows.colours_light;
  tables.reflector_count = static_cast<int>(tables.reflectance.size() / wavelength_count);
  add_cluster_rows(scene, clusters, lit, tables);
  add_wavelength_rows(scene, tables);
  const optics::ColourMatching& eye = response_of(scene);
  add_light_rows(eye, lights, tables);
  add_cluster_cdf(lights, tables);
  for (const scene::Light* light : lights) add_wavelength_cdf(eye, {light}, tables);
  add_wavelength_cdf(eye, lights, tables);
  return tables;
}

const optics::ColourMatching& response_of(const scene::Scene& scene) {
  return scene.camera.meter ? optics::power_and_luminance(scene.range) : optics::cie_1931();
}

StretchParameter stretch_parameter(const scene::Scene& scene) {
  const std::size_t curves = dispersive_curves(scene).size();
  return curves == 0 ? StretchParameter::none : curves == 1 ? StretchParameter::index : StretchParameter::wavelength;
}

std::vector<std::vector<int>> split_into_runs(const std::vector<std::vector<int>>& clusters) {
  std::vector<std::vector<int>> runs;
  for (std::vector<int> cluster : clusters) {
    std::ranges::sort(cluster);
    for (std::size_t i = 0; i < cluster.size(); ++i) {
      if (i == 0 || cluster[i] != cluster[i - 1] + 1) runs.emplace_back();
      runs.back().push_back(cluster[i]);
    }
  }
  std::ranges::sort(runs);
  return runs;
}

StretchTables make_stretch_tables(const scene::Scene& scene, const std::vector<std::vector<int>>& clusters,
                                  const std::vector<bool>& lit) {
  StretchTables tables;
  const Spectrum s = parameter(scene);
  const std::vector<const Spectrum*> curves = dispersive_curves(scene);
  for (int w = 0; w < wavelength_count; ++w) {
    const double here = s[static_cast<std::size_t>(w)];
    tables.stretch_place.push_back(to_float4(glm::dvec3(here, here + arm(s, w, w - 1), here + arm(s, w, w + 1))));
  }
  for (const std::vector<int>& cluster : clusters) {
    double mean = 0;
    std::vector<double> ends; // the ends of the arms of lit wavelengths
    for (const int w : cluster) {
      mean += s[static_cast<std::size_t>(w)] / static_cast<double>(cluster.size());
      if (!lit[static_cast<std::size_t>(w)]) continue;
      const shared::float4& place = tables.stretch_place[static_cast<std::size_t>(w)];
      ends.insert(ends.end(), {place.x, place.y, place.z});
    }
    if (ends.empty()) continue;
    const auto [low, high] = std::ranges::minmax_element(ends);
    tables.stretch_span.push_back(to_float4(glm::dvec3(mean, *low, *high)));
    for (const scatter::Material& material : scene.materials) {
      const bool disperses = std::ranges::any_of(curves, [&](const Spectrum* n) { return *n == material.n; });
      tables.index_slope.push_back(!disperses           ? 0.0f
                                   : curves.size() == 1 ? 1.0f
                                                        : static_cast<float>(slope(material.n, s, cluster)));
    }
  }
  return tables;
}

} // namespace nephroid::tracing
