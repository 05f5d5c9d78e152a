// SPDX-License-Identifier: Apache-2.0
#include "tracing/wavelength_tables.h"

#include "optics/primary_reflectances.h"
#include "optics/spectrum.h"
#include "tracing/scales.h"
#include "tracing/scene_tables.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <span>

namespace nephroid::tracing {
namespace {

using optics::Spectrum;
using optics::wavelength_count;

static_assert(WAVELENGTH_COUNT == wavelength_count, "kernels and host mean the same wavelengths");

using MaterialType = scene::Material::Type;

float4 to_float4(const glm::dvec4& v) { return tracing::to_float4(glm::dvec3(v), v.w); }

std::vector<bool> used_materials(const scene::Scene& scene) {
  std::vector<bool> used(scene.materials.size(), false);
  for (const scene::Object& object : scene.objects) used[static_cast<std::size_t>(object.material)] = true;
  return used;
}

/// The coefficient of a mirror that reflects nothing: exp(-200) is 0 in single precision.
constexpr double blackest = 200;

/// Adds a row of losses and returns its number; -1 for none.
int add_loss(WavelengthTables& tables, std::span<const double> coefficients) {
  if (coefficients.empty()) return -1;
  for (const double a : coefficients) tables.coefficient.push_back(static_cast<float>(a));
  return tables.attenuator_count++;
}

/// Adds the rows of a metal's terms and returns the first one's number.
int add_conductor(WavelengthTables& tables, const scene::Material& metal) {
  static_assert(CONDUCTOR_TERMS == optics::conductor_term_count);
  const int first = tables.attenuator_count;
  for (std::size_t j = 0; j < CONDUCTOR_TERMS; ++j) {
    const std::size_t w = metal.conductor.wavelengths[j];
    for (const double value : {metal.n[w], metal.k[w]}) tables.surface_data.push_back(static_cast<float>(value));
    add_loss(tables, metal.conductor.coefficients[j]);
  }
  return first;
}

/// Adds a row of reflectances and returns its number.
int add_reflector(WavelengthTables& tables, const Spectrum& reflectance) {
  tables.reflectance.insert(tables.reflectance.end(), reflectance.begin(), reflectance.end());
  return tables.reflector_count++;
}

/// Adds the rows of a surface that a texture may lie on, and returns the first one's number. factor: of its colour.
int add_colour(WavelengthTables& tables, Spectrum colour, double factor, bool is_textured) {
  for (double& part : colour) part *= factor;
  const int first = add_reflector(tables, colour);
  if (!is_textured) return first;
  for (Spectrum primary : optics::primary_reflectances()) {
    for (std::size_t w = 0; w < primary.size(); ++w) primary[w] *= colour[w];
    add_reflector(tables, primary);
  }
  return first;
}

/// Adds what the table surface_data has of a coat.
void add_coat(WavelengthTables& tables, const scene::Material& plastic) {
  static_assert(COAT_COSINES == optics::coat_cosines && COAT_MEAN == 1 && COAT_PARTS == 2);
  for (const double value : {plastic.coat_n, plastic.coat.mean})
    tables.surface_data.push_back(static_cast<float>(value));
  for (const double part : plastic.coat.passes) tables.surface_data.push_back(static_cast<float>(part));
}

/// The row of what roughness and coats take, which all materials share.
int masking_row(WavelengthTables& tables, std::span<const shared::DeviceMaterial> before) {
  for (const shared::DeviceMaterial& material : before)
    if (material.masking >= 0) return material.masking;
  return add_loss(tables, optics::constant_spectrum(1));
}

/// The rows of each material that an object uses.
void add_material_rows(const scene::Scene& scene, WavelengthTables& tables,
                       std::vector<shared::DeviceMaterial>& materials) {
  const std::vector<bool> used = used_materials(scene);
  materials.assign(scene.materials.size(), {MATERIAL_DIFFUSE, 0, -1, -1, -1, 0, 0, 0, -1, -1, -1, -1});
  int textures = 0;
  const auto number = [&](const std::shared_ptr<const scene::Texture>& texture) { return texture ? textures++ : -1; };
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    const scene::Material& material = scene.materials[i];
    shared::DeviceMaterial& row = materials[i];
    row.type = static_cast<int>(material.type); // both are of the list MATERIALS
    if (!used[i]) continue;
    row.alpha = static_cast<float>(material.alpha);
    row.texture = number(material.texture); // in the order of make_texture_tables
    row.roughness_texture = number(material.roughness_texture);
    row.normal_map = number(material.normal_map);
    if (is_rough(material) || is_plastic(material) || has_tint_texture(material))
      row.masking = masking_row(tables, {materials.data(), i});
    const int surface_first = static_cast<int>(tables.surface_data.size());
    switch (material.type) {
    case MaterialType::diffuse:
      row.reflector = add_colour(tables, material.reflectance, 1, is_textured(material));
      break;
    case MaterialType::plastic:
      row.reflector = add_colour(tables, material.reflectance, 1 / material.coat.mean, is_textured(material));
      row.surface_first = surface_first;
      add_coat(tables, material);
      break;
    case MaterialType::mirror: row.attenuator = add_loss(tables, loss_at_surface(material)); break;
    case MaterialType::conductor:
      row.surface_first = surface_first;
      row.attenuator = add_conductor(tables, material);
      break;
    case MaterialType::dielectric:
      row.attenuator = add_loss(tables, loss_inside(material));
      if (has_tint_texture(material))
        row.reflector = add_colour(tables, material.tint, 1, true);
      else
        row.tint = add_loss(tables, loss_at_surface(material));
      row.is_thin = material.thin;
      if (!is_coated(material)) break;
      row.surface_first = surface_first;
      row.coating_nm = static_cast<float>(material.coating_nm);
      for (const double n : material.coating_n) tables.surface_data.push_back(static_cast<float>(n));
    }
  }
}

bool bends(const scene::Material& material) { return material.type == MaterialType::dielectric; }

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
    for (const scene::Material& material : scene.materials) {
      double sum = 0;
      for (const int w : cluster) sum += material.n[static_cast<std::size_t>(w)];
      tables.index_of_cluster.push_back(bends(material) ? static_cast<float>(sum / static_cast<double>(cluster.size()))
                                                        : 1.0f);
    }
  }
}

/// The index of refraction of each wavelength, and whether any cluster has more than one.
void add_wavelength_rows(const scene::Scene& scene, WavelengthTables& tables) {
  for (std::size_t w = 0; w < wavelength_count; ++w)
    for (const scene::Material& material : scene.materials)
      tables.index_of_wavelength.push_back(bends(material) ? static_cast<float>(material.n[w]) : 1.0f);
  const std::vector<bool> used = used_materials(scene);
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    if (!used[m] || !bends(scene.materials[m])) continue;
    tables.clusters_spread = tables.clusters_spread || parts_wavelengths(scene.materials[m]);
    const Spectrum& n = scene.materials[m].n;
    for (const std::vector<int>& cluster : tables.clusters)
      for (const int w : cluster)
        tables.clusters_spread =
            tables.clusters_spread || n[static_cast<std::size_t>(w)] != n[static_cast<std::size_t>(cluster.front())];
  }
}

/// Sum over wavelengths of light share times reflectance times (xbar, ybar, zbar), and of the light share.
glm::dvec4 reflected(const Spectrum& light, const float* reflectance, const std::vector<int>& wavelengths) {
  const optics::ColourMatching& eye = optics::cie_1931();
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
void add_spectrum_rows(const Spectrum& spectrum, const std::vector<int>& all, WavelengthTables& tables) {
  for (const int w : all) tables.light_xyz.push_back(to_float4(reflected(spectrum, nullptr, {w})));
  for (const std::vector<int>& cluster : tables.clusters)
    for (int r = 0; r < tables.reflector_count; ++r)
      tables.reflected_xyz.push_back(to_float4(reflected(spectrum, reflectance_row(tables, r), cluster)));
  for (int r = 0; r < tables.reflector_count; ++r)
    tables.reflected_xyz_all.push_back(to_float4(reflected(spectrum, reflectance_row(tables, r), all)));
  for (int r = 0; r < tables.reflector_count; ++r)
    for (const std::vector<int>& cluster : tables.clusters) {
      glm::dvec4 before(0);
      for (const int w : cluster) {
        tables.reflected_before.push_back(to_float4(before));
        before += reflected(spectrum, reflectance_row(tables, r), {w});
      }
    }
}

/// Photons are allocated by a light's spectrum and carry it too. Only the environment's carry three parts.
void add_light_rows(const std::vector<const scene::Light*>& lights, WavelengthTables& tables) {
  const std::vector<int> all = optics::all_wavelengths();
  for (const scene::Light* light : lights) {
    if (is_environment(*light))
      for (const Spectrum& primary : light->primaries) add_spectrum_rows(primary, all, tables);
    else
      add_spectrum_rows(light->spectrum, all, tables);
    std::vector<double>& share = tables.share.emplace_back();
    std::vector<double>& seen = tables.seen.emplace_back();
    for (const std::vector<int>& cluster : tables.clusters) {
      const glm::dvec4 sum = reflected(light->spectrum, nullptr, cluster);
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
void add_wavelength_cdf(const std::vector<const scene::Light*>& lights, WavelengthTables& tables) {
  for (const std::vector<int>& cluster : tables.clusters) {
    std::vector<double> weights;
    for (const int w : cluster) {
      double weight = 0;
      for (const scene::Light* light : lights) {
        const glm::dvec4 xyz_power = reflected(light->spectrum, nullptr, {w});
        weight += radiometric(*light) * worth((xyz_power[0] + xyz_power[1] + xyz_power[2]) / 3, xyz_power[3]);
      }
      weights.push_back(weight);
    }
    const std::vector<float> cdf = exact_cdf(weights);
    tables.wavelength_cdf.insert(tables.wavelength_cdf.end(), cdf.begin(), cdf.end());
  }
}

constexpr std::size_t middle_wavelength = 200; // 580 nm
constexpr double jump_ratio = 8;

/// The curves of all glass that disperses and that an object has, each once.
std::vector<const Spectrum*> dispersive_curves(const scene::Scene& scene) {
  std::vector<const Spectrum*> curves;
  for (const scene::Object& object : scene.objects) {
    const scene::Material& material = material_of(scene, object);
    const Spectrum& n = material.n;
    if (material.type != MaterialType::dielectric || std::ranges::all_of(n, [&](double v) { return v == n[0]; }))
      continue;
    if (std::ranges::none_of(curves, [&](const Spectrum* other) { return *other == n; })) curves.push_back(&n);
  }
  return curves;
}

/// s at every wavelength, counted from 580 nm.
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

std::vector<double> loss_inside(const scene::Material& material) {
  std::vector<double> a;
  if (!material.absorbs) return a;
  for (int w = 0; w < optics::wavelength_count; ++w)
    a.push_back(4 * std::numbers::pi * material.k[static_cast<std::size_t>(w)] / (optics::wavelength_nm(w) * 1e-9));
  return a;
}

std::vector<double> loss_at_surface(const scene::Material& material) {
  std::vector<double> a;
  if (!is_specular(material.type)) return a;
  const Spectrum& left = is_refractive(material.type) ? material.tint : material.reflectance;
  if (std::ranges::all_of(left, [](double part) { return part == 1; })) return a;
  for (const double part : left) a.push_back(part > 0 ? std::min(-std::log(part), blackest) : blackest);
  return a;
}

WavelengthTables make_wavelength_tables(const scene::Scene& scene, const std::vector<const scene::Light*>& lights,
                                        const std::vector<std::vector<int>>& clusters, const std::vector<bool>& lit,
                                        std::vector<shared::DeviceMaterial>& materials) {
  WavelengthTables tables;
  add_material_rows(scene, tables, materials);
  add_cluster_rows(scene, clusters, lit, tables);
  add_wavelength_rows(scene, tables);
  add_light_rows(lights, tables);
  add_cluster_cdf(lights, tables);
  for (const scene::Light* light : lights) add_wavelength_cdf({light}, tables);
  add_wavelength_cdf(lights, tables);
  return tables;
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
    for (const scene::Material& material : scene.materials) {
      const bool disperses = std::ranges::any_of(curves, [&](const Spectrum* n) { return *n == material.n; });
      tables.index_slope.push_back(!disperses           ? 0.0f
                                   : curves.size() == 1 ? 1.0f
                                                        : static_cast<float>(slope(material.n, s, cluster)));
    }
  }
  return tables;
}

} // namespace nephroid::tracing
