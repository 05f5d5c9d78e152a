// SPDX-License-Identifier: Apache-2.0
// u(lambda) = l(lambda) ybar(lambda) sum_i m_i(lambda) L_i ghat_i, (4.15), divided by its largest value. i runs over
// the materials that diffuse or mirror light. m_i(lambda) is the largest reflectance over all directions (4.1.2).
#include "photons/effort/importance.h"

#include "lights/lights.h"
#include "scene/ray.h"
#include "tracing/targets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>

namespace nephroid::photons {
namespace {

using optics::Spectrum;

/// The corners of the box about an object, and its centre. The corners are drawn in by a thousandth: an object that
/// stands on a floor has corners of its box in the floor, and they are to see the floor.
std::array<glm::dvec3, 9> viewpoints(const scene::Scene& scene, const scene::Object& object) {
  const auto [low, high] = scene::bounds_of(scene, object);
  const glm::dvec3 centre = 0.5 * (low + high), half = 0.999 * 0.5 * (high - low);
  std::array<glm::dvec3, 9> points;
  for (int i = 0; i < 8; ++i)
    points[static_cast<std::size_t>(i)] = centre + half * glm::dvec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  points[8] = centre;
  return points;
}

/// The number of all rays: enough for an error of some tenths of a percent in a share, in a few milliseconds.
constexpr int rays_per_scene = 9 * 2048, least_rays_per_point = 16;

/// ghat: how often rays from the nine points of every caustic object hit each material, [material]. Every object counts
/// alike. Rays pass what refracts, as light does, and mirrors that throw the caustics: their own points lie inside.
std::vector<double> seen_materials(const scene::Scene& scene, const scene::Bvh& bvh, const std::vector<int>& throwers) {
  std::vector<bool> passed(scene.objects.size());
  for (std::size_t i = 0; i < passed.size(); ++i) passed[i] = is_refractive(material_of(scene, scene.objects[i]).type);
  for (const int i : throwers) passed[static_cast<std::size_t>(i)] = true;
  const auto counts = [&](std::uint32_t primitive) { return !passed[scene.object_of_primitive[primitive]]; };

  const auto points = static_cast<int>(9 * throwers.size());
  const int rays = std::max(rays_per_scene / points, least_rays_per_point);
  std::vector<double> hits(scene.materials.size(), 0);
  int point = 0;
  for (const int thrower : throwers)
    for (const glm::dvec3& from : viewpoints(scene, scene.objects[static_cast<std::size_t>(thrower)])) {
      for (int i = 0; i < rays; ++i) {
        // Each point's directions are turned against the others', so that their errors differ.
        const auto hit = scene::closest_hit(bvh, from, scene::even_direction(i, rays, double(point) / points), counts);
        if (hit) ++hits[static_cast<std::size_t>(scene.objects[scene.object_of_primitive[hit->primitive]].material)];
      }
      ++point;
    }
  const double total = std::accumulate(hits.begin(), hits.end(), 0.0);
  for (double& share : hits) share /= std::max(total, 1.0);
  return hits;
}

/// ghat = 1 for all materials of objects that send light on to the eye.
std::vector<double> used_materials(const scene::Scene& scene) {
  std::vector<double> used(scene.materials.size(), 0);
  for (const scene::Object& object : scene.objects)
    if (!is_empty(object) && !is_refractive(material_of(scene, object).type))
      used[static_cast<std::size_t>(object.material)] = 1;
  return used;
}

/// The part of each light's power that goes towards those of `receivers` that it can reach.
std::vector<double> parts_towards(const scene::Scene& scene, const std::vector<scene::Sphere>& receivers) {
  std::vector<double> parts;
  for (scene::Light light : scene.lights) {
    light.power_w = light.irradiance_w_m2 = 1;
    std::vector<scene::Sphere> reached;
    std::ranges::copy_if(receivers, std::back_inserter(reached),
                         [&](const scene::Sphere& sphere) { return lights::model(light).reaches(light, sphere); });
    parts.push_back(lights::model(light).towards_w(light, reached, scene.metres_per_unit));
  }
  return parts;
}

/// l: the sum of the lights' spectra, each times its watts.
Spectrum sum_of(std::span<const scene::Light> lights, const std::vector<double>& parts) {
  const std::vector<double> power = watts(lights, parts);
  Spectrum sum{};
  for (std::size_t i = 0; i < lights.size(); ++i)
    for (std::size_t w = 0; w < sum.size(); ++w) sum[w] += power[i] * lights[i].spectrum[w];
  return sum;
}

double luminance(const Spectrum& light, const Spectrum& reflectance) {
  const Spectrum& eye = optics::cie_1931().y;
  double sum = 0;
  for (std::size_t w = 0; w < light.size(); ++w) sum += light[w] * reflectance[w] * eye[w];
  return sum;
}

/// Divides u by its largest value. False where all values are 0.
bool normalise(Spectrum& u) {
  const double largest = *std::ranges::max_element(u);
  if (!(largest > 0)) return false;
  for (double& value : u) value /= largest;
  return true;
}

Error nothing_matters(const std::string& file, const std::string& reason) {
  return bad_input(Location(file) / "spectral" / "effort", "the importance (4.15) is 0 at every wavelength: " + reason,
                   "expected a light on the caustic objects and something around them that reflects it",
                   "change the scene, or choose another effort");
}

/// The reason why (4.15) is 0 everywhere, given what is not 0.
std::string reason_for_nothing(bool lit, const std::vector<Surrounding>& surroundings, bool geometry) {
  if (!lit) return "no light sends power towards the caustic objects";
  if (!surroundings.empty()) return "nothing around the caustic objects reflects a wavelength that the lights have";
  return geometry ? "the caustic objects see nothing that diffuses or mirrors light"
                  : "no object diffuses or mirrors light";
}

WavelengthImportance importance_of_surroundings(bool geometry, const ImportanceGeometry& where,
                                                std::span<const scene::Light> lights,
                                                std::span<const scatter::Material> materials, const std::string& file) {
  if (!where.caustics) throw nothing_matters(file, "no object is of glass or a mirror");
  const Spectrum light = sum_of(lights, where.towards);
  Spectrum perfect;
  perfect.fill(1);
  const double white = luminance(light, perfect);

  WavelengthImportance result;
  const std::vector<double>& shares = geometry ? where.seen : where.used;
  Spectrum reflected{}; // the sum over i
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (!(shares[i] > 0)) continue;
    const Spectrum& m = materials[i].reflectance;
    const double lightness = white > 0 ? optics::lightness(luminance(light, m) / white) : 0;
    result.surroundings.push_back({static_cast<int>(i), shares[i], lightness});
    for (std::size_t w = 0; w < m.size(); ++w) reflected[w] += m[w] * lightness * shares[i];
  }
  for (std::size_t w = 0; w < light.size(); ++w) result.u[w] = light[w] * optics::cie_1931().y[w] * reflected[w];
  if (!normalise(result.u)) throw nothing_matters(file, reason_for_nothing(white > 0, result.surroundings, geometry));
  return result;
}

/// The fit of Radziszewski, Boryczko and Alda 2009 to the wavelengths' contributions to luminance; it is 1 at 538 nm.
Spectrum importance_of_radziszewski() {
  return optics::spectrum_of([](double nm) { return std::pow(std::cosh(0.0072 * (nm - 538)), -2); });
}

/// What the eye makes of the light alone, wherever it goes.
Spectrum importance_of_light(const ImportanceGeometry& where, std::span<const scene::Light> lights) {
  const optics::ColourMatching& eye = optics::cie_1931();
  Spectrum u = sum_of(lights, where.anywhere);
  for (std::size_t w = 0; w < u.size(); ++w) u[w] *= (eye.x[w] + eye.y[w] + eye.z[w]) / 3;
  normalise(u);
  return u;
}

} // namespace

std::vector<int> caustic_objects(const scene::Scene& scene) {
  std::vector<int> objects;
  for (const auto throws : {preset::is_refractive, preset::is_specular}) { // mirrors where there is no glass
    for (std::size_t i = 0; i < scene.objects.size(); ++i)
      if (!is_empty(scene.objects[i]) && throws(material_of(scene, scene.objects[i]).type))
        objects.push_back(static_cast<int>(i));
    if (!objects.empty()) break;
  }
  return objects;
}

std::vector<double> watts(std::span<const scene::Light> lights, const std::vector<double>& parts) {
  std::vector<double> result;
  for (std::size_t i = 0; i < lights.size(); ++i) result.push_back(parts[i] * scene::radiometric(lights[i]));
  return result;
}

ImportanceGeometry importance_geometry(const Settings& settings, const scene::Scene& scene, const scene::Bvh& bvh) {
  const std::vector<int> throwers = caustic_objects(scene);
  std::vector<scene::Sphere> receivers;
  for (const int i : throwers) receivers.push_back(scene.objects[static_cast<std::size_t>(i)].bounds);
  ImportanceGeometry where;
  where.caustics = !throwers.empty();
  where.used = used_materials(scene);
  where.towards = parts_towards(scene, receivers);
  where.anywhere = parts_towards(scene, {tracing::everything(scene)});
  if (settings.effort == Settings::Effort::importance && settings.importance.geometry && where.caustics)
    where.seen = seen_materials(scene, bvh, throwers);
  return where;
}

WavelengthImportance wavelength_importance(const Settings& settings, const scene::Scene& scene, const scene::Bvh& bvh) {
  return wavelength_importance(settings, importance_geometry(settings, scene, bvh), scene.lights, scene.materials,
                               scene.source);
}

WavelengthImportance wavelength_importance(const Settings& settings, const ImportanceGeometry& where,
                                           std::span<const scene::Light> lights,
                                           std::span<const scatter::Material> materials, const std::string& file) {
  using Effort = Settings::Effort;
  WavelengthImportance result;
  switch (settings.effort) {
  case Effort::importance:
    return importance_of_surroundings(settings.importance.geometry, where, lights, materials, file);
  case Effort::radziszewski: result.u = importance_of_radziszewski(); break;
  case Effort::automatic:
  case Effort::power:
  case Effort::variance: result.u = importance_of_light(where, lights); break;
  case Effort::equal:
  case Effort::random: result.u.fill(1); break;
  }
  return result;
}

std::vector<double> cluster_importance(const Spectrum& u, std::span<const std::vector<int>> clusters,
                                       photons::Importance::Cluster which) {
  std::vector<double> result;
  for (const std::vector<int>& cluster : clusters) {
    double largest = 0, sum = 0;
    for (const int w : cluster) {
      largest = std::max(largest, u[static_cast<std::size_t>(w)]);
      sum += u[static_cast<std::size_t>(w)];
    }
    result.push_back(which == photons::Importance::Cluster::maximum ? largest
                                                                    : sum / static_cast<double>(cluster.size()));
  }
  return result;
}

// They grow by at most 1 although u p is rounded: u (p + 1) <= u p + 1, and rounding keeps order and integers.
std::int64_t iterations(double importance, std::int64_t passes) {
  return static_cast<std::int64_t>(std::ceil(importance * static_cast<double>(passes)));
}

} // namespace nephroid::photons
