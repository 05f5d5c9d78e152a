// SPDX-License-Identifier: Apache-2.0
#include "tracing/stretch.h"

#include "optics/wavelength.h"

#include <algorithm>
#include <cmath>

namespace nephroid::tracing {
namespace {

using optics::Spectrum;
using optics::wavelength_count;

constexpr std::size_t middle_wavelength = 200; // 580 nm
constexpr double jump_ratio = 8;

/// The curves of all glass that an object is of and that disperses, each once.
std::vector<const Spectrum*> dispersive_curves(const scene::Scene& scene)
{
  std::vector<const Spectrum*> curves;
  for (const scene::Object& object : scene.objects) {
    const scene::Material& material = material_of(scene, object);
    const Spectrum& n = material.n;
    if (material.type != scene::Material::Type::dielectric || std::all_of(n.begin(), n.end(), [&](double v) { return v == n[0]; }))
      continue;
    if (std::none_of(curves.begin(), curves.end(), [&](const Spectrum* other) { return *other == n; })) curves.push_back(&n);
  }
  return curves;
}

/// s at every wavelength, from 580 nm.
Spectrum parameter(const scene::Scene& scene)
{
  const std::vector<const Spectrum*> curves = dispersive_curves(scene);
  Spectrum s{};
  for (std::size_t w = 0; w < s.size(); ++w)
    s[w] = curves.size() == 1 ? (*curves[0])[w] - (*curves[0])[middle_wavelength]
                              : static_cast<double>(w) - static_cast<double>(middle_wavelength);
  return s;
}

/// s[to] - s[from] of neighbours, 0 across a jump; beyond the ends as long as the step before.
double arm(const Spectrum& s, int from, int to)
{
  const auto step = [&](int lower) { return s[static_cast<std::size_t>(lower) + 1] - s[static_cast<std::size_t>(lower)]; };
  const int last = wavelength_count - 2; // the lower wavelength of the last step
  const int lower = std::clamp(std::min(from, to), 0, last);
  double beside = 0;
  if (lower > 0) beside = std::abs(step(lower - 1));
  if (lower < last) beside = std::max(beside, std::abs(step(lower + 1)));
  if (std::abs(step(lower)) > jump_ratio * beside) return 0;
  return to > from ? step(lower) : -step(lower);
}

/// Least squares of n over s, of the wavelengths of a cluster and their neighbours.
double slope(const Spectrum& n, const Spectrum& s, const std::vector<int>& cluster)
{
  const int low = std::max(*std::min_element(cluster.begin(), cluster.end()) - 1, 0),
            high = std::min(*std::max_element(cluster.begin(), cluster.end()) + 1, wavelength_count - 1);
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

StretchParameter stretch_parameter(const scene::Scene& scene)
{
  const std::size_t curves = dispersive_curves(scene).size();
  return curves == 0 ? StretchParameter::none : curves == 1 ? StretchParameter::index : StretchParameter::wavelength;
}

std::vector<std::vector<int>> split_into_runs(const std::vector<std::vector<int>>& clusters)
{
  std::vector<std::vector<int>> runs;
  for (std::vector<int> cluster : clusters) {
    std::sort(cluster.begin(), cluster.end());
    for (std::size_t i = 0; i < cluster.size(); ++i) {
      if (i == 0 || cluster[i] != cluster[i - 1] + 1) runs.emplace_back();
      runs.back().push_back(cluster[i]);
    }
  }
  std::sort(runs.begin(), runs.end());
  return runs;
}

StretchTables make_stretch_tables(const scene::Scene& scene, const std::vector<std::vector<int>>& clusters, const std::vector<bool>& lit)
{
  StretchTables tables;
  const Spectrum s = parameter(scene);
  const std::vector<const Spectrum*> curves = dispersive_curves(scene);
  const auto to_float4 = [](double x, double y, double z) {
    return shared::float4{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), 0};
  };
  for (int w = 0; w < wavelength_count; ++w) {
    const double here = s[static_cast<std::size_t>(w)];
    tables.place.push_back(to_float4(here, here + arm(s, w, w - 1), here + arm(s, w, w + 1)));
  }
  for (const std::vector<int>& cluster : clusters) {
    double mean = 0;
    std::vector<double> ends; // of the light of those that are lit
    for (const int w : cluster) {
      mean += s[static_cast<std::size_t>(w)] / static_cast<double>(cluster.size());
      if (!lit[static_cast<std::size_t>(w)]) continue;
      const shared::float4& place = tables.place[static_cast<std::size_t>(w)];
      ends.insert(ends.end(), {place.x, place.y, place.z});
    }
    if (ends.empty()) continue;
    const auto [low, high] = std::minmax_element(ends.begin(), ends.end());
    tables.span.push_back(to_float4(mean, *low, *high));
    for (const scene::Material& material : scene.materials) {
      const bool disperses = std::any_of(curves.begin(), curves.end(), [&](const Spectrum* n) { return *n == material.n; });
      tables.index_slope.push_back(!disperses ? 0.0f : curves.size() == 1 ? 1.0f : static_cast<float>(slope(material.n, s, cluster)));
    }
  }
  return tables;
}

} // namespace nephroid::tracing
